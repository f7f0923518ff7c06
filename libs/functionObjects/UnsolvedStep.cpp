// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Words why a step has no solution, even in parts.
#include "functionObjects/UnsolvedStep.h"

#include "dynamics/StartCheck.h"
#include "dynamics/Step.h"

#include <fmt/format.h>

#include <algorithm>

namespace drystone
{
namespace
{

/// Of the step that was abandoned [s].
double abandonedStep(const Time& time)
{
    return time.state().deltaT;
}

/// What to make smaller for shorter steps.
std::string shorterSteps(const Time& time)
{
    return time.controls().adjustTimeStep ? "a smaller maxDeltaT or maxDisplacement in system/schemes"
                                          : "a smaller deltaT";
}

/// By how far the velocities now and the loads would take the block that is fastest in one step [m].
template<int Dim>
double farthestInOneStep(const DynamicCase<Dim>& scene, const Motion<Dim>& motion, const Time& time)
{
    const double timeStep = abandonedStep(time);
    Motion<Dim> copy = motion;
    const Eigen::VectorXd load = Step<Dim>(scene, copy, timeStep, {}).load;
    double farthest = 0;
    for (Eigen::Index row = 0; row < load.size(); row += freedomCount<Dim>)
    {
        const Vector<Dim> displacement = timeStep
                                         * (motion.state.velocity.template segment<Dim>(row)
                                            + timeStep / scene.mass[row] * load.template segment<Dim>(row));
        farthest = std::max(farthest, displacement.norm());
    }
    return farthest;
}

template<int Dim>
std::string stepWithoutEnd(const DynamicCase<Dim>& scene, const Motion<Dim>& motion, const Time& time)
{
    constexpr double strict =
        1e-10; // below, last digits of forces that are not unique take many factorisations
    const double farthest = farthestInOneStep(scene, motion, time);
    return fmt::format(
        "The step after time {} takes more than the maximumFactorisations of {} that a step may have ({} "
        "shorter attempts, up to {} contact points of {} blocks).\n\nIn a step of {:g} s the fastest block "
        "moves by {:.3g} m, {:.3g} times the mean block size. The state at its start has been written: begin "
        "from there with {}, so that blocks move by a small part of their size in a step, or raise {} in "
        "system/solution/contactDynamics.",
        time.name(), scene.solution.maximumFactorisations, motion.work.attempts - 1, motion.work.mostPoints,
        scene.mass.size() / freedomCount<Dim>, abandonedStep(time), farthest, farthest / scene.blockSize,
        shorterSteps(time),
        scene.solution.tolerance < strict ? fmt::format("tolerance, which is {:g},", scene.solution.tolerance)
                                          : "maximumFactorisations");
}

std::string textOf(StepFault fault)
{
    switch (fault)
    {
    case StepFault::turnsTooFar:
        return "contact turned a block by more than a radian";
    case StepFault::entersTooDeep:
        return "blocks ended in each other";
    case StepFault::createsEnergy:
        return "contact did work on the blocks";
    case StepFault::movesTooFar:
    case StepFault::none:
        break;
    }
    return "";
}

} // namespace

template<int Dim>
std::string unsolvedStep(const DynamicCase<Dim>& scene, const Motion<Dim>& motion, const Time& time)
{
    if (motion.work.isUsedUp())
    {
        return stepWithoutEnd(scene, motion, time);
    }
    if (motion.attempt.fault == StepFault::movesTooFar)
    {
        return fmt::format(
            "In the step at time {} velocities, loads or the motions of ground and supports move a block by "
            "more than {:g} block sizes or radians, also when it is made shorter {} times: nothing of that "
            "could be computed. The state at its start has been written. Correct the sizes of gravity, "
            "density, loads and the motions of ground and supports.",
            time.name(), mostInAStep, motion.attempt.retries);
    }
    if (motion.attempt.fault != StepFault::none)
    {
        return fmt::format(
            "The step at time {} was solved, but {}, also when it was made shorter {} times: as "
            "steps do that are too long for a motion so fast, or from a state that cannot be "
            "right. The state at its start has been written. Restart from an earlier one with {}.",
            time.name(), textOf(motion.attempt.fault), motion.attempt.retries, shorterSteps(time));
    }
    const double residual = motion.attempt.worst();
    return fmt::format("The step at time {} was not solved to tolerance {:g}, nor when it was made shorter "
                       "{} times ({}). The state at its start has been written. Raise tolerance or {} in "
                       "system/solution/contactDynamics, or restart from it with {}.{}",
                       time.name(), scene.solution.tolerance, motion.attempt.retries,
                       residual > scene.solution.tolerance
                           ? fmt::format("residual {:.3g}", residual)
                           : "its last program was, but not an impact in it, or the turns of its blocks",
                       scene.solution.solver == SolverType::gaussSeidel
                           ? "maximumSweeps, or choose another solver,"
                           : "maximumIterations",
                       shorterSteps(time),
                       traitsOf(scene.effects).movesSupports
                           ? " Where supports that move press blocks together between them, rigid blocks "
                             "have no motion at all."
                           : "");
}

template std::string unsolvedStep(const DynamicCase<2>& scene, const Motion<2>& motion, const Time& time);
template std::string unsolvedStep(const DynamicCase<3>& scene, const Motion<3>& motion, const Time& time);

} // namespace drystone
