// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The stage of a step in which effects examine its solution.
#include "dynamics/Step.h"

#include <algorithm>
#include <cmath>

namespace drystone
{
namespace
{

/// A bond gives way when its point moves by more than this part of what the step moves the blocks by, or by
/// more than the error allowed in gaps.
constexpr double yieldsBy = 1e-2;

/// Takes the bonds that a solved step would open or shear out of its program. \return how many
int breakBonds(Step& step)
{
    PlaneConeProgram& program = step.program;
    const ThetaStep& result = step.solved.result;
    const StepSettings& settings = step.settings;
    const Eigen::VectorXd opening = openingAtEnd(step, result.displacement, result.contactForce);
    const double farthest = farthestMotion(result.displacement, step.scene.blockSize);
    // What a solver leaves of forces out of balance moves the blocks as well: the gap of its certificate is
    // of second order in them.
    const double timeStep = step.scheme.timeStep;
    const double leftover = std::sqrt(settings.solver.tolerance) * step.acceleration * timeStep * timeStep;
    const YieldTolerance tolerance{
        std::max(leftover, std::min(settings.contactTolerance, yieldsBy * farthest))
            + 2 * step.scene.roundingGap,
        10 * settings.solver.tolerance * result.contactForce.lpNorm<Eigen::Infinity>()};
    std::vector<int>& bondOfPoint = step.bondOfPoint;
    const std::vector<int> givingWay =
        bondsGivingWay(program, bondOfPoint, opening, result.contactForce, tolerance);
    for (const int bond : givingWay)
    {
        step.isBondBroken[static_cast<std::size_t>(bond)] = true;
        const auto point = static_cast<std::size_t>(std::find(bondOfPoint.begin(), bondOfPoint.end(), bond)
                                                    - bondOfPoint.begin());
        bondOfPoint[point] = -1;
        program.strength[point] = {};
    }
    if (!isAnyHeld(bondOfPoint))
    {
        program.strength.clear();
    }
    return static_cast<int>(givingWay.size());
}

} // namespace

bool review(Step& step)
{
    const StageTimer timer(step.motion.stageTimes, Stage::review);
    if (step.solved.isSolved && step.program.hasStrength() && breakBonds(step) > 0)
    {
        return true;
    }
    const ThetaStep& result = step.solved.result;
    StepResiduals& residuals = step.motion.attempt;
    residuals.initialResidual = result.initialResidual;
    residuals.primalResidual = result.certificate.primalResidual;
    residuals.dualResidual = result.certificate.dualResidual;
    residuals.gap = result.certificate.gap;
    residuals.flowError = result.flowError;
    return false;
}

} // namespace drystone
