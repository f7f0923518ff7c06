// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Follows a run for its closing lines.
#include "functionObjects/MotionSummary.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace drystone
{

void StepsInError::add(double error, double time)
{
    timeOfFirst = count == 0 ? time : timeOfFirst;
    largest = std::max(largest, error);
    ++count;
}

template<int Dim>
MotionSummary<Dim>::MotionSummary(const DynamicCase<Dim>& dynamicCase) : scene(dynamicCase)
{
}

template<int Dim>
double MotionSummary<Dim>::restSpeed() const
{
    constexpr double share = 1e-8; // of the block size; v^2 = 2 g h
    return std::sqrt(2 * scene.gravity.norm() * share * scene.blockSize);
}

template<int Dim>
double MotionSummary<Dim>::speedOf(const DynamicState<Dim>& state, int free) const
{
    const auto velocity = state.velocity.template segment<freedomCount<Dim>>(freedomCount<Dim> * free);
    return std::max(velocity.template head<Dim>().norm(),
                    0.5 * scene.blockSize * velocity.template tail<rotationCount<Dim>>().norm());
}

template<int Dim>
void MotionSummary<Dim>::observe(const DynamicState<Dim>& state, const StepResiduals& residuals)
{
    ++steps;
    if (missesFlow(scene, residuals.flowError))
    {
        missedFlow.add(residuals.flowError, state.time);
    }
    if (residuals.isWithoutRebounds)
    {
        withoutRebounds.add(0, state.time);
    }
    if (overlooksContacts(scene, residuals.overlookedDepth))
    {
        overlookedContacts.add(residuals.overlookedDepth, state.time);
    }
    double speed = 0;
    for (std::size_t block = 0; block < scene.free.size(); ++block)
    {
        if (scene.free[block] < 0)
        {
            continue;
        }
        const double displacement = state.placements[block].translation.norm();
        if (displacement > largest)
        {
            largest = displacement;
            farthestBlock = static_cast<int>(block);
            timeOfLargest = state.time;
        }
        const double turn = rowsOf(state.placements[block].rotation).norm();
        if (turn > largestTurn)
        {
            largestTurn = turn;
            turnedBlock = static_cast<int>(block);
        }
        speed = std::max(speed, speedOf(state, scene.free[block]));
    }
    fastest = std::max(fastest, speed);
    const bool restsNow = speed <= restSpeed();
    if (restsNow && !rests)
    {
        restsSince = state.time;
    }
    rests = restsNow;
}

template<int Dim>
std::string MotionSummary<Dim>::largestDisplacementLine() const
{
    return farthestBlock < 0 ? "Largest displacement: 0 m"
                             : fmt::format("Largest displacement: {:.3g} m, block {}, at {:.4g} s", largest,
                                           farthestBlock, timeOfLargest);
}

template<int Dim>
std::string MotionSummary<Dim>::restLine(const DynamicState<Dim>& last) const
{
    if (!rests)
    {
        int fastestBlock = -1;
        double speed = -1;
        for (std::size_t block = 0; block < scene.free.size(); ++block)
        {
            const int free = scene.free[block];
            if (free >= 0 && speedOf(last, free) > speed)
            {
                speed = speedOf(last, free);
                fastestBlock = static_cast<int>(block);
            }
        }
        return fmt::format("The blocks move at the end, block {} at {:.2g} m/s: a later endTime shows "
                           "where they come to rest",
                           fastestBlock, speed);
    }
    // A block that rocks is slow at its turning points, for less than it takes to fall through its size.
    const double pause = std::sqrt(2 * scene.blockSize / std::max(scene.gravity.norm(), 1e-300));
    return last.time - restsSince >= pause
               ? fmt::format("The blocks have come to rest, at {:.4g} s", restsSince)
               : fmt::format("The blocks are at rest since {:.4g} s, which may be a turning point: a "
                             "later endTime shows it",
                             restsSince);
}

template<int Dim>
std::string MotionSummary<Dim>::farBlocksLine(const DynamicState<Dim>& last) const
{
    int far = 0;
    int freeBlocks = 0;
    for (std::size_t block = 0; block < scene.free.size(); ++block)
    {
        const bool isFree = scene.free[block] >= 0;
        freeBlocks += isFree;
        far += isFree && last.placements[block].translation.norm() > 0.5 * scene.blockSize;
    }
    return fmt::format("Farther from their places than half the mean block size of {:.3g} m: {} of {} blocks",
                       scene.blockSize, far, freeBlocks);
}

template<int Dim>
std::string MotionSummary<Dim>::missedFlowLine() const
{
    const std::string others =
        missedFlow.count < steps
            ? fmt::format(", in the others to {:.2g} m", scene.schemes.contactTolerance * scene.blockSize)
            : "";
    return fmt::format("Coulomb's law is satisfied to {:.2g} m of dilatancy in {} of {} steps{}: shorter "
                       "steps miss it by less",
                       missedFlow.largest, missedFlow.count, steps, others);
}

template<int Dim>
std::string MotionSummary<Dim>::overlookedContactsLine() const
{
    return fmt::format("Blocks are in each other by up to {:.2g} m at the end of {} of {} steps, the first "
                       "at {:.4g} s, where no contact was foreseen: shorter steps foresee it",
                       overlookedContacts.largest, overlookedContacts.count, steps,
                       overlookedContacts.timeOfFirst);
}

template<int Dim>
std::string MotionSummary<Dim>::withoutReboundsLine() const
{
    return fmt::format(
        "Blocks that hit each other stay together in {} of {} steps, the first at {:.4g} s, as "
        "by theta 1 without restitution: impacts one after the other had no end within "
        "maximumFactorisations",
        withoutRebounds.count, steps, withoutRebounds.timeOfFirst);
}

template<int Dim>
std::vector<std::string> MotionSummary<Dim>::lines(const DynamicState<Dim>& last) const
{
    if (steps == 0)
    {
        return {};
    }
    std::vector<std::string> text = {largestDisplacementLine()};
    if (fastest <= restSpeed())
    {
        text.push_back(fmt::format("The blocks stand still: none was faster than {:.2g} m/s", fastest));
        return text;
    }
    text.push_back(restLine(last));
    text.push_back(farBlocksLine(last));
    if (missedFlow.count > 0)
    {
        text.push_back(missedFlowLine());
    }
    if (overlookedContacts.count > 0)
    {
        text.push_back(overlookedContactsLine());
    }
    if (withoutRebounds.count > 0)
    {
        text.push_back(withoutReboundsLine());
    }
    return text;
}

template<int Dim>
std::string MotionSummary<Dim>::doubtAboutDisplacements() const
{
    const double share = largest / scene.blockSize;
    const bool turnsMore = 0.5 * largestTurn > share;
    if (!scene.schemes.smallDisplacements || std::max(share, 0.5 * largestTurn) <= mostSmallDisplacement)
    {
        return {};
    }
    return fmt::format(
        "`smallDisplacements yes;` of system/schemes holds for the structure as built, and {}: "
        "whether blocks move is right, how far and where to is not. `smallDisplacements no;` "
        "follows them.",
        turnsMore ? fmt::format("block {} has turned by {:.3g} rad", turnedBlock, largestTurn)
                  : fmt::format("block {} has moved by {:.3g} m, which is {:.3g} of the mean "
                                "block size",
                                farthestBlock, largest, share));
}

template class MotionSummary<2>;
template class MotionSummary<3>;

} // namespace drystone
