// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The first stage of a step: contact points and their lever arms.
#include "dynamics/MovingGeometry.h"

namespace drystone
{

template<int Dim>
void findContacts(Step<Dim>& step)
{
    const StageTimer timer(step.motion.stageTimes, Stage::findContacts);
    const DynamicCase<Dim>& scene = step.scene;
    Motion<Dim>& motion = step.motion;
    if (!motion.contacts)
    {
        step.points = motion.points; // they stay as built
        step.columns = equilibriumColumns(scene.assembly, scene.blocks, step.points);
        return;
    }
    const std::vector<Placement<Dim>>& placements = motion.state.placements;
    const Eigen::VectorXd expected = step.scheme.timeStep * motion.state.velocity;
    const double start = motion.state.time;
    const auto velocities = velocitiesOfAllBlocks(scene, motion.state, start, start + step.scheme.timeStep);
    const double margin = motion.contacts->marginFor(velocities, step.scheme.timeStep, step.acceleration);
    std::vector<std::vector<Placement<Dim>>> headings;
    headings.push_back(placementsAfter(step, expected));
    for (const Eigen::VectorXd& displacement : step.overlooking)
    {
        headings.push_back(placementsAfter(step, displacement));
    }
    step.points = motion.contacts->update(placements, headings, margin);
    forgetRounding(scene, step.points);
    if (step.scheme.theta == 1)
    {
        step.columns = columnsAt(scene, placements, step.points);
        return;
    }
    const auto between = placementsAfter(step, expected, 1 - step.scheme.theta);
    std::vector<ContactPoint<Dim>> pointsBetween;
    motion.contacts->measure(between, pointsBetween);
    step.columns = columnsAt(scene, between, pointsBetween);
    if (hasImpacts(scene))
    {
        step.arrivals = columnsAt(scene, placements, step.points);
    }
}

template<int Dim>
Eigen::VectorXd displacementAtEnd(const Step<Dim>& step)
{
    const StepSolution& solved = step.solved;
    return solved.flight.size() > 0 ? Eigen::VectorXd(solved.result.displacement + solved.flight)
                                    : solved.result.displacement;
}

template<int Dim>
double overlookedDepth(const Step<Dim>& step)
{
    return step.motion.contacts && step.solved.isSolved && step.motion.contacts->mayOverlook()
               ? step.motion.contacts->overlookedDepth(placementsAfter(step, displacementAtEnd(step)))
               : 0;
}

template Eigen::VectorXd displacementAtEnd(const Step<2>& step);
template Eigen::VectorXd displacementAtEnd(const Step<3>& step);
template double overlookedDepth(const Step<2>& step);
template double overlookedDepth(const Step<3>& step);
template void findContacts(Step<2>& step);
template void findContacts(Step<3>& step);

} // namespace drystone
