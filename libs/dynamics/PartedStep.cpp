// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Parts of a step, and how they are put together: observers see steps, not the parts that impacts make of
/// them.
#include "dynamics/PartedStep.h"

#include "contact/PointsOfPair.h"
#include "dynamics/UnpartedStep.h"

#include <algorithm>
#include <optional>

namespace drystone
{
namespace
{

/// Points that stay as built have no features; they are known by their places.
template<int Dim>
bool isSame(const ContactPoint<Dim>& a, const ContactPoint<Dim>& b)
{
    return a.block == b.block && a.neighbour == b.neighbour && isSameFeature<Dim>(a.feature, b.feature)
           && (a.feature.vertexBlock >= 0 || a.position == b.position);
}

} // namespace

template<int Dim>
void PartedStep<Dim>::count(const StepResiduals& attempt)
{
    work.initialResidual = std::max(work.initialResidual, attempt.initialResidual);
    work.primalResidual = std::max(work.primalResidual, attempt.primalResidual);
    work.dualResidual = std::max(work.dualResidual, attempt.dualResidual);
    work.dualityGap = std::max(work.dualityGap, attempt.dualityGap);
    work.flowError = std::max(work.flowError, attempt.flowError);
    work.overlookedDepth = std::max(work.overlookedDepth, attempt.overlookedDepth);
    work.iterations += attempt.iterations;
    work.factorisations += attempt.factorisations;
    work.programs += attempt.programs;
}

template<int Dim>
void PartedStep<Dim>::add(const Motion<Dim>& motion, double length)
{
    const std::vector<Vector<Dim>>& forces = meanContactForces(motion);
    for (std::size_t i = 0; i < motion.points.size(); ++i)
    {
        const ContactPoint<Dim>& point = motion.points[i];
        const auto [first, last] = entriesOf(pairOf(point), impulses.begin(), impulses.end(),
                                             [](const Carried& carried) { return pairOf(carried.point); });
        const auto there = std::find_if(
            first, last, [&point](const Carried& carried) { return isSame(carried.point, point); });
        const Vector<Dim> impulse = length * forces[i];
        if (there != last)
        {
            there->point = point;
            there->impulse += impulse;
        }
        else if (!impulse.isZero(0))
        {
            impulses.insert(last, {point, impulse});
        }
    }
    duration += length;
    leastShare = std::min(leastShare, motion.restitutionShare);
    ++parts;
}

namespace
{

/// A point that carries nothing when the step ends.
template<int Dim>
void insertPoint(Motion<Dim>& motion, std::ptrdiff_t index, const ContactPoint<Dim>& point)
{
    motion.points.insert(motion.points.begin() + index, point);
    motion.contactForces.insert(motion.contactForces.begin() + index, Vector<Dim>::Zero());
    motion.meanForces.insert(motion.meanForces.begin() + index, Vector<Dim>::Zero());
    if (motion.interior.isEmpty())
    {
        return;
    }
    for (Eigen::VectorXd* ofPoints : {&motion.interior.contactForce, &motion.interior.opening})
    {
        const Eigen::VectorXd old = *ofPoints;
        ofPoints->resize(old.size() + Dim);
        *ofPoints << old.head(Dim * index), Vector<Dim>::Zero(), old.tail(old.size() - Dim * index);
    }
}

} // namespace

template<int Dim>
void PartedStep<Dim>::finish(Motion<Dim>& motion) const
{
    if (parts < 2)
    {
        return;
    }
    motion.residuals = work;
    motion.attempt = work;
    motion.restitutionShare = leastShare;
    motion.meanForces.assign(motion.points.size(), Vector<Dim>::Zero());
    for (const Carried& carried : impulses)
    {
        const auto [first, last] =
            entriesOf(pairOf(carried.point), motion.points.begin(), motion.points.end(), pairOf<Dim>);
        const auto there = std::find_if(
            first, last, [&carried](const ContactPoint<Dim>& point) { return isSame(point, carried.point); });
        const auto index = there - motion.points.begin();
        if (there == last)
        {
            insertPoint(motion, index, carried.point);
        }
        motion.meanForces[static_cast<std::size_t>(index)] += carried.impulse / duration;
    }
}

namespace
{

/// An attempt at a part of a step.
struct TriedPart
{
    double length = 0; ///< [s]
    double meets = 0;  ///< from its start until blocks meet in it [s]
};

/// How long the next attempt at a part is. When blocks meet depends on the length of the part that it is
/// measured in; where two attempts show how, the next one is as long as it takes to meet at its end (the
/// secant method), less a little, so that they do not: what is left then counts as having met. With theta
/// below 1 it would be closed without a loss, which gains energy. \param before of another attempt from the
/// same start; or none \param tolerance see ImpactChoice
double nextLength(const TriedPart& last, const std::optional<TriedPart>& before, double theta,
                  double tolerance)
{
    constexpr double steepest = 0.7; // beyond, what is measured is no smooth function of the length
    constexpr double partOfChange = 0.1;
    constexpr double partOfTolerance = 0.25;
    const double slope =
        before && theta == 1 ? (last.meets - before->meets) / (last.length - before->length) : 0;
    if (!(slope > 0 && slope < steepest))
    {
        return last.meets;
    }
    const double meeting = (last.meets - slope * last.length) / (1 - slope);
    return meeting - std::min(partOfChange * (last.meets - meeting), partOfTolerance * tolerance);
}

/// Which impacts part a step at first. They are distinguished from the start of a step, and from each other,
/// by a part of it: velocities are right to the tolerance of the solver, and so are instants after a flight
/// of some thousand steps. Distinguished more finely, corners that meet together would meet one after the
/// other, and a block that bounces flat would begin to rock.
template<int Dim>
ImpactChoice impactsOf(const DynamicCase<Dim>& scene, double timeStep)
{
    constexpr double leastTolerance = 1e-3;
    constexpr double stepsOfFlight = 1e4;
    constexpr double shortestFlight = 0.1; // bounces that grow shorter for ever end with it
    const double tolerance = std::max(leastTolerance, stepsOfFlight * scene.solution.tolerance);
    const bool isLocated = scene.schemes.impacts == ImpactInstant::located && tolerance < 1;
    return {isLocated ? ImpactInstant::located : ImpactInstant::stepStart, tolerance * timeStep,
            isLocated ? shortestFlight * timeStep : 0, timeStep};
}

/// Takes all parts back, but for the work that they took. Copied, so that the motion's lists stay where they
/// are: observers may hold on to them.
template<int Dim>
void takeBack(Motion<Dim>& motion, const Motion<Dim>& before)
{
    const StepWork work = motion.work;
    const StageTimes stageTimes = motion.stageTimes;
    motion = before;
    motion.work = work;
    motion.stageTimes = stageTimes;
    motion.work.beginAttempt();
}

/// A step whose parts are taken one after the other.
template<int Dim>
struct PartsInTurn
{
    ImpactChoice impacts;
    double left;                            ///< of the step [s]
    double length;                          ///< of the next attempt [s]
    std::optional<Motion<Dim>> before = {}; ///< where the step is parted; empty: it is not yet
    PartedStep<Dim> parts = {};
    AttemptForces<Dim> attemptForces = {};
    std::optional<TriedPart> tried = {}; ///< from where the next attempt begins
};

/// Goes on from the end of a part that was taken.
template<int Dim>
void goOn(PartsInTurn<Dim>& turn, const Motion<Dim>& motion)
{
    turn.parts.add(motion, turn.length);
    turn.left = turn.length == turn.left ? 0 : turn.left - turn.length;
    // What the first attempt knew of more than what is left says more of it than a shorter part does.
    PointForces<Dim> forces =
        turn.left > turn.length ? std::move(turn.attemptForces.meeting) : PointForces<Dim>();
    turn.attemptForces = {};
    turn.attemptForces.start = std::move(forces);
    turn.tried.reset();
    turn.length = turn.left;
}

/// Shortens a part in which blocks meet. \param share of it after which they do
template<int Dim>
void shorten(PartsInTurn<Dim>& turn, double share, double theta)
{
    turn.attemptForces.start = std::move(turn.attemptForces.apart);
    const TriedPart last{turn.length, share * turn.length};
    // What is left of the step is not shorter than what counts as its start.
    turn.length = std::min(nextLength(last, turn.tried, theta, turn.impacts.tolerance),
                           turn.left - turn.impacts.tolerance);
    turn.tried = last;
    if (turn.length <= 0)
    {
        turn.length = turn.left;
        turn.impacts.instant = ImpactInstant::stepStart;
    }
}

template<int Dim>
bool takeParts(const DynamicCase<Dim>& scene, Motion<Dim>& motion, double timeStep)
{
    // Attempts are limited, so that bounces which grow shorter for ever, or blocks that hit each other from
    // all sides, do not part a step without an end.
    constexpr int mostAttempts = 8;
    constexpr double mostWork = 0.1; // of what a step may take, before it is no longer parted
    motion.work.beginAttempt();
    const double start = motion.state.time;
    PartsInTurn<Dim> turn{.impacts = impactsOf(scene, timeStep), .left = timeStep, .length = timeStep};
    for (int attempts = 0; turn.left > 0; ++attempts)
    {
        if (attempts >= mostAttempts || motion.work.done > mostWork * motion.work.most)
        {
            turn.impacts.instant = ImpactInstant::stepStart;
        }
        const double share = advanceUnparted(scene, motion, turn.length, turn.impacts, &turn.attemptForces);
        if (share == 0 && turn.before)
        {
            // A part may be too short for the tolerance of the solver: then the step as a whole.
            takeBack(motion, *turn.before);
            return advanceUnparted(scene, motion, timeStep, {.isOfAllBlocks = true}) == 1;
        }
        if (share == 0)
        {
            return false;
        }
        if (share == 1 && !turn.before)
        {
            return true;
        }
        turn.impacts.isOfAllBlocks = true;
        turn.parts.count(motion.attempt);
        if (share == 1)
        {
            goOn(turn, motion);
            continue;
        }
        if (!turn.before)
        {
            turn.before = motion;
        }
        shorten(turn, share, scene.schemes.timeIntegration.theta);
    }
    turn.parts.finish(motion);
    motion.state.time = start + timeStep; // as if it had not been parted, to the last digit
    return true;
}

} // namespace

template<int Dim>
bool advanceInParts(const DynamicCase<Dim>& scene, Motion<Dim>& motion, double timeStep)
{
    std::vector<EffectState> before = motion.effectStates;
    const bool isSolved = takeParts(scene, motion, timeStep);
    if (isSolved)
    {
        motion.effectStatesBefore = std::move(before);
    }
    return isSolved;
}

template class PartedStep<2>;
template bool advanceInParts(const DynamicCase<2>& scene, Motion<2>& motion, double timeStep);
template class PartedStep<3>;
template bool advanceInParts(const DynamicCase<3>& scene, Motion<3>& motion, double timeStep);

} // namespace drystone
