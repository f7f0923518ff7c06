// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The retry of steps that are not solved, and the lengths of those of a run.
#include "dynamics/Advance.h"

#include "dynamics/PartedStep.h"
#include "dynamics/VerifiedStep.h"

#include <algorithm>
#include <optional>

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

/// What attempts without rebounds may take once more of the work that a step may, which those with rebounds
/// have used up.
constexpr double workWithoutRebounds = 0.5;

/// Of a step that is chosen, over the last one that was.
constexpr double mostGrowth = 1.2;

/// Of a step that is chosen, over the last one that was taken. One cut short for an instant need not grow
/// anew from there; but lengths that no step has had would grow without bound at rest, and pass over the
/// points of a record, which are distinguished from the end of a step by a part of its length.
constexpr double mostOverStep = 10;

/// The same where blocks that hit each other stay together: backward Euler without restitution, whose program
/// is the plastic impact. It takes the energy of the rebounds, and creates none.
template<int Dim>
DynamicCase<Dim> withoutRebounds(DynamicCase<Dim> scene)
{
    scene.schemes.timeIntegration.theta = 1;
    scene.contact.restitution.reset();
    return scene;
}

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

} // namespace

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

namespace
{

/// Halves the step until it is solved, as often and as long as is allowed.
template<int Dim>
ShortenedStep halveUntilSolved(const DynamicCase<Dim>& scene, Motion<Dim>& motion, double timeStep)
{
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

} // namespace

template<int Dim>
ShortenedStep advanceOrShorten(const DynamicCase<Dim>& scene, Motion<Dim>& motion, double timeStep)
{
    motion.work = allowedWork(scene);
    ShortenedStep taken = halveUntilSolved(scene, motion, timeStep);
    if (taken.isSolved || !hasImpacts(scene))
    {
        return taken;
    }
    motion.work.most = motion.work.done + workWithoutRebounds * motion.work.most;
    taken = halveUntilSolved(withoutRebounds(scene), motion, timeStep);
    if (taken.isSolved)
    {
        motion.residuals.isWithoutRebounds = true;
    }
    return taken;
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

template bool advance(const DynamicCase<2>& scene, Motion<2>& motion, double timeStep);
template ShortenedStep advanceOrShorten(const DynamicCase<2>& scene, Motion<2>& motion, double timeStep);
template bool advance(const DynamicCase<2>& scene, Motion<2>& motion, Time& time);
template void chooseTimeStep(const DynamicCase<2>& scene, const Motion<2>& motion, double wanted, Time& time);
template bool advance(const DynamicCase<3>& scene, Motion<3>& motion, double timeStep);
template ShortenedStep advanceOrShorten(const DynamicCase<3>& scene, Motion<3>& motion, double timeStep);
template bool advance(const DynamicCase<3>& scene, Motion<3>& motion, Time& time);
template void chooseTimeStep(const DynamicCase<3>& scene, const Motion<3>& motion, double wanted, Time& time);

} // namespace drystone
