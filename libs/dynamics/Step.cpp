// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// What acts on the blocks in a step.
#include "dynamics/Step.h"

#include "assembly/TurnedLoad.h"

#include <algorithm>
#include <cmath>

namespace drystone
{
namespace
{

/// Largest acceleration that the loads alone give a block [m/s2].
template<int Dim>
double largestAcceleration(const DynamicCase<Dim>& scene, const Eigen::VectorXd& load)
{
    double largest = 0;
    for (Eigen::Index row = 0; row < load.size(); row += freedomCount<Dim>)
    {
        largest = std::max(largest, load.segment<Dim>(row).norm() / scene.mass[row]);
    }
    return largest;
}

/// The dead load with the blocks where their velocities take them in half the step: to second order its mean.
template<int Dim>
Eigen::VectorXd meanDeadLoad(const DynamicCase<Dim>& scene, const DynamicState<Dim>& state, double length)
{
    const Load& load = scene.deadLoad;
    return load.firstMoments.size() == 0
               ? load.rows
               : turnedLoad<Dim>(load, scene.free,
                                 moved(state.placements, scene.free, state.velocity, 0.5 * length));
}

/// See StepSettings. Of large structures of space that Newton's method has not solved in the last step it
/// hardly ever solves the next: none of 60 steps of a house with 1,548 points, at 140 factorisations each; of
/// small ones six in ten. What is left of a step by the fixed point (`flowError`) is kept with the state, so
/// that a run that is continued goes on as it would have. \param length of the step [s]
template<int Dim>
bool isFixedPointOnly(const Motion<Dim>& motion, double length)
{
    constexpr long stepsToNextTry = 32;
    return Dim == 3 && motion.points.size() >= pointsOfLarge && motion.residuals.flowError > 0
           && std::lround(motion.state.time / length) % stepsToNextTry != 0;
}

} // namespace

template<int Dim>
Step<Dim>::Step(const DynamicCase<Dim>& dynamicCase, Motion<Dim>& current, double length,
                const ImpactChoice& choice, AttemptForces<Dim>* ofAttempts)
    : scene(dynamicCase),
      motion(current),
      impacts(choice),
      attemptForces(ofAttempts),
      scheme{scene.schemes.timeIntegration.theta, length},
      mass(massAt(scene, motion.state.placements))
{
    isOfAllBlocks = choice.isOfAllBlocks;
    settings.flowRule = scene.flowRule();
    settings.overlaps = scheme.theta < 1 ? Overlaps::closed : Overlaps::damped;
    settings.blockSize = scene.blockSize;
    settings.partOfStep = choice.wholeStep > 0 ? length / choice.wholeStep : 1;
    // With theta below 1 none is left of overlaps, and it is all one by how much points give way until then.
    settings.contactOverlap = scheme.theta < 1 ? Schemes().contactOverlap : scene.schemes.contactOverlap;
    settings.contactTolerance = scene.schemes.contactTolerance * scene.blockSize;
    settings.solver = scene.solution;
    settings.isFixedPointOnly = isFixedPointOnly(motion, length);
    settings.work = &motion.work;
    motion.attempt = {};

    const double start = motion.state.time;
    deadLoad = meanDeadLoad(scene, motion.state, length);
    load = deadLoad;
    const EffectContext<Dim> context = contextOf(*this);
    for (std::size_t i = 0; i < scene.effects.size(); ++i)
    {
        scene.effects[i]->addLoad(context, motion.effectStates[i], load);
    }
    acceleration = largestAcceleration(scene, load);
    supports = supportSteps(scene.effects, scene, motion.state.placements, start, start + length);
}

template<int Dim>
EffectContext<Dim> contextOf(const Step<Dim>& step)
{
    return {.structure = step.scene,
            .placements = step.motion.state.placements,
            .points = step.points,
            .forcesBefore = step.guess.contactForce,
            .allForcesBefore = step.motion.contactForces,
            .mass = step.mass,
            .displacements = step.scene.displacements(),
            .theta = step.scheme.theta,
            .start = step.motion.state.time,
            .timeStep = step.scheme.timeStep,
            .acceleration = step.acceleration,
            .contactTolerance = step.settings.contactTolerance,
            .tolerance = step.settings.solver.tolerance};
}

template struct Step<2>;
template EffectContext<2> contextOf(const Step<2>& step);
template struct Step<3>;
template EffectContext<3> contextOf(const Step<3>& step);

} // namespace drystone
