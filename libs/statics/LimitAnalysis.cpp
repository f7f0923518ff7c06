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

/// Takes a mechanism that the dead load sets going. \param dead program of the dead load alone \return
/// whether the ray proves that nothing carries it; else only the certificate is changed
template<int Rows, int Forces>
bool takeFall(LimitAnalysis& result, const ConeProgram<Rows, Forces>& dead, const Eigen::VectorXd& ray,
              double tolerance)
{
    result.certificate = certifyInfeasible(dead, ray);
    if (result.certificate.worst() > tolerance)
    {
        return false;
    }
    result.status = CollapseStatus::unstable;
    result.mechanism = normalised(ray);
    return true;
}

/// Keeps forces that joints have to bear in addition to those of collapse. Where none crush, points show that
/// they do.
template<int Rows, int Forces>
void keepOtherForces(LimitAnalysis& result, const ConeProgram<Rows, Forces>& program,
                     const Eigen::VectorXd& forces)
{
    if (program.hasCrushing())
    {
        result.otherForces.push_back(forces);
    }
}

/// Whether forces, where a solver has come by some, carry the dead load alone. 0 <= alpha does not say so:
/// the live load may be what holds the structure up.
template<int Rows, int Forces>
bool isCarried(const ConeProgram<Rows, Forces>& dead, const Eigen::VectorXd& forces, double tolerance)
{
    if (forces.size() == 0)
    {
        return false;
    }
    ConeSolution resting;
    resting.contactForce = forces;
    resting.displacement = Eigen::VectorXd::Zero(Rows * dead.bodies);
    return certifyOptimal(dead, resting).worst() <= tolerance;
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

namespace
{

/// The analysis becomes that of a solution, whose dead load is carried.
template<int Rows, int Forces>
void takeSolution(LimitAnalysis& result, const ConeProgram<Rows, Forces>& program,
                  const ConeSolution& solution, double tolerance)
{
    result.certificate = certify(program, solution);
    result.contactForce = solution.contactForce;
    switch (solution.status)
    {
    case SolveStatus::optimal:
        result.status = CollapseStatus::optimal;
        result.alpha = withoutRounding(solution.multiplier, program, tolerance);
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
}

} // namespace

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
    // A multiplier below zero means that the mechanism, on which the live load does unit work, is set going
    // by the dead load: f'y = -alpha > 0. A ray of the whole program is one of the dead load too.
    const bool isAnswered = solution.status != SolveStatus::notConverged;
    const bool isInfeasible = solution.status == SolveStatus::infeasible;
    if ((isInfeasible || (isAnswered && solution.multiplier < 0))
        && takeFall(result, dead, solution.displacement, settings.tolerance))
    {
        return result;
    }
    // Else forces for the dead load are sought. Where no multiplier was found, that may be why.
    if (!isInfeasible && isCarried(dead, solution.forceOfLoadAlone, settings.tolerance))
    {
        keepOtherForces(result, dead, solution.forceOfLoadAlone);
    }
    else if (!isInfeasible)
    {
        const ConeSolution resting = solveInteriorPoint(dead, settings, &kept);
        addWork(result, resting);
        const bool falls = resting.status == SolveStatus::infeasible
                           && takeFall(result, dead, resting.displacement, settings.tolerance);
        if (falls || (isAnswered && resting.status == SolveStatus::notConverged))
        {
            return result;
        }
        if (resting.status == SolveStatus::optimal)
        {
            keepOtherForces(result, dead, resting.contactForce);
        }
    }
    takeSolution(result, program, solution, settings.tolerance);
    return result;
}

template<int Rows, int Forces>
std::optional<MultiplierRange>
multipliersThatHold(const ConeProgram<Rows, Forces>& program, const InteriorPointSettings& settings,
                    SymbolicAnalysis& kept, std::vector<Eigen::VectorXd>* forces)
{
    ConeProgram<Rows, Forces> directed = program;
    const auto farthest = [&]() -> std::optional<double>
    {
        const ConeSolution solution = solveInteriorPoint(directed, settings, &kept);
        if (solution.status == SolveStatus::unbounded)
        {
            return std::numeric_limits<double>::infinity();
        }
        if (solution.status != SolveStatus::optimal)
        {
            return std::nullopt;
        }
        if (forces)
        {
            forces->push_back(solution.contactForce);
        }
        return solution.multiplier;
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
                                                            SymbolicAnalysis& kept,
                                                            std::vector<Eigen::VectorXd>* forces);
template std::optional<MultiplierRange> multipliersThatHold(const SpaceConeProgram& program,
                                                            const InteriorPointSettings& settings,
                                                            SymbolicAnalysis& kept,
                                                            std::vector<Eigen::VectorXd>* forces);
template LimitAnalysis completedAnalysis(const PlaneConeProgram& program, const ConeSolution& solution,
                                         const InteriorPointSettings& settings, SymbolicAnalysis& kept);
template LimitAnalysis completedAnalysis(const SpaceConeProgram& program, const ConeSolution& solution,
                                         const InteriorPointSettings& settings, SymbolicAnalysis& kept);

} // namespace drystone
