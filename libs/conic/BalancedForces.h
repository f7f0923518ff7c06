// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Forces that balance a load, from others that are known: one factorisation instead of a program.
#pragma once

#include "conic/ConeProgram.h"

namespace drystone
{

struct SymbolicAnalysis;

/// How far forces may go from those that are known, and how well they are to balance the load.
struct BalanceSettings
{
    double margin = 0;       ///< share of the way to the surface of each cone that is left
    double tolerance = 1e-9; ///< of the balance, of the largest entry of the load
};

/// Forces c inside the cones with A c = f, from some that balance a load near f. Of all that do so they are
/// the nearest in the metric of the cones' barrier at the forces known: with those of the cones s, D = s^2 of
/// rays and P(s), the quadratic representation, of round cones,
///
///     s + D B' (B D B')^-1 (f - B s).
///
/// Steps of a length below 1 in that metric stay in the cones (Dikin's ellipsoid: Nesterov & Nemirovskii
/// 1994), longer ones may. Where the forces known are on the surface of a cone they stay there. \param
/// program without multiplier and strengths; its inertia and its gaps are not looked at \param near F k
/// \param symbolic kept, see form/Form.h \return F k; empty where they would come nearer to the surface of a
/// cone than the margin, or do not balance the load: a program may still find some
template<int Rows, int Forces>
Eigen::VectorXd balancedForces(const ConeProgram<Rows, Forces>& program, const Eigen::VectorXd& near,
                               const BalanceSettings& settings, SymbolicAnalysis& symbolic);

} // namespace drystone
