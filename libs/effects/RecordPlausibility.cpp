// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Doubts about records of the ground.
#include "effects/RecordPlausibility.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace drystone
{
namespace
{

/// Peaks of records [m/s2]. Above 2 g there are a handful in all catalogues; below, nobody felt it.
constexpr double weakestRecord = 0.01;
constexpr double strongestRecord = 20;
/// Peaks of records in g are below; of records in m/s2 most are above.
constexpr double strongestInG = 1;
/// The part of the peak velocity that may be left when a record ends: corrected records leave some percent.
constexpr double velocityLeft = 0.1;

/// An interval that is so many times the median one lacks rows: those of records that were digitised by hand,
/// at their peaks, differ by less.
constexpr double longestInterval = 20;

/// Whether a factor is a multiple of g in m/s2 or cm/s2, or its inverse.
bool convertsFromG(double scale)
{
    const double size = std::abs(scale);
    const auto isNear = [size](double factor) { return std::abs(size / factor - 1) < 2e-3; };
    return isNear(standardGravity) || isNear(100 * standardGravity) || isNear(1 / standardGravity);
}

/// The velocity that a ground at rest at the first kink has at the last one, and its peak between [m/s].
std::pair<double, double> lastAndPeakVelocity(const GroundAcceleration& history,
                                              const std::vector<double>& kinks)
{
    double velocity = 0;
    double peak = 0;
    for (std::size_t i = 0; i + 1 < kinks.size(); ++i)
    {
        velocity += history.integral(kinks[i], kinks[i + 1]);
        peak = std::max(peak, std::abs(velocity));
    }
    return {velocity, peak};
}

/// Where a record has no values, and its median interval [s].
struct RecordGap
{
    double from = 0;
    double to = 0;
    double usual = 0;
};

/// The longest gap of a record, but for stillness, which has a value at either end. \return nothing where its
/// rows are as far apart as usual
std::optional<RecordGap> gapOf(const GroundAcceleration& history, const std::vector<double>& kinks)
{
    std::vector<double> intervals;
    for (std::size_t i = 0; i + 1 < kinks.size(); ++i)
    {
        intervals.push_back(kinks[i + 1] - kinks[i]);
    }
    if (intervals.size() < fewestSamples)
    {
        return {};
    }
    const auto middle = intervals.begin() + static_cast<std::ptrdiff_t>(intervals.size() / 2);
    std::nth_element(intervals.begin(), middle, intervals.end());
    RecordGap gap{0, 0, *middle};
    for (std::size_t i = 0; i + 1 < kinks.size(); ++i)
    {
        const bool isStill = history.integral(kinks[i], kinks[i + 1]) == 0;
        if (!isStill && kinks[i + 1] - kinks[i] > std::max(gap.to - gap.from, longestInterval * gap.usual))
        {
            gap.from = kinks[i];
            gap.to = kinks[i + 1];
        }
    }
    return gap.to > gap.from ? std::optional(gap) : std::nullopt;
}

/// Of the size of the record: its peak, its unit and what it is scaled by.
std::optional<Doubt> doubtAboutSize(const GroundMotion::Component& component, const Dictionary& acceleration)
{
    const double peak = component.acceleration->peak();
    const double scale = acceleration.getOrDefault<double>("scale", 1);
    if (component.valueUnit != 1 && convertsFromG(scale))
    {
        return Doubt{fmt::format("scale {:g} converts a record that is converted already: a value of 1 in "
                                 "the file is {:g} m/s2, so that the peak is {:.4g} m/s2 "
                                 "(without the scale {:.4g} m/s2). Usual is `scale 1;`.",
                                 scale, component.valueUnit, peak, peak / std::abs(scale)),
                     acceleration.locationOf("scale")};
    }
    if (peak > 0 && (peak < weakestRecord || peak > strongestRecord))
    {
        return Doubt{fmt::format("The record has a peak of {:.4g} m/s2, which is unusual: usual "
                                 "is from {:g} to {:g} m/s2. Check unit and scale; the record is used as "
                                 "it stands.",
                                 peak, weakestRecord, strongestRecord),
                     acceleration.locationOf("file")};
    }
    if (component.unitIsAssumed && !acceleration.found("peakAcceleration") && peak > 0
        && peak < strongestInG * std::abs(scale) && !convertsFromG(scale))
    {
        return Doubt{
            fmt::format("The record does not say its unit, and m/s2 is assumed: its largest value of "
                        "{:.4g} is as usual in g. Declare `unit g;` or `unit m/s2;`.",
                        peak / std::abs(scale)),
            acceleration.locationOf("file")};
    }
    return std::nullopt;
}

std::optional<Doubt> doubtAboutRows(const GroundAcceleration& history, const std::vector<double>& kinks,
                                    const SourceLocation& file)
{
    const std::optional<RecordGap> gap = gapOf(history, kinks);
    if (!gap)
    {
        return std::nullopt;
    }
    return Doubt{
        fmt::format("The record has no value between {:g} and {:g} s of the motion, {:.0f} times its "
                    "usual interval of {:g} s: what the ground does there is interpolated. Check that "
                    "no rows are missing.",
                    gap->from, gap->to, (gap->to - gap->from) / gap->usual, gap->usual),
        file};
}

std::optional<Doubt> doubtAboutDrift(const GroundAcceleration& history, const std::vector<double>& kinks,
                                     const SourceLocation& file)
{
    const auto [last, largest] = lastAndPeakVelocity(history, kinks);
    if (!(std::abs(last) > velocityLeft * largest))
    {
        return std::nullopt;
    }
    return Doubt{
        fmt::format("The record drifts: its mean acceleration is {:.4g} m/s2, so that the ground still "
                    "moves at {:.4g} m/s at its end, {:.0f}% of the peak velocity of {:.4g} m/s. Usual "
                    "is at most {:.0f}%; `baseline constant;` takes the mean away, `baseline linear;` a "
                    "drift that grows.",
                    last / (kinks.back() - kinks.front()), last, 100 * std::abs(last) / largest, largest,
                    100 * velocityLeft),
        file};
}

} // namespace

std::vector<Doubt> doubtsAboutRecord(const GroundMotion::Component& component, const Dictionary& acceleration)
{
    std::vector<Doubt> doubts;
    if (component.valueUnit == 0)
    {
        return doubts;
    }
    const auto add = [&doubts](std::optional<Doubt> doubt)
    {
        if (doubt)
        {
            doubts.push_back(std::move(*doubt));
        }
    };
    const GroundAcceleration& history = *component.acceleration;
    const std::vector<double> kinks = history.kinks();
    const SourceLocation file = acceleration.locationOf("file");
    add(doubtAboutSize(component, acceleration));
    if (kinks.size() < 2)
    {
        add(Doubt{"The record has a single value, which lasts no time: the ground does not move. Check "
                  "that the file is complete.",
                  file});
        return doubts;
    }
    add(doubtAboutRows(history, kinks, file));
    add(doubtAboutDrift(history, kinks, file));
    return doubts;
}

} // namespace drystone
