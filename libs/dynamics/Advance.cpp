// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The time step as a page of verbs, and the retry of steps that are not solved.
#include "dynamics/Advance.h"

#include "dynamics/CarriedMotion.h"
#include "dynamics/HeldBlocks.h"
#include "dynamics/PartedStep.h"
#include "dynamics/ProvedRest.h"
#include "dynamics/StartCheck.h"
#include "dynamics/VerifiedStep.h"

#include <algorithm>
#include <cmath>

namespace drystone
{
namespace
{

constexpr int mostHalvings = 10;

template<int Dim>
StepWork allowedWork(const DynamicCase<Dim>& scene)
{
    StepWork work;
    work.most = scene.solution.maximumFactorisations;
    return work;
}

/// Steps after one that was solved only as its overlaps stayed, in which they stay too: what such steps take
/// in vain is some hundred factorisations.
constexpr int stepsWithOverlaps = 20;

/// That contact gives a block within a step, beyond what it was turning by [rad].
constexpr double farthestTurn = 1;

/// Of a step that is chosen, over the last one that was.
constexpr double mostGrowth = 1.2;

/// Of a step that is chosen, over the last one that was taken. One cut short for an instant need not grow
/// anew from there; but lengths that no step has had would grow without bound at rest, and pass over the
/// points of a record, which are distinguished from the end of a step by a part of its length.
constexpr double mostOverStep = 10;

/// Adds a step to the use of effects. \param provedBefore steps at rest before it \param since time of all
/// stages at its start [s]
template<int Dim>
void countUse(Motion<Dim>& motion, long provedBefore, double since)
{
    EffectUse& use = motion.effectUse;
    const double seconds = motion.stageTimes.total() - since;
    ++use.steps;
    (use.atRest > provedBefore ? use.secondsAtRest : use.secondsOfOthers) += seconds;
    use.blocks += static_cast<double>(motion.state.velocity.size()) / freedomCount<Dim>;
    use.awakeBlocks += static_cast<double>(awakeBlocks(motion));
    use.bodies += static_cast<double>(simulatedBodies(motion));
    use.calls.resize(motion.effectCalls.size());
    for (std::size_t i = 0; i < use.calls.size(); ++i)
    {
        use.calls[i].steps += motion.effectCalls[i] > 0 ? 1 : 0;
        use.calls[i].places += motion.effectCalls[i];
    }
}

/// Whether contact turns a block farther from where it was heading than its place can be followed from
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
    return Dim == 3 && step.overlooking.size() < mostLooks && work.done <= mostWork * work.most;
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
    findContacts(step);
    assemble(step);
    contribute(step);
    if (motion.overlapsLeft > 0)
    {
        leaveAllOverlaps(step);
        step.overlapsLeft = motion.overlapsLeft - 1;
    }
    do
    {
        beginAgain(step);
        do
        {
            solveOrHelp(step);
        } while (collide(step));
    } while (review(step));
    if (!step.solved.isSolved)
    {
        return step.solved.length < 1 ? step.solved.length : 0;
    }
    StepFault fault = turnsTooFar(step) ? StepFault::turnsTooFar : StepFault::none;
    if (const double depth = fault == StepFault::none ? overlookedDepth(step) : 0; depth > 0)
    {
        if (mayLookAgain(step))
        {
            step.overlooking.push_back(step.solved.result.displacement);
            return takeStep(scene, motion, timeStep, impacts, attemptForces, std::move(step.overlooking));
        }
        fault = motion.contacts->isTooDeep(depth) ? StepFault::entersTooDeep : StepFault::none;
    }
    const DynamicState<Dim> start = motion.state;
    if (fault == StepFault::none)
    {
        move(step);
        measureEnergy(step);
        fault = createsEnergy(step) ? StepFault::createsEnergy
                : motion.contacts && motion.contacts->isAnyTooDeep(step.pointsAtEnd)
                    ? StepFault::entersTooDeep
                    : StepFault::none;
    }
    if (fault != StepFault::none)
    {
        motion.state = start;
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

template<int Dim>
void chooseTimeStep(const DynamicCase<Dim>& scene, const Motion<Dim>& motion, double wanted, Time& time)
{
    const double now = motion.state.time;
    double fastest = 0;
    for (const BlockVector<Dim>& velocity : velocitiesOfAllBlocks(scene, motion.state, now, now))
    {
        fastest =
            std::max(fastest, velocity.template head<Dim>().norm()
                                  + scene.blockSize * velocity.template tail<rotationCount<Dim>>().norm());
    }
    const auto boundsAt = [&scene](double instant)
    {
        StepBounds bounds;
        for (const auto& effect : scene.effects)
        {
            bounds.tighten(effect->stepBounds(instant));
        }
        return bounds;
    };
    const double reach = scene.schemes.maxDisplacement * scene.blockSize;
    double allowed = std::min({scene.schemes.maxDeltaT, wanted, boundsAt(now).longest});
    allowed = fastest * allowed > reach ? reach / fastest : allowed;
    // Nothing that moves ground or supports is stepped over. A change so soon is where the last step has
    // ended, but for rounding: what begins there is followed from now on.
    constexpr double soon = 1e-3; // of a step
    const StepBounds bounds = boundsAt(now + soon * allowed);
    time.setDeltaT(std::min(allowed, bounds.longest), bounds.nextChange);
}

template<int Dim>
bool advance(const DynamicCase<Dim>& scene, Motion<Dim>& motion, double timeStep)
{
    motion.work = allowedWork(scene);
    return advanceInParts(scene, motion, timeStep);
}

template<int Dim>
ShortenedStep advanceOrShorten(const DynamicCase<Dim>& scene, Motion<Dim>& motion, double timeStep)
{
    motion.work = allowedWork(scene);
    for (int retries = 0;; ++retries)
    {
        const bool isSolved = advanceInParts(scene, motion, timeStep);
        motion.attempt.retries = retries;
        if (isSolved)
        {
            motion.residuals.retries = retries;
            return {true, timeStep};
        }
        if (retries == mostHalvings || motion.work.isUsedUp())
        {
            return {false, timeStep};
        }
        timeStep /= 2;
    }
}

template<int Dim>
bool advance(const DynamicCase<Dim>& scene, Motion<Dim>& motion, Time& time)
{
    const ChosenEffects& effects = scene.schemes.effects;
    const bool isVerified = effects.selection == EffectSelection::automatic && effects.verifyInterval > 0
                            && time.index() % effects.verifyInterval == 0;
    std::optional<Motion<Dim>> before;
    if (isVerified)
    {
        before = motion;
    }
    const long proved = motion.effectUse.atRest;
    const double start = motion.stageTimes.total();
    const ShortenedStep taken = advanceOrShorten(scene, motion, time.deltaT());
    if (!taken.isSolved)
    {
        time.abandonStep();
        return false;
    }
    countUse(motion, proved, start);
    if (before)
    {
        verifyStep(scene, *before, taken.timeStep, motion);
    }
    double wanted = time.wantedDeltaT();
    if (taken.timeStep < time.deltaT())
    {
        time.shortenStep(taken.timeStep);
        wanted = taken.timeStep;
    }
    motion.state.time = time.value(); // the sum of the steps may differ from it in the last digit
    if (time.controls().adjustTimeStep)
    {
        chooseTimeStep(scene, motion, std::min(mostGrowth * wanted, mostOverStep * taken.timeStep), time);
    }
    return true;
}

template double advanceUnparted(const DynamicCase<2>& scene, Motion<2>& motion, double timeStep,
                                const ImpactChoice& impacts, AttemptForces<2>* attemptForces);
template bool advance(const DynamicCase<2>& scene, Motion<2>& motion, double timeStep);
template ShortenedStep advanceOrShorten(const DynamicCase<2>& scene, Motion<2>& motion, double timeStep);
template bool advance(const DynamicCase<2>& scene, Motion<2>& motion, Time& time);
template void chooseTimeStep(const DynamicCase<2>& scene, const Motion<2>& motion, double wanted, Time& time);
template double advanceUnparted(const DynamicCase<3>& scene, Motion<3>& motion, double timeStep,
                                const ImpactChoice& impacts, AttemptForces<3>* attemptForces);
template bool advance(const DynamicCase<3>& scene, Motion<3>& motion, double timeStep);
template ShortenedStep advanceOrShorten(const DynamicCase<3>& scene, Motion<3>& motion, double timeStep);
template bool advance(const DynamicCase<3>& scene, Motion<3>& motion, Time& time);
template void chooseTimeStep(const DynamicCase<3>& scene, const Motion<3>& motion, double wanted, Time& time);

} // namespace drystone
