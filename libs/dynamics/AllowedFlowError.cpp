// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The error that Coulomb's law may have in a step grows with the programs that its search has taken.
#include "dynamics/AllowedFlowError.h"

#include "dynamics/FollowedFlow.h"
#include "effects/Structure.h"

#include <algorithm>

namespace drystone
{
namespace
{

/// From this program on the law may have an error that is a share of the motion: one point of hundreds that
/// would neither slide nor stick makes steps without an end.
constexpr int programsToExactFlow = 4;

/// The error of mu |u_t| may be this share of what the step changes the motion by, and after so many
/// programs, or where they stall, the larger one: just above a threshold the fixed point is not reached
/// closer.
constexpr double shareOfStep = 1e-2;
constexpr double largerShareOfStep = 0.15;
constexpr int programsToLargerShare = 15;

/// Where alternating directions have come near the least forces so much will do from the first program on:
/// half of it takes twice the programs, and changes the motion of houses by 1%.
constexpr double shareOfPredicted = 0.1;

/// Programs that have stalled: so many that the error of none is below this share of the least before, in
/// which what the step changes stays within this part of itself.
constexpr std::size_t stalledPrograms = 3;
constexpr double shareOfError = 0.5;
constexpr double partOfMoved = 0.1;

/// Nor does an error matter that is this part of how far the loads would take the blocks without contacts: as
/// much of g. Where little moves at first (some 1e-6 of it), a hundredth of that is less than a program
/// tells.
constexpr double negligibleShare = 1e-5;

/// Of an impact it is so much of the velocities that blocks have, but no more than this part of their change.
constexpr double shareOfChange = 0.3;

/// An impact that changes velocities by little more than this part of the largest is not made of programs
/// without end.
constexpr double negligibleVelocity = 1e-5;

} // namespace

bool hasStalled(const std::vector<MissedFlow>& programs)
{
    if (programs.size() < programsToExactFlow - 1 + stalledPrograms)
    {
        return false;
    }
    const auto lately = programs.end() - stalledPrograms;
    const auto byError = [](const MissedFlow& one, const MissedFlow& other)
    { return one.error < other.error; };
    const auto [least, most] = std::minmax_element(lately, programs.end(),
                                                   [](const MissedFlow& one, const MissedFlow& other)
                                                   { return one.moved < other.moved; });
    return std::min_element(lately, programs.end(), byError)->error
               > shareOfError * std::min_element(programs.begin(), lately, byError)->error
           && most->moved - least->moved <= partOfMoved * most->moved;
}

template<int Dim>
double allowedFlowError(const FlowSolution& solution, const StepSettings& settings)
{
    const ThetaStep& step = solution.step;
    const double tolerance = settings.solver.tolerance;
    const bool isImpact = settings.kind == StepKind::impact;
    const double exact = std::max(1e-12 * settings.blockSize,
                                  10 * tolerance * solution.opening.template lpNorm<Eigen::Infinity>());
    if (!isImpact && !solution.isPredicted
        && (step.programs < programsToExactFlow
            || (!solution.isBalanced && step.programs < programsToLargerShare)))
    {
        return exact;
    }
    // Otherwise a small part of what the step itself does: with steps so short that gravity moves a
    // block by less than some length, any force at all would do. Nor less than what a program
    // certified to its tolerance determines.
    const double farthest = farthestMotion<Dim>(step.displacement, settings.blockSize);
    const double moved = solution.missed.back().moved;
    const bool mayMissMore =
        step.programs >= programsToLargerShare || (!isImpact && hasStalled(solution.missed));
    const double share = mayMissMore            ? largerShareOfStep
                         : solution.isPredicted ? shareOfPredicted
                                                : shareOfStep;
    const double small = isImpact ? std::min(shareOfChange * moved, share * farthest) : share * moved;
    const double certified = tolerance * std::max(farthest, solution.gap.template lpNorm<Eigen::Infinity>());
    const double negligible = !isImpact
                                  ? std::min(yieldingOf(settings), negligibleShare * solution.wayOfLoads)
                              : step.programs > programsToLargerShare ? negligibleVelocity * farthest
                                                                      : 0;
    return std::max({exact, certified, small, negligible});
}

template double allowedFlowError<2>(const FlowSolution& solution, const StepSettings& settings);
template double allowedFlowError<3>(const FlowSolution& solution, const StepSettings& settings);

} // namespace drystone
