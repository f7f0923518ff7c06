// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// From a small penalty, which soon finds how the structure moves as a whole, to larger ones for its points.
#include "conic/coulomb/AlternatingDirections.h"

#include "conic/cones/RoundPacks.h"
#include "conic/form/FormOperators.h"
#include "conic/form/FormSchur.h"

#include <algorithm>
#include <array>
#include <stdexcept>

namespace drystone
{
namespace
{

using Eigen::VectorXd;
using Number = Abreast<double>; ///< of four round cones at once

constexpr int rows = 6;

/// Of the paper's walls in space and of houses, 1 alone is slow in the end, 10 alone at first.
struct Stage
{
    double penalty; ///< sigma, where inertia is of order one
    int begin;      ///< iteration
};
constexpr std::array<Stage, 3> stages{{{1, 0}, {3, 100}, {10, 250}}};

constexpr double relaxation = 1.6;

constexpr double leastRadius = 1e-300; ///< of what has no direction

/// The motion is compared with that of so many iterations before.
constexpr int iterationsToACheck = 25;

class AlternatingDirections
{
public:
    AlternatingDirections(const SpaceConeProgram& increment, SymbolicAnalysis& symbolic)
        : form(makeForm(increment, symbolic)),
          cones(form.cones()),
          system(schurSystem(form, symbolic)),
          y(VectorXd::Zero(form.load.size()))
    {
        for (std::size_t point = 0; point + 1 < form.firstRound.size(); ++point)
        {
            for (int round = form.firstRound[point]; round < form.firstRound[point + 1]; ++round)
            {
                for (int ray = form.firstRay[point]; ray < form.firstRay[point + 1]; ++ray)
                {
                    besides.push_back({ray, round});
                }
            }
        }
        w.resize(cones.size());
        open();
        v = gap - closing;
        project();
        v = w; // no forces
    }

    /// \return whether S with this penalty could be factorised
    bool weigh(double newPenalty)
    {
        project();
        v = w + penalty / newPenalty * (v - w); // the forces stay
        penalty = newPenalty;
        ConeWeights<double> weights;
        weights.rays = VectorXd::Constant(cones.rays, penalty);
        weights.rounds.assign(
            static_cast<std::size_t>(cones.rounds),
            FramedMatrix<double>{Eigen::Vector2d::UnitX(), Eigen::Vector3d::Constant(penalty)});
        assembleSchur(form, weights, 0, 0, system);
        return system.factorise();
    }

    void iterate()
    {
        project();
        pull = penalty * (gap - 2 * w + v); // sigma (g + o - w) - c
        y = form.load;
        addForces(form, pull, y);
        system.solve(y.head(rows * form.bodies));
        y.tail<rows>().setZero();
        open();
        v += relaxation * (gap - closing - w);
    }

    const VectorXd& displacement() const { return y; } ///< ground at rest

    /// In the program's own units.
    ConeSolution solution(const SpaceConeProgram& increment)
    {
        project();
        return solutionOf(increment, form, VectorXd(penalty * (w - v)), y, 0.0);
    }

private:
    /// w: the openings nearest to v that are inside the cones, by the positive parts of the eigenvalues.
    void project()
    {
        w.head(cones.rays) = v.head(cones.rays).cwiseMax(0.0);
        forPacks<Number>(
            cones.rounds,
            [&](const Pack& pack)
            {
                const Eigen::Index first = cones.at(pack.round);
                const ConeVector<Number> x = taken(v, first, pack.count);
                const Number radius = sqrt(x[1] * x[1] + x[2] * x[2]);
                const Number one = larger<Number>(x[0] + radius, 0.0);
                const Number other = larger<Number>(x[0] - radius, 0.0);
                const Number share = 0.5 * (one - other) / larger<Number>(radius, leastRadius);
                put<double>({0.5 * (one + other), share * x[1], share * x[2]}, first, pack.count, w);
            });
    }

    /// g + o and B'y: with T = diag(1, mu, mu)/sqrt(1 + mu2) of a round cone mu |u_t| opens it by |z_t|.
    void open()
    {
        applyTransposed(form, y, closing);
        gap = form.gap;
        forPacks<Number>(cones.rounds,
                         [&](const Pack& pack)
                         {
                             const Eigen::Index first = cones.at(pack.round);
                             ConeVector<Number> opened = taken(form.gap, first, pack.count);
                             const ConeVector<Number> closed = taken(closing, first, pack.count);
                             const Number along = opened[1] - closed[1];
                             const Number across = opened[2] - closed[2];
                             opened[0] += sqrt(along * along + across * across);
                             put<double>(opened, first, pack.count, gap);
                         });
        for (const BesideRound& beside : besides)
        {
            const Eigen::Index round = cones.at(beside.round);
            gap[beside.ray] += (gap[round] - form.gap[round])
                               * form.directions[static_cast<std::size_t>(beside.ray)][0]
                               / form.roundScales[static_cast<std::size_t>(beside.round)][0];
        }
    }

    /// A ray along the normal of a point with a round cone, which its sliding opens as well.
    struct BesideRound
    {
        int ray;
        int round;
    };

    Form<rows> form;
    const ConeRanges cones;
    SchurSystem<rows>& system;
    double penalty = 1; ///< sigma
    VectorXd y;
    VectorXd gap; ///< g + o, as the cones, like all below
    VectorXd v;
    VectorXd w;
    VectorXd pull;
    VectorXd closing; ///< B'y
    std::vector<BesideRound> besides;
};

/// \throws std::invalid_argument for a program that the iterations are not made for
void requireRigidCones(const SpaceConeProgram& program)
{
    if (!program.hasInertia() || program.hasMultiplier() || program.hasCompliance() || program.hasStrength())
    {
        throw std::invalid_argument(
            "solveAlternatingDirections needs inertia, rigid points without strength and no multiplier");
    }
}

} // namespace

ConeSolution solveAlternatingDirections(const SpaceConeProgram& program, const VectorXd& expected,
                                        const AlternatingDirectionsSettings& settings,
                                        SymbolicAnalysis& symbolic)
{
    requireRigidCones(program);
    SpaceConeProgram increment = program;
    increment.load -= applyInertia(program, expected);
    increment.gap = gapAfter(program, expected);
    AlternatingDirections iterations(increment, symbolic);
    ConeSolution solution;
    VectorXd before = iterations.displacement();
    std::size_t stage = 0;
    while (solution.status != SolveStatus::optimal && solution.iterations < settings.maximumIterations)
    {
        if (stage < stages.size() && solution.iterations == stages[stage].begin)
        {
            ++solution.factorisations;
            if (!iterations.weigh(stages[stage].penalty))
            {
                break;
            }
            ++stage;
        }
        iterations.iterate();
        ++solution.iterations;
        if (solution.iterations % iterationsToACheck == 0)
        {
            const VectorXd& now = iterations.displacement();
            const double change = (now - before).lpNorm<Eigen::Infinity>();
            if (change <= settings.tolerance * now.lpNorm<Eigen::Infinity>())
            {
                solution.status = SolveStatus::optimal;
            }
            before = now;
        }
    }
    const ConeSolution reached = iterations.solution(increment);
    solution.contactForce = reached.contactForce;
    solution.displacement = reached.displacement + expected;
    return solution;
}

} // namespace drystone
