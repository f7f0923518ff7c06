// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The time step as a page of verbs, and the retry of steps that are not solved.
#include "dynamics/Advance.h"

#include "dynamics/PartedStep.h"

#include <algorithm>
#include <cmath>

namespace drystone
{
namespace
{

constexpr int mostHalvings = 10;

StepWork allowedWork(const DynamicCase& scene)
{
    StepWork work;
    work.most = scene.solution.maximumFactorisations;
    return work;
}

/// The next step of a run with adjustTimeStep [s]. \param timeStep the last one
double nextTimeStep(const DynamicCase& scene, const Motion& motion, double timeStep)
{
    const double now = motion.state.time;
    double fastest = 0;
    for (const Vector<3>& velocity : velocitiesOfAllBlocks(scene, motion.state, now, now))
    {
        fastest = std::max(fastest, velocity.head<2>().norm() + scene.blockSize * std::abs(velocity[2]));
    }
    const double allowed = std::min(scene.schemes.maxDeltaT, 1.2 * timeStep);
    const double reach = scene.schemes.maxDisplacement * scene.blockSize;
    return fastest * allowed > reach ? reach / fastest : allowed;
}

} // namespace

double advanceUnparted(const DynamicCase& scene, Motion& motion, double timeStep, const ImpactChoice& impacts)
{
    Step step(scene, motion, timeStep, impacts);
    findContacts(step);
    assemble(step);
    contribute(step);
    do
    {
        beginAgain(step);
        solve(step);
        while (collide(step))
        {
            solve(step);
        }
    } while (review(step));
    if (!step.solved.isSolved)
    {
        return step.solved.length < 1 ? step.solved.length : 0;
    }
    move(step);
    account(step);
    return 1;
}

bool advance(const DynamicCase& scene, Motion& motion, double timeStep)
{
    motion.work = allowedWork(scene);
    return advanceInParts(scene, motion, timeStep);
}

ShortenedStep advanceOrShorten(const DynamicCase& scene, Motion& motion, double timeStep)
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

bool advance(const DynamicCase& scene, Motion& motion, Time& time)
{
    const ShortenedStep taken = advanceOrShorten(scene, motion, time.deltaT());
    if (!taken.isSolved)
    {
        time.abandonStep();
        return false;
    }
    if (taken.timeStep < time.deltaT())
    {
        time.shortenStep(taken.timeStep);
    }
    motion.state.time = time.value(); // the sum of the steps may differ from it in the last digit
    if (time.controls().adjustTimeStep)
    {
        time.setDeltaT(nextTimeStep(scene, motion, taken.timeStep));
    }
    return true;
}

} // namespace drystone
