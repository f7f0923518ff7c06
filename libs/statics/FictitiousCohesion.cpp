// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Rounds of rough programs that settle the pressures, and exact ones for mechanisms and what suits them.
#include "statics/FictitiousCohesion.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace drystone
{
namespace
{

using Eigen::VectorXd;

constexpr int mostRounds = 60;

/// The share q of friction is less by this factor in each round, down to the least.
constexpr double factor = 0.6;
constexpr double leastShare = 1e-4;

/// From this share on every so many rounds try a mechanism.
constexpr double triesFrom = 1e-2;
constexpr int triesEach = 3;

/// Mechanisms and the forces that suit them take turns while the residual falls by this factor.
constexpr double nearer = 0.5;
constexpr int mostTurns = 8;

/// What a program of a round is made from.
struct Round
{
    VectorXd pressure; ///< n', one a point
    double share;      ///< q
};

template<int Rows, int Forces>
ConeProgram<Rows, Forces> withCohesion(const ConeProgram<Rows, Forces>& given, const Round& round)
{
    ConeProgram<Rows, Forces> program = given;
    program.strength.resize(static_cast<std::size_t>(given.points()));
    for (int point = 0; point < given.points(); ++point)
    {
        const auto at = static_cast<std::size_t>(point);
        program.friction[at] = round.share * given.friction[at];
        program.strength[at].cohesion +=
            (1 - round.share) * given.friction[at] * std::max(0.0, round.pressure[point]);
    }
    return program;
}

template<int Forces>
VectorXd pressures(const VectorXd& contactForce)
{
    return contactForce(Eigen::seq(0, Eigen::last, Forces));
}

/// The forces that Coulomb's law names where points open, or crush; nearestPair chooses the others.
template<int Rows, int Forces>
VectorXd forcesOfRates(const ConeProgram<Rows, Forces>& given, const VectorXd& mechanism)
{
    const VectorXd closing = applyTransposed(given, mechanism);
    VectorXd forces = VectorXd::Zero(closing.size());
    for (int point = 0; point < given.points(); ++point)
    {
        const auto at = static_cast<std::size_t>(point);
        const Strength strength = given.strengthOf(at);
        auto force = forces.segment<Forces>(Forces * point);
        force[0] = closing[Forces * point] > 0 && std::isfinite(strength.crushing) ? strength.crushing
                                                                                   : -strength.tension;
        const double limit = std::max(0.0, strength.cohesion + given.friction[at] * force[0]);
        const auto slip = closing.segment<Forces - 1>(Forces * point + 1);
        force.template tail<Forces - 1>() = limit * slip.stableNormalized();
    }
    return forces;
}

/// Turns of a mechanism and the forces that suit it. \param pressure n' to begin with; those of the last turn
template<int Rows, int Forces>
std::optional<CoulombPair> takeTurns(const ConeProgram<Rows, Forces>& given, VectorXd& pressure,
                                     const CohesionTools<Rows, Forces>& tools)
{
    double before = std::numeric_limits<double>::infinity();
    for (int turn = 0; turn < mostTurns && !tools.isOver(); ++turn)
    {
        const std::optional<CoulombPair> moving =
            mechanismOfPressures<Rows, Forces>(given, pressure, tools.exactly);
        if (!moving)
        {
            return std::nullopt;
        }
        std::optional<CoulombPair> nearest = nearestPair<Rows, Forces>(given, *moving, tools.exactly);
        if (!nearest || tools.isPair(*nearest))
        {
            return nearest;
        }
        const double now = nearest->residuals.worst();
        if (!(now < nearer * before))
        {
            return std::nullopt;
        }
        before = now;
        pressure = pressures<Forces>(nearest->contactForce);
    }
    return std::nullopt;
}

} // namespace

template<int Rows, int Forces>
std::optional<CoulombPair> pairByCohesion(const ConeProgram<Rows, Forces>& given, const VectorXd& forces,
                                          const CohesionTools<Rows, Forces>& tools)
{
    Round round{pressures<Forces>(forces), 1};
    for (int number = 0; number < mostRounds && !tools.isOver(); ++number)
    {
        round.share = std::max(leastShare, factor * round.share);
        const ConeSolution solved = tools.roughly(withCohesion(given, round));
        if (solved.status != SolveStatus::optimal)
        {
            return std::nullopt;
        }
        tools.observe(number + 1, solved.multiplier);
        round.pressure = pressures<Forces>(solved.contactForce);
        if (round.share <= triesFrom && number % triesEach == 0)
        {
            std::optional<CoulombPair> pair = takeTurns(given, round.pressure, tools);
            if (pair)
            {
                return pair;
            }
        }
    }
    return std::nullopt;
}

template<int Rows, int Forces>
std::optional<CoulombPair> mechanismOfPressures(const ConeProgram<Rows, Forces>& given,
                                                const VectorXd& pressure,
                                                const ProgramSolver<Rows, Forces>& solve)
{
    const ConeSolution moving = solve(withCohesion(given, {pressure, 0}));
    const double power = given.liveLoad.dot(moving.displacement);
    if (moving.status != SolveStatus::optimal || !(power > 0))
    {
        return std::nullopt;
    }
    CoulombPair pair{moving.multiplier, {}, moving.displacement / power, {}};
    pair.contactForce = forcesOfRates(given, pair.mechanism);
    return pair;
}

template std::optional<CoulombPair> mechanismOfPressures(const PlaneConeProgram& given,
                                                         const VectorXd& pressure,
                                                         const ProgramSolver<3, 2>& solve);
template std::optional<CoulombPair> mechanismOfPressures(const SpaceConeProgram& given,
                                                         const VectorXd& pressure,
                                                         const ProgramSolver<6, 3>& solve);
template std::optional<CoulombPair> pairByCohesion(const PlaneConeProgram& given, const VectorXd& forces,
                                                   const CohesionTools<3, 2>& tools);
template std::optional<CoulombPair> pairByCohesion(const SpaceConeProgram& given, const VectorXd& forces,
                                                   const CohesionTools<6, 3>& tools);

} // namespace drystone
