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

/// Fewer points are those of a pulse or a ramp, and not samples.
constexpr std::size_t fewestSamples = 10;

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

} // namespace

std::vector<Doubt> doubtsAboutTimes(const GroundMotion& motion, const Schemes& schemes,
                                    const TimeControls& controls, const Dictionary& controlDict)
{
    const double longestStep = controls.adjustTimeStep ? schemes.maxDeltaT : controls.deltaT;
    std::vector<Doubt> doubts;
    double interval = 0;
    double end = -std::numeric_limits<double>::infinity(); // of a ground at rest there is none
    for (const GroundMotion::Component& component : motion.components)
    {
        const double samples = sampleInterval(*component.acceleration);
        if (samples > 0 && (interval == 0 || samples < interval))
        {
            interval = samples;
        }
        if (const double last = component.acceleration->end(); std::isfinite(last))
        {
            end = std::max(end, last);
        }
    }
    if (interval > 0 && longestStep > 1.001 * interval)
    {
        const bool isChosen = controls.adjustTimeStep;
        doubts.push_back(
            {fmt::format("{} coarser than the motion of the ground, which has a point every {:g} s: "
                         "its peaks are averaged over the steps. Usual is {} of at most that.",
                         isChosen ? fmt::format("With adjustTimeStep and maxDeltaT {:g} s steps may become",
                                                longestStep)
                                  : fmt::format("deltaT {:g} s is", longestStep),
                         interval, isChosen ? "a maxDeltaT (system/schemes)" : "a deltaT"),
             controlDict.locationOf(isChosen ? "adjustTimeStep" : "deltaT")});
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
