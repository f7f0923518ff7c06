// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Walks by changes of rank 1, polishes the end by Newton's steps, and goes on from it if not right.
#include "conic/coulomb/ContactPath.h"

#include "conic/coulomb/PathStart.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

namespace drystone
{
namespace
{

/// Ends of a path at which it goes on from their pieces, at most: nearly all are right then. In space as many
/// as Newton's method may take steps.
constexpr int mostEnds(int forces)
{
    return forces > 2 ? 30 : 4;
}

/// In space a path that goes back so far in t has left where its tangents mean anything.
constexpr double farthestBack = -0.2;

/// A path that is no farther in t than this has not left its start.
constexpr double nearStart = 1e-5;

/// Where corrections gain nothing any more, the error that may be left in overlaps, as a share of the
/// largest.
constexpr double asGoodAsItGets = 0.5;

template<int Rows, int Forces>
bool haveSameColumns(const std::vector<ConeColumns<Rows, Forces>>& some,
                     const std::vector<ConeColumns<Rows, Forces>>& others)
{
    return std::equal(some.begin(), some.end(), others.begin(), others.end(),
                      [](const ConeColumns<Rows, Forces>& a, const ConeColumns<Rows, Forces>& b)
                      { return a.onFirst == b.onFirst && a.onSecond == b.onSecond; });
}

/// \throws std::invalid_argument for a program or start that no path is for
template<int Rows, int Forces>
const ConeProgram<Rows, Forces>& checked(const ConeProgram<Rows, Forces>& program, const ConeSolution& start,
                                         Sliding sliding)
{
    if (!program.hasInertia() || program.hasMultiplier() || program.hasCompliance() || program.hasCrushing()
        || (program.hasStrength() && sliding == Sliding::associative))
    {
        throw std::invalid_argument("ContactPath needs inertia and rigid points that do not crush");
    }
    if (Forces > 2 && sliding == Sliding::associative)
    {
        throw std::invalid_argument("ContactPath follows the associative law in the plane only");
    }
    if (start.displacement.size() != program.load.size()
        || start.contactForce.size() != Forces * program.points())
    {
        throw std::invalid_argument("ContactPath needs a start of the size of the program");
    }
    return program;
}

} // namespace

template<int Rows, int Forces>
ContactPath<Rows, Forces>::ContactPath(const Program& program, const ConeSolution& startAt,
                                       const ContactPathSettings& with, SymbolicAnalysis& symbolic)
    : settings(with),
      stiffness(with.stiffness),
      system(checked(program, startAt, with.sliding), with.sliding, symbolic),
      matrix(system, with.stiffness),
      start(startAt.displacement)
{
    laws = slidingLaws(program, settings.sliding);
    enough = settings.tolerance * system.scaledRows(program.load).template lpNorm<Eigen::Infinity>();
    x = VectorXd::Zero(program.load.size());
    gap = gapAfter(program, start);
    PathStart<Forces> first = pathStart<Forces>(laws, startAt.contactForce, -stiffness * gap);
    w = std::move(first.w);
    states = std::move(first.states);
    findForces();
}

template<int Rows, int Forces>
void ContactPath<Rows, Forces>::findForces()
{
    force.resize(w.size());
    for (std::size_t point = 0; point < laws.size(); ++point)
    {
        const Force trial = trialOf(static_cast<std::size_t>(point));
        force.template segment<Forces>(Forces * static_cast<Eigen::Index>(point)) =
            forceOn<Forces>(laws[point], stateOf<Forces>(laws[point], trial), trial).force;
    }
}

/// The states of w.
template<int Rows, int Forces>
void ContactPath<Rows, Forces>::findPieces()
{
    for (std::size_t point = 0; point < laws.size(); ++point)
    {
        states[point] = stateOf<Forces>(laws[point], trialOf(point));
    }
    findForces();
    matrix.forget();
}

/// Of the states, on whose pieces w need not be.
template<int Rows, int Forces>
Eigen::VectorXd ContactPath<Rows, Forces>::forceOnPieces() const
{
    VectorXd ofPieces(w.size());
    for (std::size_t point = 0; point < laws.size(); ++point)
    {
        ofPieces.template segment<Forces>(Forces * static_cast<Eigen::Index>(point)) = onPiece(point).force;
    }
    return ofPieces;
}

template<int Rows, int Forces>
Eigen::VectorXd ContactPath<Rows, Forces>::residual() const
{
    return load - x - system.forcesOnBodies(force);
}

template<int Rows, int Forces>
bool ContactPath<Rows, Forces>::factorise()
{
    std::vector<PointForce<Forces>> pieces(states.size());
    for (std::size_t point = 0; point < states.size(); ++point)
    {
        pieces[point] = onPiece(point);
    }
    return matrix.factorise(pieces);
}

/// D of the point becomes `derivative`, u v' more than it was. \return whether there is a matrix for the new
/// piece
template<int Rows, int Forces>
bool ContactPath<Rows, Forces>::changePiece(int point, const Force& u, const Force& v,
                                            const Derivative& derivative, VectorXd& direction, VectorXd& rate)
{
    if (u.isZero(0))
    {
        return true;
    }
    if (matrix.isFull())
    {
        direction.resize(0);
        return factorise();
    }
    const auto* change = matrix.change(point, u, v, derivative);
    if (!change)
    {
        return false;
    }
    // With S' = S + k A u (A v)' and r0 - A D dw less by A u (v'dw): the new direction and rate of w.
    const double share =
        v.dot(rate.template segment<Forces>(Forces * point)) / (stiffness * change->determinant);
    direction -= share * change->solved;
    rate -= share * stiffness * system.closings(change->solved);
    return true;
}

/// The point changes its state. \return whether there is a matrix for the new piece
template<int Rows, int Forces>
bool ContactPath<Rows, Forces>::cross(const Exit& exit, VectorXd& direction, VectorXd& rate)
{
    const auto point = static_cast<std::size_t>(exit.point);
    const SlidingLaw& law = laws[point];
    const Force trial = trialOf(point);
    const PointState<Forces> before = states[point];
    PointState<Forces> here = before;
    PointState<Forces> beyond = exit.side.beyond;
    if (Forces > 2 && !here.sticks())
    {
        // A tangent of elsewhere is turned to that of the side, from where the law goes on without a jump.
        here.turning = beyond.sticks() ? 1 : std::min(1.0, shareAcross<Forces>(law, beyond, trial));
        beyond.turning = beyond.sticks() ? 0 : here.turning;
    }
    if (!beyond.sticks() && law.sliding == Sliding::coulomb && law.cohesion <= law.mu * law.tension
        && beyond.presses() && !before.presses())
    {
        // An open point without cohesion has no shear.
        beyond.direction = directionOf<Forces>(trial.template tail<Forces - 1>());
    }
    states[point] = beyond;
    sides[point] = sidesOf<Forces>(law, beyond);
    if constexpr (Forces > 2)
    {
        const Force across(0, -here.direction[1], here.direction[0]);
        if (!changePiece(exit.point, (here.turning - before.turning) * across, across,
                         forceOn<Forces>(law, here, trial).derivative, direction, rate))
        {
            return false;
        }
        if (direction.size() == 0)
        {
            return true;
        }
    }
    // The law is continuous: its derivative changes by a multiple of the side's normal.
    const Derivative derivative = forceOn<Forces>(law, beyond, trial).derivative;
    const Derivative difference = derivative - forceOn<Forces>(law, here, trial).derivative;
    const Force& v = exit.side.normal;
    return changePiece(exit.point, difference * v / v.squaredNorm(), v, derivative, direction, rate);
}

template<int Rows, int Forces>
void ContactPath<Rows, Forces>::findSides()
{
    sides.resize(states.size());
    for (std::size_t point = 0; point < states.size(); ++point)
    {
        sides[point] = sidesOf<Forces>(laws[point], states[point]);
    }
}

/// D dw: by how much forces change on their pieces. \param change of w
template<int Rows, int Forces>
Eigen::VectorXd ContactPath<Rows, Forces>::forceChange(const VectorXd& change) const
{
    VectorXd changed(change.size());
    for (std::size_t point = 0; point < laws.size(); ++point)
    {
        const auto row = Forces * static_cast<Eigen::Index>(point);
        changed.template segment<Forces>(row) =
            onPiece(point).derivative * change.template segment<Forces>(row);
    }
    return changed;
}

/// In which sense of t a path goes on beyond the side where it came in. \return 1, -1, or 0: along it
template<int Rows, int Forces>
double ContactPath<Rows, Forces>::senseBeyond(const Exit& last, const VectorXd& rate) const
{
    const double beyond = last.side.normal.dot(rate.template segment<Forces>(Forces * last.point));
    return beyond > 0 ? 1 : beyond < 0 ? -1 : 0;
}

/// From t = 0 to 1. \param residualOfStart r0 \param change of w but for that of y
template<int Rows, int Forces>
bool ContactPath<Rows, Forces>::walk(const VectorXd& residualOfStart, const VectorXd& change)
{
    findSides();
    const int pivotsBefore = pivots;
    double t = 0;
    Exit last;
    VectorXd direction; // dx/dt
    VectorXd rate;      // dw/dt
    for (;;)
    {
        if (direction.size() == 0)
        {
            // S dx = r0 - A D dw.
            direction = matrix.solve(residualOfStart - system.forcesOnBodies(forceChange(change)));
            rate = change + stiffness * system.closings(direction);
        }
        double sense = 1;
        if (last.point >= 0 && settings.sliding == Sliding::coulomb)
        {
            sense = senseBeyond(last, rate);
            if (sense == 0)
            {
                return false;
            }
        }
        const double farthest = sense > 0 ? 1 - t : std::numeric_limits<double>::infinity();
        const Exit exit = firstExit(laws, states, sides, w, rate, sense, farthest, last);
        if (!std::isfinite(exit.length))
        {
            return false;
        }
        x += sense * exit.length * direction;
        w += sense * exit.length * rate;
        t += sense * exit.length;
        if (exit.point < 0)
        {
            return true;
        }
        const bool isStuckAtStart =
            std::abs(t) < nearStart && pivots - pivotsBefore > settings.maximumPivotsAtStart;
        if (isStuckAtStart || (Forces > 2 && t < farthestBack))
        {
            return false;
        }
        const bool isOver = ++pivots > mostPivots || matrix.factorisations > settings.maximumFactorisations
                            || (settings.isOver && settings.isOver());
        if (isOver || !cross(exit, direction, rate))
        {
            return false;
        }
        last = exit;
    }
}

/// Whether what is left of the equations of motion, as displacements, changes forces by a small part only:
/// the displacements that forces give the blocks are then as good.
template<int Rows, int Forces>
bool ContactPath<Rows, Forces>::isRounding(const VectorXd& left) const
{
    const VectorXd changed = stiffness * system.closings(left);
    return changed.size() == 0
           || changed.template lpNorm<Eigen::Infinity>()
                  <= asGoodAsItGets * force.template lpNorm<Eigen::Infinity>();
}

/// The tangents of w in the states of the path.
template<int Rows, int Forces>
bool ContactPath<Rows, Forces>::followTangents()
{
    for (std::size_t point = 0; point < laws.size(); ++point)
    {
        turnTangent<Forces>(laws[point], trialOf(point), states[point]);
    }
    return factorise();
}

/// Newton's steps in the states reached take away the rounding of the path. w is kept by increments: where a
/// point slides by metres, k (A'x - g) would be rounded to as much as small forces.
template<int Rows, int Forces>
bool ContactPath<Rows, Forces>::polish()
{
    constexpr int mostSteps = 6;
    constexpr double stalls = 0.5; // in space, where each step takes a factorisation
    double before = std::numeric_limits<double>::infinity();
    for (int step = 0; step <= mostSteps; ++step)
    {
        findForces();
        const VectorXd left = residual();
        const double now = left.template lpNorm<Eigen::Infinity>();
        if (now <= enough || (now > 0.5 * before && isRounding(left)))
        {
            return true;
        }
        if (!(now < 10 * before) || (Forces > 2 && now > stalls * before))
        {
            return false;
        }
        before = now;
        if (Forces > 2 && !followTangents())
        {
            return false;
        }
        // In the states of the path, not in those of w: by rounding a point may be beyond a side.
        const VectorXd moved = matrix.solve(load - x - system.forcesOnBodies(forceOnPieces()));
        x += moved;
        w += stiffness * system.closings(moved);
    }
    return false;
}

template<int Rows, int Forces>
bool ContactPath<Rows, Forces>::follow(const Program& program)
{
    mostPivots = pivots + settings.maximumPivots;
    if (!haveSameColumns(program.contacts, given))
    {
        matrix.forget();
        given = program.contacts;
        system.setColumns(program);
    }
    load = system.scaledRows(program.load - applyInertia(program, start));
    gap = gapAfter(program, start);
    // Where points have been far open, or have slid far, w has lost digits, and the piece that the path ends
    // on may not be that of its solution: then the path goes on from the pieces of its end.
    for (int round = 0; round < mostEnds(Forces); ++round)
    {
        const VectorXd change = stiffness * (system.closings(x) - gap) - w;
        const VectorXd residualOfStart = residual();
        if (!(matrix.isFactorised() || factorise()) || !walk(residualOfStart, change))
        {
            return false;
        }
        const VectorXd end = x;
        const VectorXd trialAtEnd = w;
        if (polish() || (matrix.isChanged() && factorise() && polish()))
        {
            return true;
        }
        x = end;
        w = trialAtEnd;
        findPieces();
    }
    return false;
}

template<int Rows, int Forces>
Eigen::VectorXd ContactPath<Rows, Forces>::displacement() const
{
    return start + system.displacementOf(x);
}

template class ContactPath<3, 2>;
template class ContactPath<6, 3>;

} // namespace drystone
