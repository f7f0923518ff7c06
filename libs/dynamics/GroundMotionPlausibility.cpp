// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Doubts about the times of a run.
#include "dynamics/GroundMotionPlausibility.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace drystone
{
namespace
{

/// The median distance of the points of a history [s]; 0 of one that is not sampled.
double sampleInterval(const GroundAcceleration& history)
{
    const std::vector<double> kinks = history.kinks();
    std::vector<double> intervals;
    for (std::size_t i = 0; i + 1 < kinks.size(); ++i)
    {
        if (kinks[i + 1] > kinks[i])
        {
            intervals.push_back(kinks[i + 1] - kinks[i]);
        }
    }
    if (intervals.size() < fewestSamples)
    {
        return 0;
    }
    const auto middle = intervals.begin() + static_cast<std::ptrdiff_t>(intervals.size() / 2);
    std::nth_element(intervals.begin(), middle, intervals.end());
    return *middle;
}

/// The longest step that follows the pulses and waves of a history; infinite where it has none [s].
double stepOfWaves(const GroundAcceleration& history)
{
    double longest = std::numeric_limits<double>::infinity();
    for (const double kink : history.kinks())
    {
        longest = std::min(longest, history.stepBounds(kink).longest);
    }
    return longest;
}

} // namespace

std::vector<Doubt> doubtsAboutTimes(const GroundMotion& motion, const TimeControls& controls,
                                    const Dictionary& controlDict)
{
    constexpr double coarse = 5; // times the step that follows waves: a quarter of one
    std::vector<Doubt> doubts;
    double ofWaves = std::numeric_limits<double>::infinity();
    double interval = 0;
    double end = -std::numeric_limits<double>::infinity(); // of a ground at rest there is none
    for (const GroundMotion::Component& component : motion.components)
    {
        const double samples = sampleInterval(*component.acceleration);
        if (samples > 0 && (interval == 0 || samples < interval))
        {
            interval = samples;
        }
        ofWaves = std::min(ofWaves, stepOfWaves(*component.acceleration));
        if (const double last = component.acceleration->end(); std::isfinite(last))
        {
            end = std::max(end, last);
        }
    }
    // With adjustTimeStep steps end at the points of the motion.
    if (interval > 0 && !controls.adjustTimeStep && controls.deltaT > 1.001 * interval)
    {
        doubts.push_back(
            {fmt::format(
                 "deltaT {:g} s is coarser than the motion of the ground, which has a point every {:g} s: "
                 "its peaks are averaged over the steps. Usual is a deltaT of at most that.",
                 controls.deltaT, interval),
             controlDict.locationOf("deltaT")});
    }
    if (!controls.adjustTimeStep && controls.deltaT > coarse * ofWaves)
    {
        doubts.push_back(
            {fmt::format(
                 "deltaT {:g} s is more than a quarter of a pulse or wave of the ground: what it does within "
                 "a step is averaged. Usual is a deltaT of at most {:g} s.",
                 controls.deltaT, ofWaves),
             controlDict.locationOf("deltaT")});
    }
    if (controls.stopAt == StopAt::endTime && end > controls.endTime + 1e-9 * std::abs(controls.endTime))
    {
        doubts.push_back(
            {fmt::format("endTime {:g} s lies within the motion of the ground, which lasts until "
                         "{:g} s: what comes later is not computed. Usual is an endTime after "
                         "that, and some more for the blocks to come to rest.",
                         controls.endTime, end),
             controlDict.locationOf("endTime")});
    }
    return doubts;
}

} // namespace drystone
