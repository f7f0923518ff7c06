// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Forces that balance a load, from others that are known: one factorisation, and a small program where they
/// leave their cones, instead of a program of all.
#pragma once

#include "conic/form/Form.h"

namespace drystone
{

/// Forces c with A c = f, from some inside the cones that balance a load near f. Of all that do so they are
/// the nearest in the metric of the cones' barrier at the forces known: with those of the cones s, D = s^2 of
/// rays and P(s), the quadratic representation, of round cones,
///
///     s + D B' (B D B')^-1 (f - B s).
///
/// Steps of a length below 1 in that metric stay in the cones (Dikin's ellipsoid: Nesterov & Nemirovskii
/// 1994), longer ones may leave them: the caller looks. Forces near the surface of their cones, or none,
/// count as a thousandth of the mean: without that S has no digits left where they carry a load. \param
/// program without multiplier; its inertia, gaps and strengths are not looked at \param near F k \param
/// tolerance of the balance, of the largest entry of the load \param symbolic kept, see form/Form.h \return F
/// k; empty where none balance the load
template<int Rows, int Forces>
Eigen::VectorXd nearestForces(const ConeProgram<Rows, Forces>& program, const Eigen::VectorXd& near,
                              double tolerance, SymbolicAnalysis& symbolic);

/// The least changes of known forces, in the metric of nearestForces, that balance additional loads: one
/// factorisation for all of them.
template<int Rows, int Forces>
class ForceChanges
{
public:
    /// \param ofStructure its load, inertia, gaps and strengths are not looked at \param near forces that are
    /// known, F k
    ForceChanges(ConeProgram<Rows, Forces> ofStructure, const Eigen::VectorXd& near);

    /// \param load R b \param tolerance of the balance, of the largest entry of the load \return F k; empty
    /// where none balance it
    Eigen::VectorXd under(const Eigen::VectorXd& load, double tolerance);

private:
    ConeProgram<Rows, Forces> program;
    SymbolicAnalysis symbolic;
    Form<Rows> form;
    ConeWeights<double> weights;
    bool isFactorised = false;
};

/// Points at which forces come nearer to the surface of the cone than a share of how far others are inside
/// it: none where forces - margin near is in the cones. \param near F k \param forces F k \param margin the
/// share, 0 for the cones themselves \return indices of the points, in rising order
template<int Rows, int Forces>
std::vector<std::size_t> pointsOutside(const ConeProgram<Rows, Forces>& program, const Eigen::VectorXd& near,
                                       const Eigen::VectorXd& forces, double margin);

/// Forces in the cones that balance a load, from others that do so and leave the cones at a few points: those
/// on the bodies around these points are found anew, by a program of their own, under the forces that all
/// others give them, which stay as they are. Bodies up to three neighbours away come first, then those three
/// times as far, until forces are found or a program of all would cost little more.
/// \param program without multiplier; its inertia, gaps and strengths are not looked at
/// \param forces F k with A c = f \param outside points where they leave the cones \param tolerance of the
/// certificate of the small program \param factorisations those taken are added \return F k; empty where none
/// were found
template<int Rows, int Forces>
Eigen::VectorXd repairedForces(const ConeProgram<Rows, Forces>& program, const Eigen::VectorXd& forces,
                               const std::vector<std::size_t>& outside, double tolerance,
                               int& factorisations);

} // namespace drystone
