// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
#include "conic/coulomb/ContactPath.h"

#include <Eigen/LU>
#include <Eigen/QR>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace drystone
{
namespace
{

/// Forces below this share of the largest are none, and a shear nearer than this to its limit is at it.
constexpr double negligibleForce = 1e-9;

/// How far inside its piece a point begins whose force does not say, as a share of the largest force; points
/// differ in it, so that they do not change their states at one instant.
constexpr double margin = 1e-6;

/// Changes of rank 1 from which the matrix is factorised anew: a solve costs a tenth of a factorisation or
/// less, and each change adds a product to it.
constexpr std::size_t mostChanges = 24;

/// Ends of a path at which it goes on from their pieces, at most: nearly all are right then.
constexpr int mostEnds = 4;

/// Where corrections gain nothing any more, the error that may be left in overlaps, as a share of the
/// largest.
constexpr double asGoodAsItGets = 0.5;

/// What a solution of the linear system may leave of the right-hand side, and the directions tried to
/// have it so.
constexpr double acceptedLoss = 1e-10;
constexpr int mostDirections = 30;

bool haveSameColumns(const std::vector<ConeColumns<3, 2>>& some, const std::vector<ConeColumns<3, 2>>& others)
{
    return std::equal(some.begin(), some.end(), others.begin(), others.end(),
                      [](const ConeColumns<3, 2>& a, const ConeColumns<3, 2>& b)
                      { return a.onFirst == b.onFirst && a.onSecond == b.onSecond; });
}

} // namespace

ContactPath::ContactPath(const PlaneConeProgram& program, const ConeSolution& startAt,
                         const ContactPathSettings& with, SymbolicAnalysis& symbolic)
    : settings(with), system(program, with.sliding, symbolic), start(startAt.displacement)
{
    if (!program.hasInertia() || program.hasMultiplier() || program.hasCompliance() || program.hasCrushing()
        || (program.hasStrength() && settings.sliding == Sliding::associative))
    {
        throw std::invalid_argument("ContactPath needs inertia and rigid points that do not crush");
    }
    if (start.size() != program.load.size() || startAt.contactForce.size() != 2 * program.points())
    {
        throw std::invalid_argument("ContactPath needs a start of the size of the program");
    }
    laws = slidingLaws(program, settings.sliding);
    load = system.scaledRows(program.load - applyInertia(program, start));
    enough = settings.tolerance * system.scaledRows(program.load).lpNorm<Eigen::Infinity>();
    rho = VectorXd::Constant(program.points(), settings.stiffness);
    x = VectorXd::Zero(load.size());
    gap = (program.gap.size() > 0 ? program.gap : VectorXd::Zero(2 * program.points()))
          - applyTransposed(program, start);
    begin(startAt.contactForce);
}

/// States and w0 of forces: of what they leave open, such as how far an open point is from closing, as near
/// as may be to k (A'y - g).
void ContactPath::begin(const VectorXd& startForce)
{
    using State = PointState<2>;
    w = -settings.stiffness * gap;
    states.resize(laws.size());
    const double largest = startForce.size() > 0 ? startForce.lpNorm<Eigen::Infinity>() : 0;
    const double least = negligibleForce * largest;
    for (std::size_t point = 0; point < laws.size(); ++point)
    {
        const auto row = 2 * static_cast<Eigen::Index>(point);
        const SlidingLaw& law = laws[point];
        auto trial = w.segment<2>(row);
        const double normal = startForce[row];
        const double shear = startForce[row + 1];
        // Golden sections spread evenly however many there are.
        const double part = std::fmod(0.6180339887498949 * static_cast<double>(point), 1.0);
        const double inside = margin * (1 + part) * std::max(largest, std::numeric_limits<double>::min());
        State& state = states[point];
        const double held = std::max(normal, -law.tension);
        const double limit = law.cohesion + law.mu * held;
        state.normal = normal > -law.tension + least ? State::Normal::presses : State::Normal::open;
        state.shear = std::abs(shear) < (1 - negligibleForce) * limit - least ? State::Shear::sticks
                                                                              : State::Shear::slides;
        const double side = shear != 0 ? shear : trial[1];
        state.direction[0] = side < 0 ? -1 : 1;
        if (law.sliding == Sliding::associative)
        {
            if (!state.presses())
            {
                const double beyond = trial[0] + law.mu * std::abs(trial[1]);
                trial[0] -= beyond > -inside ? beyond + inside : 0;
            }
            else if (state.sticks())
            {
                trial << normal, shear;
            }
            else
            {
                // w = c + a (-mu, e) with a > 0 has this c for its nearest point of the cone.
                const Eigen::Vector2d outwards(-law.mu, state.direction[0]);
                const double natural = outwards.dot(trial) / outwards.squaredNorm();
                trial = Eigen::Vector2d(normal, state.direction[0] * law.mu * normal)
                        + std::max(natural, inside) * outwards;
            }
            continue;
        }
        trial[0] = state.presses() ? normal : std::min(trial[0], -law.tension - inside);
        if (state.sticks())
        {
            trial[1] = shear;
        }
        else if (limit > least || state.presses())
        {
            trial[1] = state.direction[0] * std::max(limit + inside, state.direction[0] * trial[1]);
        }
        else
        {
            state.direction[0] = trial[1] < 0 ? -1 : 1;
        }
    }
    findForces();
}

void ContactPath::findForces()
{
    force.resize(w.size());
    for (std::size_t point = 0; point < laws.size(); ++point)
    {
        const auto row = 2 * static_cast<Eigen::Index>(point);
        const Eigen::Vector2d trial = w.segment<2>(row);
        force.segment<2>(row) = forceOn<2>(laws[point], stateOf<2>(laws[point], trial), trial).force;
    }
}

/// The states of w.
void ContactPath::findPieces()
{
    for (std::size_t point = 0; point < laws.size(); ++point)
    {
        const Eigen::Vector2d trial = w.segment<2>(2 * static_cast<Eigen::Index>(point));
        states[point] = stateOf<2>(laws[point], trial);
    }
    findForces();
    isFactorised = false;
}

Eigen::VectorXd ContactPath::residual() const
{
    return load - x - system.forcesOnBodies(force);
}

bool ContactPath::factorise()
{
    pieces.resize(states.size());
    for (std::size_t point = 0; point < states.size(); ++point)
    {
        const Eigen::Vector2d trial = w.segment<2>(2 * static_cast<Eigen::Index>(point));
        pieces[point] = forceOn<2>(laws[point], states[point], trial);
    }
    changes.clear();
    ++factorisations;
    isFactorised = system.factorise(rho, pieces);
    return isFactorised;
}

/// S^-1 b from S0^-1 b, one change after the other (Sherman & Morrison).
Eigen::VectorXd ContactPath::corrected(VectorXd solved) const
{
    for (const Change& change : changes)
    {
        const double along = change.v.dot(system.closing(change.point, solved));
        solved -= along / change.determinant * change.solved;
    }
    return solved;
}

Eigen::VectorXd ContactPath::solve(const VectorXd& rows)
{
    return corrected(system.solve(rows));
}

/// S times a direction, in the states of now.
Eigen::VectorXd ContactPath::times(const VectorXd& direction) const
{
    VectorXd change = settings.stiffness * system.closings(direction);
    for (std::size_t point = 0; point < laws.size(); ++point)
    {
        const auto row = 2 * static_cast<Eigen::Index>(point);
        const Eigen::Vector2d trial = w.segment<2>(row);
        change.segment<2>(row) =
            (forceOn<2>(laws[point], states[point], trial).derivative * change.segment<2>(row)).eval();
    }
    return direction + system.forcesOnBodies(change);
}

/// LU without exchange of rows between blocks may lose all digits where blocks slide freely. What it leaves
/// is then of few dimensions, and the method of generalised minimal residuals (Saad & Schultz 1986), with LU
/// as its preconditioner, ends in as many steps.
Eigen::VectorXd ContactPath::solveExactly(const VectorXd& rows)
{
    VectorXd solved = solve(rows);
    const double size = rows.norm();
    if (!((rows - times(solved)).norm() > acceptedLoss * size))
    {
        return solved;
    }
    Eigen::MatrixXd basis(rows.size(), mostDirections + 1);
    Eigen::MatrixXd directions(rows.size(), mostDirections);
    Eigen::MatrixXd projected = Eigen::MatrixXd::Zero(mostDirections + 1, mostDirections);
    basis.col(0) = rows / size;
    for (int step = 0; step < mostDirections; ++step)
    {
        directions.col(step) = solve(basis.col(step));
        VectorXd next = times(directions.col(step));
        for (int pass = 0; pass < 2; ++pass)
        {
            const VectorXd along = basis.leftCols(step + 1).transpose() * next;
            next -= basis.leftCols(step + 1) * along;
            projected.col(step).head(step + 1) += along;
        }
        const double left = next.norm();
        projected(step + 1, step) = left;
        VectorXd target = VectorXd::Zero(step + 2);
        target[0] = size;
        const Eigen::MatrixXd matrix = projected.topLeftCorner(step + 2, step + 1);
        const VectorXd shares = matrix.colPivHouseholderQr().solve(target);
        const double residualLeft = (target - matrix * shares).norm();
        if (!(residualLeft > acceptedLoss * size) || step + 1 == mostDirections || !(left > 0))
        {
            return directions.leftCols(step + 1) * shares;
        }
        basis.col(step + 1) = next / left;
    }
    return solved;
}

/// The point changes its state. \return whether there is a matrix for the new piece
bool ContactPath::cross(const Exit& exit, VectorXd& direction, VectorXd& rate)
{
    const auto point = static_cast<std::size_t>(exit.point);
    const Eigen::Vector2d trial = w.segment<2>(2 * exit.point);
    PointState<2> beyond = exit.side.beyond;
    if (!beyond.sticks() && laws[point].sliding == Sliding::coulomb
        && laws[point].cohesion <= laws[point].mu * laws[point].tension && beyond.presses()
        && !states[point].presses())
    {
        beyond.direction[0] = trial[1] < 0 ? -1 : 1; // an open point without cohesion has no shear
    }
    // The law is continuous: its derivative changes by a multiple of the side's normal.
    const Eigen::Matrix2d difference = forceOn<2>(laws[point], beyond, trial).derivative
                                       - forceOn<2>(laws[point], states[point], trial).derivative;
    states[point] = beyond;
    sides[point] = sidesOf(laws[point], beyond);
    const Eigen::Vector2d& v = exit.side.normal;
    const Eigen::Vector2d u = difference * v / v.squaredNorm();
    if (u.isZero(0))
    {
        return true;
    }
    if (changes.size() >= mostChanges)
    {
        direction.resize(0);
        return factorise();
    }
    VectorXd rows = VectorXd::Zero(x.size());
    system.addForce(exit.point, rho[exit.point] * u, rows);
    Change change{exit.point, v, solve(rows), 1};
    change.determinant += v.dot(system.closing(exit.point, change.solved));
    if (change.determinant == 0 || !std::isfinite(change.determinant))
    {
        return false;
    }
    // With S' = S + rho A u (A v)' and r0 - A D dw less by A u (v'dw): the new direction and rate of w.
    const double share = v.dot(rate.segment<2>(2 * exit.point)) / (rho[exit.point] * change.determinant);
    direction -= share * change.solved;
    rate -= share * settings.stiffness * system.closings(change.solved);
    changes.push_back(std::move(change));
    return true;
}

/// \param rate of w, by t \param sense in which t goes \param farthest that it may go \param last where the
/// path came in
ContactPath::Exit ContactPath::firstExit(const VectorXd& rate, double sense, double farthest,
                                         const Exit& last) const
{
    int found = -1;
    double length = farthest;
    for (int point = 0; point < static_cast<int>(laws.size()); ++point)
    {
        const Eigen::Vector2d trial = w.segment<2>(2 * point);
        const Eigen::Vector2d change = sense * rate.segment<2>(2 * point);
        const PieceSides& of = sides[static_cast<std::size_t>(point)];
        for (int i = 0; i < of.count; ++i)
        {
            const PieceSide& side = of.side[static_cast<std::size_t>(i)];
            const double growth = side.normal.dot(change);
            const double inside = -(side.normal.dot(trial) + side.offset);
            if (growth > 0 && inside < length * growth
                && !(point == last.point && side.normal == -last.side.normal))
            {
                found = 3 * point + i;
                length = std::max(0.0, inside / growth);
            }
        }
    }
    return found < 0
               ? Exit{-1, {Eigen::Vector2d::Zero(), 0, {}}, length}
               : Exit{found / 3,
                      sides[static_cast<std::size_t>(found / 3)].side[static_cast<std::size_t>(found % 3)],
                      length};
}

/// From t = 0 to 1. \param residualOfStart r0 \param change of w but for that of y
bool ContactPath::walk(const VectorXd& residualOfStart, const VectorXd& change)
{
    sides.resize(states.size());
    for (std::size_t point = 0; point < states.size(); ++point)
    {
        sides[point] = sidesOf(laws[point], states[point]);
    }
    double t = 0;
    Exit last;
    VectorXd direction; // dx/dt
    VectorXd rate;      // dw/dt
    for (;;)
    {
        if (direction.size() == 0)
        {
            // S dx = r0 - A D dw.
            VectorXd forceChange(w.size());
            for (std::size_t point = 0; point < laws.size(); ++point)
            {
                const auto row = 2 * static_cast<Eigen::Index>(point);
                const Eigen::Vector2d trial = w.segment<2>(row);
                forceChange.segment<2>(row) =
                    forceOn<2>(laws[point], states[point], trial).derivative * change.segment<2>(row);
            }
            direction = solveExactly(residualOfStart - system.forcesOnBodies(forceChange));
            rate = change + settings.stiffness * system.closings(direction);
        }
        double sense = 1;
        if (last.point >= 0 && settings.sliding == Sliding::coulomb)
        {
            const double beyond = last.side.normal.dot(rate.segment<2>(2 * last.point));
            if (!(beyond != 0))
            {
                return false;
            }
            sense = beyond > 0 ? 1 : -1;
        }
        const double farthest = sense > 0 ? 1 - t : std::numeric_limits<double>::infinity();
        const Exit exit = firstExit(rate, sense, farthest, last);
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
        if (++pivots > mostPivots || !cross(exit, direction, rate))
        {
            return false;
        }
        last = exit;
    }
}

/// Whether what is left of the equations of motion, as displacements, changes forces by a small part only:
/// the displacements that forces give the blocks are then as good.
bool ContactPath::isRounding(const VectorXd& left) const
{
    const VectorXd changed = settings.stiffness * system.closings(left);
    return changed.size() == 0
           || changed.lpNorm<Eigen::Infinity>() <= asGoodAsItGets * force.lpNorm<Eigen::Infinity>();
}

/// Newton's steps in the states reached take away the rounding of the path. w is kept by increments: where a
/// point slides by metres, k (A'x - g) would be rounded to as much as small forces.
bool ContactPath::polish()
{
    constexpr int mostSteps = 6;
    double before = std::numeric_limits<double>::infinity();
    for (int step = 0; step <= mostSteps; ++step)
    {
        findForces();
        const VectorXd left = residual();
        const double now = left.lpNorm<Eigen::Infinity>();
        if (now <= enough || (now > 0.5 * before && isRounding(left)))
        {
            return true;
        }
        if (!(now < 10 * before))
        {
            return false;
        }
        before = now;
        // In the states of the path, not in those of w: by rounding a point may be beyond a side.
        VectorXd ofPieces(w.size());
        for (std::size_t point = 0; point < laws.size(); ++point)
        {
            const auto row = 2 * static_cast<Eigen::Index>(point);
            const Eigen::Vector2d trial = w.segment<2>(row);
            ofPieces.segment<2>(row) = forceOn<2>(laws[point], states[point], trial).force;
        }
        const VectorXd moved = solveExactly(load - x - system.forcesOnBodies(ofPieces));
        x += moved;
        w += settings.stiffness * system.closings(moved);
    }
    return false;
}

bool ContactPath::follow(const PlaneConeProgram& program)
{
    mostPivots = pivots + settings.maximumPivots;
    if (pieces.empty() || !haveSameColumns(program.contacts, given))
    {
        isFactorised = false;
        given = program.contacts;
        system.setColumns(program);
    }
    gap = (program.gap.size() > 0 ? program.gap : VectorXd::Zero(2 * program.points()))
          - applyTransposed(program, start);
    // Where points have been far open, or have slid far, w has lost digits, and the piece that the path ends
    // on may not be that of its solution: then the path goes on from the pieces of its end.
    for (int round = 0; round < mostEnds; ++round)
    {
        const VectorXd change = settings.stiffness * (system.closings(x) - gap) - w;
        const VectorXd residualOfStart = residual();
        if (!(isFactorised || factorise()) || !walk(residualOfStart, change))
        {
            return false;
        }
        const VectorXd end = x;
        const VectorXd trialAtEnd = w;
        if (polish() || (!changes.empty() && factorise() && polish()))
        {
            return true;
        }
        x = end;
        w = trialAtEnd;
        findPieces();
    }
    return false;
}

Eigen::VectorXd ContactPath::displacement() const
{
    return start + system.displacementOf(x);
}

} // namespace drystone
