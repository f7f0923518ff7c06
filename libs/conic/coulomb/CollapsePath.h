// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Collapse by Coulomb's law: from forces at rest along the path of a structure with elastic joints, pushed
/// until nothing but its mechanism moves.
#pragma once

#include "conic/ConeProgram.h"

#include <functional>

namespace drystone
{

/// What a path to a collapse begins with and when it ends.
struct CollapsePathSettings
{
    double dilatancy = 0; ///< psi: opening over slip; at most the friction coefficient of a point
    /// The pair's psi: where it is less, the path goes on with it after the end of the first.
    double finalDilatancy = 0;
    double stiffnessSpread = 0.2; ///< stiffnesses of the points lie between exp(-spread) and exp(spread)
    unsigned seed = 1;            ///< of the random numbers that they are
    /// Of the path; 0: 1,000 and ten for each contact point, in space four.
    int maximumPieces = 0;
    /// Called after each piece with their number so far and the multiplier there. May be empty.
    std::function<void(int pieces, double multiplier)> observe = {};
    std::function<bool()> isOver = {}; ///< called before each piece: the path may end there. May be empty
};

/// Where a path leads.
enum class PathEnd
{
    collapse,   ///< a pair of forces and mechanism on which the live load does work
    fall,       ///< a pair on whose mechanism it does none: the dead load alone drives it
    reversed,   ///< a pair on whose mechanism it does negative work
    unfinished, ///< the pieces are used up, rounding ends the path, or the load grows without limit
    stopped     ///< as `isOver` has requested
};

/// A pair of forces and mechanism that obey Coulomb's law without dilatancy:
///
///     A c = f + alpha L,    -T <= c_n <= N,    |c_t| <= C + mu c_n,
///     c_n = -T where (A'y)_n < 0 (the point opens),  c_n = N where it closes,
///     c_t at its limit along (A'y)_t where that is not zero.
struct CollapsePair
{
    PathEnd end = PathEnd::unfinished;
    double multiplier = 0;        ///< alpha
    Eigen::VectorXd contactForce; ///< c, F k
    Eigen::VectorXd mechanism;    ///< y, R b: L'y = 1 for a collapse, else largest entry 1
    int pieces = 0;               ///< of the path
    int factorisations = 0;
    int solves = 0;
};

/// The points get a stiffness k each. From the given forces s the structure is pushed by the live load; with
/// w = s + k A'v, of displacements v,
///
///     A c(w) = f + alpha L,    c_n = w_n between -T and N,    c_t = w_t cut off at C + mu c_n:    (1)
///
/// as many equations as v has entries, and alpha in addition. Their solutions are a path from v = 0. It ends
/// where v grows without limit: forces are bounded there, so that k A'v can grow only in the directions that
/// c(w) does not follow: opening, slip at its limit, crushing. The final direction of v is a mechanism, and
/// it and the final forces are a pair. Elasticity, which chooses among the pairs, has no part in it.
///
/// In the plane (1) is linear in pieces between points that change their state, so that the path is followed
/// from one change to the next without error: each takes a factorisation of K = A (dc/dw) k A', whose
/// solution K p = L is the direction of the path. The sense is that in which the last point to change moves
/// on into its new state; alpha and L'v may turn back on the way. In space the direction of slip turns, and
/// steps are short enough for one correction each.
///
/// That a path leads to collapse is not guaranteed, and another start or seed leads to another pair: the law
/// has many. With dilatancy a pair opens by psi times its slip, and has no stone that falls out of its place
/// without work of the live load: its wedging holds it.
///
/// \param contactForce s, which balance f + multiplier L within the limits, best not all at them
/// \return the pair where `end` is neither `unfinished` nor `stopped`. It proves nothing: judge it
/// \throws std::invalid_argument for a program with inertia or compliance or gaps, without live load
template<int Rows, int Forces>
CollapsePair followCollapsePath(const ConeProgram<Rows, Forces>& program, const Eigen::VectorXd& contactForce,
                                double multiplier, const CollapsePathSettings& settings = {});

} // namespace drystone
