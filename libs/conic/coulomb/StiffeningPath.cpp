// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The other way of a contact path: not from forces to forces, but from soft points to stiff ones.
#include "conic/coulomb/ContactPath.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace drystone
{
namespace
{

/// Lengths of linear pieces, as shares of the stiffness: the first, the longest, and the shortest, which is
/// taken as it is.
constexpr double firstLength = 0.2;
constexpr double longestLength = 0.5;
constexpr double shortestLength = 2e-3;
constexpr double shortened = 0.25;

/// By how much, of the largest force, points may be outside their pieces where a linear piece ends and the
/// next begins: farther, and it has missed a change of state.
constexpr double missed = 1e-2;

/// A path that has come back to points softer than those it began with, by this factor, is lost.
constexpr double softerThanStart = 0.05;

} // namespace

/// How the path goes on from one of its linear pieces to the next.
template<int Rows, int Forces>
struct ContactPath<Rows, Forces>::Travel
{
    double sense = 1; ///< 1 towards stiffer points, or -1
    VectorXd rate;    ///< of w, by the piece before; empty at the start
};

/// Newton's method on the pieces, where the problem is linear: x and w of the stiffness, to rounding. w by
/// increments (polish).
template<int Rows, int Forces>
void ContactPath<Rows, Forces>::settleOnPieces()
{
    constexpr int rounds = 2;
    for (int round = 0; round < rounds; ++round)
    {
        const VectorXd change = stiffness * (system.closings(x) - gap) - w;
        const VectorXd moved =
            matrix.solve(load - x - system.forcesOnBodies(forceOnPieces() + forceChange(change)));
        x += moved;
        w += change + stiffness * system.closings(moved);
    }
}

/// How far outside its piece a point is, of all the farthest [N].
template<int Rows, int Forces>
double ContactPath<Rows, Forces>::farthestOutside() const
{
    double farthest = 0;
    for (std::size_t point = 0; point < sides.size(); ++point)
    {
        for (int i = 0; i < sides[point].count; ++i)
        {
            const PieceSide<Forces>& side = sides[point].side[static_cast<std::size_t>(i)];
            farthest = std::max(farthest, side.normal.dot(trialOf(point)) + side.offset);
        }
    }
    return farthest;
}

/// One linear piece: with k = (1 + t) k0 the derivatives at t = 0 are
///
///     dx + A D dw = 0,    dw = w + k0 A'dx,    or    (1 + k0 A D A') dx = -A D w,
///
/// exact at open points of blocks that stay where they are. \param travel at its begin, then at its end
/// \param length of t, either way \param farthest t \return whether there is a way on
template<int Rows, int Forces>
bool ContactPath<Rows, Forces>::walkStiffening(Travel& travel, double length, double farthest)
{
    const VectorXd change = w;
    VectorXd direction = matrix.solve(-system.forcesOnBodies(forceChange(change)));
    VectorXd rate = change + stiffness * system.closings(direction);
    // A curve that turns back within a piece: the sense in which w goes on is kept.
    const bool turns = travel.rate.size() > 0 && travel.rate.dot(rate) < 0;
    double sense = turns ? -travel.sense : travel.sense;
    double t = 0;
    Exit last;
    for (;;)
    {
        if (last.point >= 0)
        {
            sense = senseBeyond(last, rate);
            if (sense == 0)
            {
                return false;
            }
        }
        const double toEnd = sense > 0 ? std::min(length, farthest) - t : length + t;
        const Exit exit = firstExit(laws, states, sides, w, rate, sense, toEnd, last);
        // Half of the way to the next change, so that no point is at a side when k becomes another.
        const bool isFull = exit.point >= 0 && matrix.isFull();
        const double move = sense * (isFull ? 0.5 : 1) * exit.length;
        x += move * direction;
        w += move * rate;
        t += move;
        if (isFull || exit.point < 0)
        {
            break;
        }
        if (++pivots > mostPivots || !cross(exit, direction, rate))
        {
            return false;
        }
        last = exit;
    }
    travel = {sense, std::move(rate)};
    stiffness *= 1 + t;
    return true;
}

/// The solutions of
///
///     Mbar y + A law(w) = f,      w = k (A'y - g)
///
/// for all k are curves. Of soft points there is one solution, and none is far away, since y'A law(k A'y) >=
/// 0: work is done on the points, never by them. So the curve that begins there can neither end nor come
/// back, and leads to every k (degree theory: Allgower & Georg 1990, Numerical Continuation Methods), though
/// not straight: by Coulomb's law solutions are not unique, and where two of them meet the curve turns back
/// in k. A path from the solution of one k to that of a larger one may not exist there at all; `follow` then
/// goes to where its equations are those of nothing. On a piece of the law the curve is nearly straight, and
/// is followed by linear pieces, each as long as the changes of state that it goes through are the right
/// ones.
template<int Rows, int Forces>
bool ContactPath<Rows, Forces>::stiffen(double toStiffness)
{
    mostPivots = pivots + settings.maximumPivots;
    const double least = softerThanStart * stiffness;
    struct Halt
    {
        VectorXd x, w;
        std::vector<PointState<Forces>> states;
        double stiffness;
        Travel travel;
    };
    Travel travel;
    Halt halt{x, w, states, stiffness, travel}; // where the last piece began
    double length = firstLength;
    bool isBack = true;
    while (matrix.factorisations < settings.maximumFactorisations && stiffness > least)
    {
        matrix.setStiffness(stiffness);
        if (!factorise())
        {
            return false;
        }
        settleOnPieces();
        findSides();
        const double allowed = missed * forceOnPieces().template lpNorm<Eigen::Infinity>();
        if (!isBack && length > shortestLength && farthestOutside() > allowed)
        {
            x = halt.x;
            w = halt.w;
            states = halt.states;
            stiffness = halt.stiffness;
            travel = halt.travel;
            length *= shortened;
            isBack = true;
            continue;
        }
        if (stiffness >= toStiffness)
        {
            findForces();
            return true;
        }
        halt = {x, w, states, stiffness, travel};
        length = isBack ? length : std::min(longestLength, 2 * length);
        isBack = false;
        if (!walkStiffening(travel, length, toStiffness / stiffness - 1))
        {
            return false;
        }
        // To the last bit, where it has come to the end.
        stiffness = stiffness >= toStiffness * (1 - 1e-12) ? toStiffness : stiffness;
    }
    return false;
}

template void ContactPath<3, 2>::settleOnPieces();
template double ContactPath<3, 2>::farthestOutside() const;
template bool ContactPath<3, 2>::walkStiffening(Travel&, double, double);
template bool ContactPath<3, 2>::stiffen(double);

} // namespace drystone
