// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// From a pair of forces and mechanism that obey Coulomb's law to one of a lower multiplier: the exchanges of
/// non-associative limit analysis.
#pragma once

#include "statics/CoulombCheck.h"

#include <functional>
#include <limits>
#include <optional>

namespace drystone
{

/// Forces and a mechanism, none to begin with.
struct CoulombPair
{
    double alpha = std::numeric_limits<double>::infinity();
    Eigen::VectorXd contactForce;
    Eigen::VectorXd mechanism;
    CoulombResiduals residuals;
    bool exists() const { return contactForce.size() > 0; }
};

/// A pair with the least multiplier that its mechanism allows.
struct LeastPair
{
    CoulombPair pair;
    Eigen::VectorXd balance; ///< multipliers of the equations of balance
};

/// Solves the programs of an exchange, and counts their work.
template<int Rows, int Forces>
using ProgramSolver = std::function<ConeSolution(const ConeProgram<Rows, Forces>&)>;

/// Least alpha among the forces that suit the mechanism of a pair: those of points that open or crush
/// stay as they are; at points that slide, t = (C + mu n) d against the slip, so that one column remains,
/// with the constant part as a load; all others are free within their limits.
/// \return none where that program is not solved
template<int Rows, int Forces>
std::optional<LeastPair> leastPair(const ConeProgram<Rows, Forces>& given, const CoulombPair& pair,
                                   const ProgramSolver<Rows, Forces>& solve);

/// For each body the sum of b b' over the columns b of its points, in their units: an inertia against which
/// points with stiffnesses and bodies out of balance may be weighed, where there is no motion.
template<int Rows, int Forces>
std::vector<Eigen::Matrix<double, Rows, Rows>> inertiaOfPoints(const ConeProgram<Rows, Forces>& given);

/// The forces that suit the mechanism of a pair (see leastPair) and leave least out of balance at its
/// multiplier: r = f + alpha L - A c with the least r' M^-1 r, M of inertiaOfPoints. There are such where
/// rounding of the mechanism, as of the direction in which blocks slide, leaves leastPair none; judge whether
/// they are in balance. \return none where that program is not solved
template<int Rows, int Forces>
std::optional<CoulombPair> nearestPair(const ConeProgram<Rows, Forces>& given, const CoulombPair& pair,
                                       const ProgramSolver<Rows, Forces>& solve);

/// Of the mechanisms that forces of a least multiplier allow, one that moves points as little as may be
/// which keep the multiplier from being less:
///
///     minimise  sum_k w_k s_k + v_k o_k    subject to  L'y = 1,
///
/// slips s_k and opening rates o_k of the points where the forces are at their limits; at others nothing
/// moves. The weights are by how much the multiplier would fall for a unit less of shear against the
/// slip, or more of pressure: with u for the multipliers of the equations of balance, L'u = -1,
///
///     w = -d'(A'u)_t,    v = (A'u)_n + mu |(A'u)_t|,    no less than 0.
///
/// Where s_k or o_k becomes zero the next forces have that freedom. \return none where no point is in the
/// way of a lower multiplier, so that it is the least nearby
template<int Rows, int Forces>
std::optional<Eigen::VectorXd> otherMechanism(const ConeProgram<Rows, Forces>& given, const LeastPair& least,
                                              const ProgramSolver<Rows, Forces>& solve);

/// A mechanism that forces allow by Coulomb's law, L'y = 1: of all those the one whose slips, and openings
/// where nothing presses, have the least sum. Judge it: where they allow none it moves points that must not
/// move. \return none where that program is not solved
template<int Rows, int Forces>
std::optional<Eigen::VectorXd> mechanismOf(const ConeProgram<Rows, Forces>& given,
                                           const Eigen::VectorXd& forces,
                                           const ProgramSolver<Rows, Forces>& solve);

} // namespace drystone
