// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Beside the multiplier it proves that the dead load alone is carried, or by a mechanism that it is not.
#include "statics/LimitAnalysis.h"

#include "conic/form/Form.h"
#include "statics/CompletedAnalysis.h"

#include <algorithm>
#include <cmath>

namespace drystone
{
namespace
{

/// Scaled so that its largest entry is 1; unchanged when it is zero.
Eigen::VectorXd normalised(const Eigen::VectorXd& mechanism)
{
    const double largest = mechanism.size() > 0 ? mechanism.lpNorm<Eigen::Infinity>() : 0;
    return largest > 0 ? Eigen::VectorXd(mechanism / largest) : mechanism;
}

/// What is left of a multiplier of zero by rounding is zero.
template<int Rows, int Forces>
double withoutRounding(double multiplier, const ConeProgram<Rows, Forces>& program, double tolerance)
{
    constexpr double largest = 1e-12; // however small the live load is
    const double zero = std::min(largest, tolerance * program.load.template lpNorm<Eigen::Infinity>()
                                              / program.liveLoad.template lpNorm<Eigen::Infinity>());
    return std::abs(multiplier) < zero ? 0 : multiplier;
}

} // namespace

template<int Dim>
StaticProgram<Dim> limitAnalysisProgram(int freeBlocks, const std::vector<ContactColumns<Dim>>& columns,
                                        const std::vector<double>& friction, const LoadVectors& loads)
{
    StaticProgram<Dim> program;
    program.bodies = freeBlocks;
    program.contacts.reserve(columns.size());
    for (const ContactColumns<Dim>& column : columns)
    {
        program.contacts.push_back({column.block, column.neighbour, column.onBlock, column.onNeighbour});
    }
    program.friction = friction;
    program.load = loads.dead;
    program.liveLoad = loads.live;
    return program;
}

template<int Rows, int Forces>
LimitAnalysis solveLimitAnalysis(const ConeProgram<Rows, Forces>& program,
                                 const InteriorPointSettings& settings, SymbolicAnalysis* kept)
{
    SymbolicAnalysis own;
    SymbolicAnalysis& symbolic = kept ? *kept : own;
    return completedAnalysis(program, solveInteriorPoint(program, settings, &symbolic), settings, symbolic);
}

template<int Rows, int Forces>
LimitAnalysis completedAnalysis(const ConeProgram<Rows, Forces>& program, const ConeSolution& solution,
                                const InteriorPointSettings& settings, SymbolicAnalysis& kept)
{
    LimitAnalysis result;
    result.variables = Forces * program.points() + 1;
    addWork(result, solution);
    result.contactForce = Eigen::VectorXd::Zero(Forces * program.points());
    result.mechanism = Eigen::VectorXd::Zero(Rows * program.bodies);

    ConeProgram<Rows, Forces> dead = program;
    dead.liveLoad.resize(0);
    const auto unstable = [&](const Eigen::VectorXd& ray)
    {
        result.certificate = certifyInfeasible(dead, ray);
        if (result.certificate.worst() > settings.tolerance)
        {
            return false;
        }
        result.status = CollapseStatus::unstable;
        result.mechanism = normalised(ray);
        return true;
    };

    // A multiplier below zero means that the mechanism, on which the live load does unit work, is set going
    // by the dead load: f'y = -alpha > 0. A ray of the whole program is one of the dead load too.
    const bool answered = solution.status != SolveStatus::notConverged;
    if ((solution.status == SolveStatus::infeasible || (answered && solution.multiplier < 0))
        && unstable(solution.displacement))
    {
        return result;
    }
    if (solution.status != SolveStatus::infeasible)
    {
        // 0 <= alpha does not say that 0 can be carried: the live load may be what holds the structure up.
        // Forces that carry the dead load alone prove it, if the solver has come by some; else they are
        // sought. Where no multiplier was found, that may be why.
        ConeSolution resting;
        resting.contactForce = solution.forceOfLoadAlone;
        resting.displacement = Eigen::VectorXd::Zero(Rows * program.bodies);
        const bool isCarried = solution.forceOfLoadAlone.size() > 0
                               && certifyOptimal(dead, resting).worst() <= settings.tolerance;
        if (!isCarried)
        {
            resting = solveInteriorPoint(dead, settings, &kept);
            addWork(result, resting);
            if ((resting.status == SolveStatus::infeasible && unstable(resting.displacement))
                || (answered && resting.status == SolveStatus::notConverged))
            {
                return result;
            }
        }
    }
    result.certificate = certify(program, solution);
    result.contactForce = solution.contactForce;
    switch (solution.status)
    {
    case SolveStatus::optimal:
        result.status = CollapseStatus::optimal;
        result.alpha = withoutRounding(solution.multiplier, program, settings.tolerance);
        result.mechanism = normalised(solution.displacement);
        break;
    case SolveStatus::unbounded:
        result.status = CollapseStatus::unbounded;
        break;
    case SolveStatus::infeasible:
    case SolveStatus::notConverged:
        result.status = CollapseStatus::notConverged;
        result.mechanism = normalised(solution.displacement);
        break;
    }
    return result;
}

template<int Rows, int Forces>
std::optional<MultiplierRange> multipliersThatHold(const ConeProgram<Rows, Forces>& program,
                                                   const InteriorPointSettings& settings,
                                                   SymbolicAnalysis& kept)
{
    ConeProgram<Rows, Forces> directed = program;
    const auto farthest = [&]() -> std::optional<double>
    {
        const ConeSolution solution = solveInteriorPoint(directed, settings, &kept);
        if (solution.status == SolveStatus::unbounded)
        {
            return std::numeric_limits<double>::infinity();
        }
        return solution.status == SolveStatus::optimal ? std::optional(solution.multiplier) : std::nullopt;
    };
    const std::optional<double> largest = farthest();
    directed.liveLoad *= -1;
    const std::optional<double> least = largest ? farthest() : std::nullopt;
    return least ? std::optional(MultiplierRange{-*least, *largest}) : std::nullopt;
}

template PlaneConeProgram limitAnalysisProgram(int freeBlocks, const std::vector<ContactColumns<2>>& columns,
                                               const std::vector<double>& friction, const LoadVectors& loads);
template SpaceConeProgram limitAnalysisProgram(int freeBlocks, const std::vector<ContactColumns<3>>& columns,
                                               const std::vector<double>& friction, const LoadVectors& loads);
template LimitAnalysis solveLimitAnalysis(const PlaneConeProgram& program,
                                          const InteriorPointSettings& settings, SymbolicAnalysis* kept);
template LimitAnalysis solveLimitAnalysis(const SpaceConeProgram& program,
                                          const InteriorPointSettings& settings, SymbolicAnalysis* kept);
template std::optional<MultiplierRange> multipliersThatHold(const PlaneConeProgram& program,
                                                            const InteriorPointSettings& settings,
                                                            SymbolicAnalysis& kept);
template std::optional<MultiplierRange> multipliersThatHold(const SpaceConeProgram& program,
                                                            const InteriorPointSettings& settings,
                                                            SymbolicAnalysis& kept);
template LimitAnalysis completedAnalysis(const PlaneConeProgram& program, const ConeSolution& solution,
                                         const InteriorPointSettings& settings, SymbolicAnalysis& kept);
template LimitAnalysis completedAnalysis(const SpaceConeProgram& program, const ConeSolution& solution,
                                         const InteriorPointSettings& settings, SymbolicAnalysis& kept);

} // namespace drystone
