// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The stage of a step in which effects examine its solution.
#include "dynamics/Step.h"

namespace drystone
{
namespace
{

/// Whether an effect has changed the program because of its solution.
template<int Dim>
bool isChangedByEffects(Step<Dim>& step)
{
    const ThetaStep& result = step.solved.result;
    const std::function<Eigen::VectorXd()> opening = [&step, &result]
    { return openingAtEnd(step, result.displacement, result.contactForce); };
    const EffectContext<Dim> context = contextOf(step);
    const EffectSolution solution{result.displacement, result.contactForce, opening};
    bool isChanged = false;
    for (std::size_t i = 0; i < step.scene.effects.size(); ++i)
    {
        const Review verdict =
            step.scene.effects[i]->review(context, solution, step.effectStates[i], step.program);
        isChanged = isChanged || verdict == Review::solveAgain;
    }
    return isChanged;
}

} // namespace

template<int Dim>
bool review(Step<Dim>& step)
{
    const StageTimer timer(step.motion.stageTimes, Stage::review);
    if (step.solved.isSolved && isChangedByEffects(step))
    {
        return true;
    }
    const ThetaStep& result = step.solved.result;
    StepResiduals& residuals = step.motion.attempt;
    residuals.initialResidual = result.initialResidual;
    residuals.primalResidual = result.certificate.primalResidual;
    residuals.dualResidual = result.certificate.dualResidual;
    residuals.dualityGap = result.certificate.dualityGap;
    residuals.flowError = result.flowError;
    return false;
}

template bool review(Step<2>& step);
template bool review(Step<3>& step);

} // namespace drystone
