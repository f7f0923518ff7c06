// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The third stage of a step: what comes to rigid blocks, supports at rest and dry joints.
#include "dynamics/MovingGeometry.h"

namespace drystone
{
namespace
{

/// Lets an overlap that is there when a step begins stay for now, all but so much of it: in `gapsOfEffects`,
/// in addition to what is there. \param tolerance, reach what of it is closed \return whether there was any
template<int Dim>
bool leaveOverlaps(Step<Dim>& step, double tolerance, double reach)
{
    StepProgram<Dim>& program = step.program;
    bool isAny = false;
    for (std::size_t point = 0; point < step.points.size(); ++point)
    {
        const Eigen::Index row = Dim * static_cast<Eigen::Index>(point);
        const double own = step.gapsOfEffects.size() > 0 ? step.gapsOfEffects[row] : 0;
        const double left = -step.points[point].gap - own - tolerance - reach;
        if (left > 0)
        {
            if (step.gapsOfEffects.size() == 0)
            {
                step.gapsOfEffects = Eigen::VectorXd::Zero(program.gap.size());
            }
            step.gapsOfEffects[row] += left;
            program.gap[row] += left;
            isAny = true;
        }
    }
    return isAny;
}

} // namespace

template<int Dim>
void contribute(Step<Dim>& step)
{
    const StageTimer timer(step.motion.stageTimes, Stage::contribute);
    const DynamicCase<Dim>& scene = step.scene;
    StepProgram<Dim>& program = step.program;
    const double timeStep = step.scheme.timeStep;
    const Eigen::VectorXd gap = program.gap;
    // Closed at once, an overlap d would throw the blocks apart with d/dt, the faster the shorter the step:
    // all stays but what the loads would move a block in the step from rest. Overlaps that steps leave are
    // smaller than the tolerance and are closed. Points that give way overlap by what their forces press them
    // together.
    const bool isOverlapLeft =
        !traitsOf(scene.effects).isCompliant
        && leaveOverlaps(step, step.settings.contactTolerance, step.acceleration * timeStep * timeStep);
    step.effectStates = step.motion.effectStates;
    if (!scene.effects.empty() || isOverlapLeft)
    {
        const EffectContext<Dim> context = contextOf(step);
        for (std::size_t i = 0; i < scene.effects.size(); ++i)
        {
            scene.effects[i]->contribute(context, step.effectStates[i], program);
        }
        step.gapsOfEffects = program.gap - gap;
    }
    step.bySupports = closingBySupports(step.points, step.columns, step.supports);
    if (step.bySupports.size() > 0)
    {
        program.gap -= step.bySupports;
    }
    if (step.motion.contacts)
    {
        step.relinearise = movingContactGeometry(step);
    }
}

template<int Dim>
bool leaveAllOverlaps(Step<Dim>& step)
{
    return !step.program.hasCompliance() && leaveOverlaps(step, 0, 0);
}

template void contribute(Step<2>& step);
template bool leaveAllOverlaps(Step<2>& step);
template void contribute(Step<3>& step);
template bool leaveAllOverlaps(Step<3>& step);

} // namespace drystone
