// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Forces that balance a load, from others that are known: one factorisation instead of a program.
#pragma once

#include "conic/ConeProgram.h"

namespace drystone
{

struct SymbolicAnalysis;

/// Forces c with A c = f, from some inside the cones that balance a load near f. Of all that do so they are
/// the nearest in the metric of the cones' barrier at the forces known: with those of the cones s, D = s^2 of
/// rays and P(s), the quadratic representation, of round cones,
///
///     s + D B' (B D B')^-1 (f - B s).
///
/// Steps of a length below 1 in that metric stay in the cones (Dikin's ellipsoid: Nesterov & Nemirovskii
/// 1994), longer ones may leave them: the caller looks. Where the forces known are on the surface of a cone
/// they stay there. \param program without multiplier; its inertia, gaps and strengths are not looked at
/// \param near F k \param tolerance of the balance, of the largest entry of the load \param symbolic kept,
/// see form/Form.h \return F k; empty where none balance the load
template<int Rows, int Forces>
Eigen::VectorXd nearestForces(const ConeProgram<Rows, Forces>& program, const Eigen::VectorXd& near,
                              double tolerance, SymbolicAnalysis& symbolic);

/// Points at which forces come nearer to the surface of the cone than a share of how far others are inside
/// it: none where forces - margin near is in the cones.
template<int Rows, int Forces>
std::vector<std::size_t> pointsOutside(const ConeProgram<Rows, Forces>& program, const Eigen::VectorXd& near,
                                       const Eigen::VectorXd& forces, double margin);

} // namespace drystone
