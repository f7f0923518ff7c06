// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The third stage of a step: what is not rigid blocks at rest supports and dry joints.
#include "dynamics/MovingGeometry.h"

#include <cmath>

namespace drystone
{
namespace
{

/// Lets the bonds that are whole hold their points where they were joined. One that is left without a point
/// is broken. \return which bond holds each point
std::vector<int> holdBonds(const DynamicCase& scene, const Motion& motion,
                           const std::vector<ContactPoint<2>>& points, std::vector<char>& isBroken,
                           PlaneConeProgram& program)
{
    std::vector<int> bondOfPoint = bondsAt(scene, motion, isBroken, points);
    isBroken.assign(scene.bonds.size(), true);
    for (std::size_t point = 0; point < points.size(); ++point)
    {
        if (bondOfPoint[point] >= 0)
        {
            const auto bond = static_cast<std::size_t>(bondOfPoint[point]);
            isBroken[bond] = false;
            if (motion.contacts)
            {
                const double opening =
                    openingOf(scene.bonds[bond], scene.blocks, motion.state.placements, points[point]);
                program.gap[2 * static_cast<Eigen::Index>(point)] =
                    std::abs(opening) <= scene.roundingGap ? 0 : opening;
            }
        }
    }
    if (isAnyHeld(bondOfPoint))
    {
        program.strength = strengthsOf(scene.bonds, bondOfPoint);
    }
    return bondOfPoint;
}

/// Lets an overlap that is there when a step begins stay for now, all but what the loads would move a block
/// in the step from rest. Closed at once, an overlap d would throw the blocks apart with d/dt, the faster the
/// shorter the step. Overlaps that steps leave are smaller than the tolerance and are closed. \return whether
/// there was any
bool leaveOverlaps(PlaneConeProgram& program, double tolerance, double reach)
{
    bool isAny = false;
    for (int point = 0; point < program.points(); ++point)
    {
        const double left = -program.gap[2 * point] - tolerance - reach;
        if (left > 0)
        {
            program.gap[2 * point] += left;
            isAny = true;
        }
    }
    return isAny;
}

} // namespace

void contribute(Step& step)
{
    const StageTimer timer(step.motion.stageTimes, Stage::contribute);
    const DynamicCase& scene = step.scene;
    PlaneConeProgram& program = step.program;
    const double timeStep = step.scheme.timeStep;
    const EffectContext context{scene.mass, step.guess.contactForce, step.motion.contactForces, timeStep};
    const Eigen::VectorXd gap = program.gap;
    // Points that give way overlap by what their forces press them together.
    const bool isOverlapLeft =
        !scene.contact.elasticity
        && leaveOverlaps(program, step.settings.contactTolerance, step.acceleration * timeStep * timeStep);
    step.isBondBroken = step.motion.isBondBroken;
    if (!scene.effects.empty() || !scene.bonds.empty() || isOverlapLeft)
    {
        for (const auto& effect : scene.effects)
        {
            effect->contribute(context, program);
        }
        if (!scene.bonds.empty())
        {
            step.bondOfPoint = holdBonds(scene, step.motion, step.points, step.isBondBroken, program);
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

} // namespace drystone
