// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The third stage of a step: what is not rigid blocks at rest supports and dry joints.
#include "dynamics/MovingGeometry.h"

namespace drystone
{
namespace
{

/// Lets an overlap that is there when a step begins stay for now, all but what the loads would move a block
/// in the step from rest. Closed at once, an overlap d would throw the blocks apart with d/dt, the faster the
/// shorter the step. Overlaps that steps leave are smaller than the tolerance and are closed. \return whether
/// there was any
template<int Dim>
bool leaveOverlaps(StepProgram<Dim>& program, double tolerance, double reach)
{
    bool isAny = false;
    for (int point = 0; point < program.points(); ++point)
    {
        const double left = -program.gap[Dim * point] - tolerance - reach;
        if (left > 0)
        {
            program.gap[Dim * point] += left;
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
    // Points that give way overlap by what their forces press them together.
    const bool isOverlapLeft =
        !traitsOf(scene.effects).isCompliant
        && leaveOverlaps(program, step.settings.contactTolerance, step.acceleration * timeStep * timeStep);
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
    StepProgram<Dim>& program = step.program;
    if (program.hasCompliance())
    {
        return false;
    }
    bool isAny = false;
    for (std::size_t point = 0; point < step.points.size(); ++point)
    {
        const Eigen::Index row = Dim * static_cast<Eigen::Index>(point);
        const double overlap =
            -step.points[point].gap - (step.gapsOfEffects.size() > 0 ? step.gapsOfEffects[row] : 0);
        if (overlap > 0)
        {
            if (step.gapsOfEffects.size() == 0)
            {
                step.gapsOfEffects = Eigen::VectorXd::Zero(program.gap.size());
            }
            step.gapsOfEffects[row] += overlap;
            program.gap[row] += overlap;
            isAny = true;
        }
    }
    return isAny;
}

template void contribute(Step<2>& step);
template bool leaveAllOverlaps(Step<2>& step);
template void contribute(Step<3>& step);
template bool leaveAllOverlaps(Step<3>& step);

} // namespace drystone
