// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Counting of intervals.
#include "runControl/OutputControl.h"

#include "core/Log.h"

#include <algorithm>
#include <cmath>

namespace drystone
{

namespace
{

constexpr double nearestStep = 0.5;

/// What rounding may add up to, as part of a time.
constexpr double ofValue = 1e-13;

} // namespace

double reachOf(const TimePoint& now)
{
    return now.endsOnInstants ? 1e-6 * now.deltaT + ofValue * std::abs(now.value) : nearestStep * now.deltaT;
}

double sameInstant(double value, double deltaT)
{
    return 1e-9 * deltaT + ofValue * std::abs(value);
}

void declare(Options& options, OutputSettings& settings)
{
    options.optional("writeControl", settings.writeControl, "what writeInterval counts");
    options.optional("writeInterval", settings.writeInterval, "write every so many steps or seconds")
        .above(0);
    options.check(
        "writeInterval",
        [&settings]() -> std::string
        {
            const bool counts = settings.writeControl == WriteControl::timeStep
                                || settings.writeControl == WriteControl::writeTime;
            if (!counts || settings.writeInterval == std::floor(settings.writeInterval))
            {
                return {};
            }
            return "writeInterval counts steps, and is not a whole number.\n\nGive a whole number, or "
                   "`writeControl runTime;` for an interval in seconds.";
        });
}

OutputControl::OutputControl(const OutputSettings& outputSettings, const TimePoint& begin, double origin)
    : settings(outputSettings), start(origin)
{
    passed = intervalsPassed(begin);
}

double OutputControl::intervalsPassed(const TimePoint& now) const
{
    const auto count = [&](double amount) { return std::floor(amount / settings.writeInterval); };
    switch (settings.writeControl)
    {
    case WriteControl::timeStep:
        return count(static_cast<double>(now.index - now.unfinished));
    case WriteControl::writeTime:
        return count(static_cast<double>(now.writeTimes));
    // Half a step early, so that rounding does not put the write off by a step.
    case WriteControl::runTime:
        return count(now.value - start + nearestStep * now.deltaT);
    case WriteControl::adjustableRunTime:
        return count(now.value - start + reachOf(now));
    case WriteControl::cpuTime:
        return count(now.cpuTime ? *now.cpuTime : cpuTime());
    case WriteControl::clockTime:
        return count(now.clockTime ? *now.clockTime : clockTime());
    case WriteControl::none:
        break;
    }
    return 0;
}

bool OutputControl::due(const TimePoint& now)
{
    const double count = intervalsPassed(now);
    const bool isDue = count > passed;
    passed = count;
    return isDue;
}

double OutputControl::timeToNextWrite(double value, double deltaT) const
{
    if (settings.writeControl != WriteControl::adjustableRunTime)
    {
        return std::numeric_limits<double>::infinity();
    }
    const double count = std::floor((value - start + sameInstant(value, deltaT)) / settings.writeInterval);
    return (count + 1) * settings.writeInterval - (value - start);
}

} // namespace drystone
