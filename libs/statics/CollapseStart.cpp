// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Programs of the associative law, with random weights or the rates of a mechanism for gaps.
#include "statics/CollapseStart.h"

#include <algorithm>
#include <cmath>

namespace drystone
{
namespace
{

using Eigen::VectorXd;

/// Forces at the start of a path are moved inwards by this share of those for the dead load.
constexpr double inwards = 0.01;

} // namespace

double uniform(std::mt19937& generator)
{
    return static_cast<double>(generator()) / 4294967296.0;
}

CollapseStart movedInwards(double alpha, const VectorXd& contactForce, const VectorXd& resting)
{
    return {(1 - inwards) * alpha, (1 - inwards) * contactForce + inwards * resting};
}

template<int Rows, int Forces>
std::optional<VectorXd> restingForces(const ConeProgram<Rows, Forces>& given,
                                      const ProgramSolver<Rows, Forces>& solve)
{
    ConeProgram<Rows, Forces> dead = given;
    dead.liveLoad.resize(0);
    ConeSolution resting = solve(dead);
    return resting.status == SolveStatus::optimal ? std::optional(std::move(resting.contactForce))
                                                  : std::nullopt;
}

template<int Rows, int Forces>
std::optional<VectorXd> randomRestingForces(const ConeProgram<Rows, Forces>& given, std::mt19937& generator,
                                            const ProgramSolver<Rows, Forces>& solve)
{
    ConeProgram<Rows, Forces> weighted = given;
    weighted.gap = VectorXd::Zero(Forces * given.points());
    for (int point = 0; point < given.points(); ++point)
    {
        const double weight = std::pow(10, -2 * uniform(generator));
        weighted.gap[Forces * point] = weight;
        for (int shear = 1; shear < Forces; ++shear)
        {
            weighted.gap[Forces * point + shear] = 0.3 * weight * (2 * uniform(generator) - 1);
        }
    }
    return restingForces(weighted, solve);
}

template<int Rows, int Forces>
std::optional<CollapseStart> lowForces(const ConeProgram<Rows, Forces>& given, const CoulombPair& pair,
                                       double gamma, const ProgramSolver<Rows, Forces>& solve)
{
    ConeProgram<Rows, Forces> reversed = given;
    reversed.liveLoad = -given.liveLoad;
    reversed.gap = VectorXd::Zero(Forces * given.points());
    const VectorXd closing = applyTransposed(given, pair.mechanism);
    for (int point = 0; point < given.points(); ++point)
    {
        const double slip = closing.template segment<Forces - 1>(Forces * point + 1).norm();
        reversed.gap[Forces * point] = gamma
                                       * (given.friction[static_cast<std::size_t>(point)] * slip
                                          + std::max(0.0, -closing[Forces * point]));
    }
    ConeSolution low = solve(reversed);
    return low.status == SolveStatus::optimal
               ? std::optional(CollapseStart{-low.multiplier, std::move(low.contactForce)})
               : std::nullopt;
}

template std::optional<VectorXd> restingForces(const PlaneConeProgram& given,
                                               const ProgramSolver<3, 2>& solve);
template std::optional<VectorXd> restingForces(const SpaceConeProgram& given,
                                               const ProgramSolver<6, 3>& solve);
template std::optional<VectorXd> randomRestingForces(const PlaneConeProgram& given, std::mt19937& generator,
                                                     const ProgramSolver<3, 2>& solve);
template std::optional<VectorXd> randomRestingForces(const SpaceConeProgram& given, std::mt19937& generator,
                                                     const ProgramSolver<6, 3>& solve);
template std::optional<CollapseStart> lowForces(const PlaneConeProgram& given, const CoulombPair& pair,
                                                double gamma, const ProgramSolver<3, 2>& solve);
template std::optional<CollapseStart> lowForces(const SpaceConeProgram& given, const CoulombPair& pair,
                                                double gamma, const ProgramSolver<6, 3>& solve);

} // namespace drystone
