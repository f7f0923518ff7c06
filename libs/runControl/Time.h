// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Simulated time: the loop over time steps, and when to write.
///
///     Time time(commandLine.caseDirectory, ControlDict::required);
///     while (time.loop())
///     {
///         ... solve the step that ends at time.value() ...
///         if (time.isWriteTime())
///             ... write the state into the directory time.name() ...
///         printExecutionTime();
///     }
///     return time.exitStatus();
#pragma once

#include "runControl/Case.h"
#include "runControl/TimeControls.h"

#include <filesystem>
#include <functional>
#include <limits>
#include <string>

namespace drystone
{

/// What of the time a restart needs so that it continues bit for bit.
struct TimeState
{
    double value = 0;
    double deltaT = 0;
    long index = 0;
    double origin = 0; ///< the time is origin + (index - originIndex) deltaT
    long originIndex = 0;
    double detourEnd = 0; ///< later than `value` while a step is being made in parts: where the parts end
    double beginning = 0; ///< when the motion began, in this run or one that it continues [s]
    double wanted = 0;    ///< deltaT before it was shortened so that steps end on an instant; 0: the same [s]
    double given = 0;     ///< deltaT of controlDict, 0: not known [s]
    double stepLength = 0; ///< of the step that led here; 0 where the motion begins [s]
    long writeTimes = 0;   ///< at which the state was due, this one too
    long unfinished = 0;   ///< see TimePoint
};

/// What takes its time from a case.
enum class RunsOfCase
{
    one, ///< a run, which may continue an earlier one
    many ///< a study: its runs begin at startTime, where latestTime would be the end of an earlier run
};

/// The time of a run. Not to be copied: it counts what has been written.
class Time
{
public:
    /// Reads system/controlDict and finds where to start.
    /// \throws FatalIOError for what is wrong with controlDict, and when it is required and not there
    explicit Time(const std::filesystem::path& caseDirectory, ControlDict presence = ControlDict::optional,
                  RunsOfCase runs = RunsOfCase::one);
    /// The time of one run among many: it continues from `from`, reads no file again and reports nothing.
    Time(const TimeControls& controls, const TimeState& from);
    Time(const Time&) = delete;
    Time& operator=(const Time&) = delete;

    const TimeControls& controls() const { return settings; }
    /// The whole of controlDict, for its functions; empty when there is none.
    const Dictionary& controlDict() const { return dictionary; }

    double value() const { return now; }                             ///< at the end of the current step [s]
    double previousValue() const { return now - lastStep; }          ///< at its start [s]
    double deltaT() const { return lastStep > 0 ? lastStep : step; } ///< of the current step [s]
    long index() const { return count; }        ///< of the current step, from 1; 0 before the first
    double startValue() const { return begin; } ///< where this run has started [s]
    /// Name of the current time's directory. Its digits are increased where the precision requested would
    /// give two steps the same name.
    std::string name() const { return timeName(now, settings.timeFormat, namePrecision); }
    /// Name of the directory that the run starts from, which a run before may have given more digits.
    std::string startName() const { return startDirectory; }

    /// Continue as a run that was never interrupted. To be called before the first step with what `state`
    /// was when the state was written; a deltaT that controlDict has changed since is taken from there, with
    /// adjustTimeStep as the first that is wanted.
    void resume(const TimeState& saved);
    TimeState state() const
    {
        return {now,       step,   count,           origin,         originIndex, detourEnd,
                beginning, wanted, settings.deltaT, lengthToHere(), writeTimes,  unfinishedUpToHere()};
    }
    /// Name of the directory of the time at which the motion began.
    std::string beginningName() const { return nameOf(beginning); }
    /// The name of the directory of a time.
    std::string nameOf(double time) const { return timeName(time, settings.timeFormat, namePrecision); }

    /// Begin the next step, unless the run is to end: the end time is reached, stopAt or a signal says so.
    /// Reads controlDict again when it has changed; a fault in it is reported and the old settings stand.
    bool loop();

    /// Whether the state is to be written at the end of this step; the same answer all through a step. A
    /// signal that has come by the first call makes it true, and this step the last.
    bool isWriteTime();

    /// Whether this step has its lines in the log, as logFrequency of controlDict has it.
    bool isLogTime() const { return count % settings.logFrequency == 0; }

    /// For function objects.
    TimePoint point();

    /// Change the length of the steps to come, with adjustTimeStep; shortened so that steps end on the
    /// instants of adjustableRunTime, those of `stopAlsoAt`, the end time and the next change of what acts,
    /// or a thousandth of a step off that. \param changeAt when that is [s]
    void setDeltaT(double length, double changeAt = std::numeric_limits<double>::infinity());
    /// What that was called with last, not shortened: steps after an instant need not grow from a short one
    /// [s].
    double wantedDeltaT() const { return wanted > 0 ? wanted : step; }
    /// With adjustTimeStep steps end on these instants too: given a time and the length of a step, how long
    /// until the next one [s], infinite when there is none. To be called before the first step.
    void stopAlsoAt(std::function<double(double value, double deltaT)> timeToNext);

    /// Repeat the current step with a shorter one: the current time moves back to its start plus `shorter`.
    /// Unless setDeltaT says otherwise, the next step makes up for the rest, and times are then what they
    /// would have been.
    void shortenStep(double shorter);

    /// Take the current step back: all is as it was before it, to the last bit.
    void abandonStep();

    /// 0, or 128 + the signal that has ended the run (130 for Ctrl-C).
    int exitStatus() const;
    /// Part of the way to the end time that is done, 0 to 1.
    double progress() const;

private:
    void findStart(const std::vector<TimeDirectory>& times);
    bool reread();
    void use(Dictionary read, TimeControls controls);
    void startOutput();
    /// What changes from step to step becomes what it was at a moment.
    void goTo(const TimeState& moment);
    /// Lets the times of steps be counted from the present one. \param length of the steps to come [s]
    void countStepsFromHere(double length);
    /// Of the step that led to the present time, in this run or the one that it continues [s].
    double lengthToHere() const { return lastStep > 0 ? lastStep : stepToStart; }
    /// See TimePoint: with the current step, where it is such a one.
    long unfinishedUpToHere() const { return unfinished + (detourEnd > now ? 1 : 0); }
    /// The present time, to which a step of this length led [s].
    TimePoint pointAfter(double length) const;
    void sharpenName();
    /// The longest step up to `length` of which a whole number ends on the next instant to stop at.
    double fittingStep(double length) const;

    std::filesystem::path file;
    std::filesystem::file_time_type fileTime;
    ControlDict needed;
    Dictionary dictionary;
    TimeControls settings;
    OutputControl output;

    double begin = 0;
    std::string startDirectory;
    double beginning = 0; ///< see TimeState
    double now = 0;
    double step = 0;                                             ///< of the steps to come
    double wanted = 0;                                           ///< see TimeState
    double nextChange = std::numeric_limits<double>::infinity(); ///< see setDeltaT
    double lastStep = 0;                                         ///< of the current step
    double stepToStart = 0; ///< of the step that led to where a run continues; 0 where a motion begins [s]
    long writeTimes = 0;    ///< see TimeState
    long count = 0;
    long unfinished = 0; ///< before the current step, see TimePoint
    double origin = 0;
    long originIndex = 0;
    double detourEnd = 0; ///< see TimeState
    TimeState beforeStep; ///< what state() was
    double lastStepBefore = 0;
    double endOfStep = 0; ///< of the current step as it was meant, not shortened
    long stepsDone = 0;   ///< by this run
    std::function<double(double, double)> timeToOtherInstant;
    int namePrecision = 6;

    enum class Write
    {
        undecided,
        yes,
        no
    };
    Write write = Write::undecided;
    bool lastOne = false; ///< the current step is the last
    int signal = 0;
};

} // namespace drystone
