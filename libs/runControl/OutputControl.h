// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// When to write: writeControl and writeInterval, of a run or of a single function object.
#pragma once

#include "dictionary/Options.h"

#include <array>
#include <optional>
#include <string_view>
#include <utility>

namespace drystone
{

/// What writeInterval counts.
enum class WriteControl
{
    none,              ///< never
    timeStep,          ///< steps of deltaT, in how many parts each may be made
    runTime,           ///< seconds of simulated time; writes at the first step that reaches the instant
    adjustableRunTime, ///< the same, and adjustTimeStep makes steps end on the instants
    cpuTime,           ///< seconds of CPU time
    clockTime,         ///< seconds of real time
    writeTime          ///< for function objects: the times at which the run itself writes
};

inline std::array<std::pair<std::string_view, WriteControl>, 7> namesOf(WriteControl)
{
    return {{{"none", WriteControl::none},
             {"timeStep", WriteControl::timeStep},
             {"runTime", WriteControl::runTime},
             {"adjustableRunTime", WriteControl::adjustableRunTime},
             {"cpuTime", WriteControl::cpuTime},
             {"clockTime", WriteControl::clockTime},
             {"writeTime", WriteControl::writeTime}}};
}

/// Settings of an OutputControl; also the keys of a function object.
struct OutputSettings
{
    WriteControl writeControl = WriteControl::timeStep;
    double writeInterval = 1; ///< [steps] or [s]; for writeTime, every how many of them
};

/// Declares writeControl and writeInterval, their defaults being the values of `settings`.
void declare(Options& options, OutputSettings& settings);

/// A moment of a run.
struct TimePoint
{
    double value = 0;    ///< simulated time [s]
    double deltaT = 0;   ///< of the step that led here [s]
    long index = 0;      ///< number of steps since time 0, parts of steps counted as steps
    long writeTimes = 0; ///< at which the run has written its state by now, this one too
    /// [s]; absent: as they are when they are read, since few outputs do and reading them costs a call
    /// of the system.
    std::optional<double> cpuTime = {};
    std::optional<double> clockTime = {};
    /// How many of the steps were no ends of steps that were requested: all but the last of the parts that
    /// one is made in where it cannot be solved as a whole.
    long unfinished = 0;
    bool endsOnInstants = false; ///< with adjustTimeStep: steps end on instants to write at
};

/// How long before an instant that steps may end on counts as reached [s]: where they do, by rounding only;
/// else half a step, so that a write is at the nearest one.
double reachOf(const TimePoint& now);

/// Within how much of each other two instants are one: that of rounding [s]. \param deltaT of a step there
double sameInstant(double value, double deltaT);

/// Whether a moment is one to write at. To be called once a step, in order.
class OutputControl
{
public:
    OutputControl() = default;
    /// \param begin where the run starts or continues: instants up to there are taken as written
    /// \param origin simulated time from which intervals of time are counted: startTime [s]
    OutputControl(const OutputSettings& outputSettings, const TimePoint& begin, double origin = 0);

    bool due(const TimePoint& now);
    /// How long until the next instant of adjustableRunTime; infinite for the other controls [s].
    double timeToNextWrite(double value, double deltaT) const;

private:
    /// Number of whole intervals that have passed: as large as the smallest interval makes it.
    double intervalsPassed(const TimePoint& now) const;

    OutputSettings settings;
    double start = 0;
    double passed = 0;
};

} // namespace drystone
