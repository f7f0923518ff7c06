// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The time step as a page of verbs, and what makes it one that is not taken.
#include "dynamics/UnpartedStep.h"

#include "dynamics/CarriedMotion.h"
#include "dynamics/HeldBlocks.h"
#include "dynamics/MovingGeometry.h"
#include "dynamics/ProvedRest.h"
#include "dynamics/StartCheck.h"

#include <algorithm>
#include <cmath>

namespace drystone
{
namespace
{

/// Steps after one that was solved only as its overlaps stayed, in which they stay too: what such steps take
/// without success is some hundred factorisations.
constexpr int stepsWithOverlaps = 20;

/// That contact gives a block within a step, beyond what it was turning by [rad].
constexpr double farthestTurn = 1;

/// Whether contact turns a block farther from where it was moving to than its place can be followed from
/// tangents of its turn: what was found so may have gained several times its energy.
template<int Dim>
bool turnsTooFar(const Step<Dim>& step)
{
    const Eigen::VectorXd& displacement = step.solved.result.displacement;
    const Eigen::VectorXd& velocity = step.motion.state.velocity;
    const bool isFollowed = step.motion.contacts.has_value();
    for (Eigen::Index row = Dim; isFollowed && row < displacement.size(); row += freedomCount<Dim>)
    {
        const auto turn = [row](const Eigen::VectorXd& of)
        { return of.template segment<rotationCount<Dim>>(row); };
        if ((turn(displacement) - step.scheme.timeStep * turn(velocity)).norm() > farthestTurn)
        {
            return true;
        }
    }
    return false;
}

/// Whether a displacement is one that can be computed with, which a number that is none is not.
template<int Dim>
bool isWithinReach(const DynamicCase<Dim>& scene, const BlockVector<Dim>& displacement)
{
    return displacement.template head<Dim>().norm() < mostInAStep * scene.blockSize
           && displacement.template tail<rotationCount<Dim>>().norm() < mostInAStep;
}

/// Whether velocities, loads or supports move a block farther in the step than can be computed with: contact
/// points would be looked for where there is nothing.
template<int Dim>
bool movesTooFar(const Step<Dim>& step)
{
    const DynamicCase<Dim>& scene = step.scene;
    const double timeStep = step.scheme.timeStep;
    bool isNear =
        step.load.allFinite() && step.acceleration * timeStep * timeStep < mostInAStep * scene.blockSize;
    const Eigen::VectorXd& velocity = step.motion.state.velocity;
    for (Eigen::Index row = 0; row < velocity.size(); row += freedomCount<Dim>)
    {
        isNear =
            isNear && isWithinReach<Dim>(scene, timeStep * velocity.template segment<freedomCount<Dim>>(row));
    }
    for (const SupportStep<Dim>& support : step.supports)
    {
        isNear = isNear && isWithinReach<Dim>(scene, displacementAfter(support));
    }
    return !isNear;
}

/// Whether contacts that a step has overlooked are looked for again where it has led.
template<int Dim>
bool mayLookAgain(const Step<Dim>& step)
{
    constexpr std::size_t mostLooks = 8;
    constexpr double mostWork = 0.3; // of what the step may take
    const StepWork& work = step.motion.work;
    return step.overlooking.size() < mostLooks && work.done <= mostWork * work.most
           && step.motion.contacts->findsMoreTowards(placementsAfter(step, displacementAtEnd(step)));
}

/// Expects the blocks to move with the supports. Walls of a support that turns come nearer to each other by
/// chords of their ways, and linearised about another motion what stands flush between them is too wide.
/// \return whether that is another motion than was expected
template<int Dim>
bool expectCarried(Step<Dim>& step)
{
    const Eigen::VectorXd carried = carriedDisplacement(step);
    const bool isOther = carried.size() > 0 && carried != step.guess.displacement;
    step.guess.displacement = isOther ? carried : step.guess.displacement;
    return isOther;
}

/// Solves the program, which may have no solution as it stands: then about another motion, and then with the
/// overlaps that there are.
template<int Dim>
void solveOrHelp(Step<Dim>& step)
{
    solve(step);
    if (!step.solved.isSolved && expectCarried(step))
    {
        solve(step);
    }
    if (!step.solved.isSolved && leaveAllOverlaps(step))
    {
        solve(step);
        step.overlapsLeft = stepsWithOverlaps;
    }
}

/// Finds and solves the program of the step: again after impacts, and where effects request it.
template<int Dim>
void findMotion(Step<Dim>& step)
{
    findContacts(step);
    assemble(step);
    contribute(step);
    if (step.motion.overlapsLeft > 0)
    {
        leaveAllOverlaps(step);
        step.overlapsLeft = step.motion.overlapsLeft - 1;
    }
    do
    {
        beginAgain(step);
        do
        {
            solveOrHelp(step);
        } while (collide(step));
    } while (review(step));
}

/// Moves the blocks, unless what that leads to is at fault: then they are where they were.
template<int Dim>
StepFault moveUnlessAtFault(Step<Dim>& step)
{
    Motion<Dim>& motion = step.motion;
    const DynamicState<Dim> start = motion.state;
    move(step);
    measureEnergy(step);
    const StepFault fault = createsEnergy(step) ? StepFault::createsEnergy
                            : motion.contacts && motion.contacts->isAnyTooDeep(step.pointsAtEnd)
                                ? StepFault::entersTooDeep
                                : StepFault::none;
    if (fault != StepFault::none)
    {
        motion.state = start;
    }
    return fault;
}

/// \param attemptForces see Step \param overlooking likewise: tries of this step before
template<int Dim>
double takeStep(const DynamicCase<Dim>& scene, Motion<Dim>& motion, double timeStep,
                const ImpactChoice& impacts, AttemptForces<Dim>* attemptForces,
                std::vector<Eigen::VectorXd> overlooking)
{
    motion.stageTimes.end.reset(); // what was done between the steps is of no stage
    Step<Dim> step(scene, motion, timeStep, impacts, attemptForces);
    step.overlooking = std::move(overlooking);
    if (movesTooFar(step))
    {
        motion.attempt.fault = StepFault::movesTooFar;
        return 0;
    }
    if (staysAtRest(step))
    {
        return 1;
    }
    findMotion(step);
    if (!step.solved.isSolved)
    {
        return step.solved.length < 1 ? step.solved.length : 0;
    }
    StepFault fault = turnsTooFar(step) ? StepFault::turnsTooFar : StepFault::none;
    if (const double depth = fault == StepFault::none ? overlookedDepth(step) : 0; depth > 0)
    {
        if (mayLookAgain(step))
        {
            step.overlooking.push_back(displacementAtEnd(step));
            return takeStep(scene, motion, timeStep, impacts, attemptForces, std::move(step.overlooking));
        }
        fault = motion.contacts->isTooDeep(depth) ? StepFault::entersTooDeep : StepFault::none;
        motion.attempt.overlookedDepth = depth;
    }
    fault = fault == StepFault::none ? moveUnlessAtFault(step) : fault;
    if (fault != StepFault::none)
    {
        motion.attempt.fault = fault;
        return 0; // to be tried shorter
    }
    account(step);
    return 1;
}

} // namespace

template<int Dim>
double advanceUnparted(const DynamicCase<Dim>& scene, Motion<Dim>& motion, double timeStep,
                       const ImpactChoice& impacts, AttemptForces<Dim>* attemptForces)
{
    return takeStep(scene, motion, timeStep, impacts, attemptForces, {});
}

template double advanceUnparted(const DynamicCase<2>& scene, Motion<2>& motion, double timeStep,
                                const ImpactChoice& impacts, AttemptForces<2>* attemptForces);
template double advanceUnparted(const DynamicCase<3>& scene, Motion<3>& motion, double timeStep,
                                const ImpactChoice& impacts, AttemptForces<3>* attemptForces);

} // namespace drystone
