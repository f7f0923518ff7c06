// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The clock of a run. The time is never summed up: it is origin + (number of steps since) deltaT, so that it
/// has drifted by no more than one rounding after a million steps.
#include "runControl/Time.h"

#include "core/Log.h"
#include "core/Signals.h"

#include <algorithm>
#include <cmath>

namespace drystone
{

namespace fs = std::filesystem;

namespace
{

fs::file_time_type modificationTime(const fs::path& file)
{
    std::error_code ignored;
    return fs::last_write_time(file, ignored);
}

} // namespace

Time::Time(const fs::path& caseDirectory, ControlDict presence, RunsOfCase runs)
    : file((caseDirectory / "system/controlDict").lexically_normal()), needed(presence)
{
    requireCase(caseDirectory);
    if (presence == ControlDict::required)
    {
        requireCaseFile(
            caseDirectory, "system/controlDict",
            "It says how long to run and when to write; etc/annotated/system/controlDict is one to copy. "
            "Is this the case directory? Another is named with -case DIR.");
    }
    fileTime = modificationTime(file);
    dictionary = Dictionary::readFileIfPresent(file);
    settings = readTimeControls(dictionary, presence);

    const std::vector<TimeDirectory> times = timeDirectories(caseDirectory);
    const bool beginsAnew = runs == RunsOfCase::many && settings.startFrom == StartFrom::latestTime;
    settings.startFrom = beginsAnew ? StartFrom::startTime : settings.startFrom;
    findStart(times);
    if (beginsAnew && !times.empty() && times.back().time > begin)
    {
        printWarningOnce(
            fmt::format("The runs of this study begin at startTime, {}: time directories up to {} "
                        "are results of another run. To begin with what is there, set `startFrom "
                        "startTime;` and startTime in system/controlDict.",
                        startDirectory, times.back().name),
            dictionary.locationOf("startTime"));
    }
    if (times.empty() && settings.stopAt == StopAt::endTime && settings.endTime < settings.startTime)
    {
        throw FatalIOError(endsBeforeStart, dictionary.locationOf("endTime"));
    }
    now = origin = beginning = detourEnd = begin;
    step = settings.deltaT;
    namePrecision = settings.timePrecision;
    startOutput();
}

void Time::findStart(const std::vector<TimeDirectory>& times)
{
    begin = settings.startTime;
    startDirectory = timeName(begin, settings.timeFormat, settings.timePrecision);
    if (times.empty())
    {
        return;
    }
    // A time is given with as many digits as one likes; more than one directory may have a name that begins
    // so.
    const auto named = [this](const TimeDirectory& one)
    { return timeName(one.time, settings.timeFormat, settings.timePrecision) == startDirectory; };
    const auto nearest =
        std::min_element(times.begin(), times.end(),
                         [this](const TimeDirectory& one, const TimeDirectory& other)
                         { return std::abs(one.time - begin) < std::abs(other.time - begin); });
    const TimeDirectory* const start = settings.startFrom == StartFrom::firstTime    ? &times.front()
                                       : settings.startFrom == StartFrom::latestTime ? &times.back()
                                       : named(*nearest)                             ? &*nearest
                                                                                     : nullptr;
    if (start)
    {
        begin = start->time;
        startDirectory = start->name;
    }
}

Time::Time(const TimeControls& controls, const TimeState& from)
    : needed(ControlDict::required), settings(controls)
{
    settings.runTimeModifiable = false;
    namePrecision = largestTimePrecision; // no name is too short, so that there is nothing to report
    resume(from);
    startDirectory = timeName(begin, settings.timeFormat, namePrecision);
}

void Time::startOutput()
{
    output = OutputControl(settings.output, pointAfter(lengthToHere()), settings.startTime);
}

void Time::goTo(const TimeState& moment)
{
    now = moment.value;
    count = moment.index;
    step = moment.deltaT;
    wanted = moment.wanted;
    origin = moment.origin;
    originIndex = moment.originIndex;
    detourEnd = moment.detourEnd;
    unfinished = moment.unfinished - (detourEnd > now ? 1 : 0);
}

void Time::resume(const TimeState& saved)
{
    goTo(saved);
    begin = now;
    beginning = saved.beginning;
    stepToStart = saved.stepLength;
    writeTimes = saved.writeTimes;
    const bool isGivenAnew =
        settings.adjustTimeStep ? saved.given > 0 && saved.given != settings.deltaT : step != settings.deltaT;
    if (isGivenAnew)
    {
        countStepsFromHere(settings.deltaT);
        wanted = 0;
    }
    lastStep = 0;
    startOutput();
}

void Time::countStepsFromHere(double length)
{
    origin = now;
    originIndex = count;
    step = length;
    detourEnd = now;
}

bool Time::reread()
{
    const fs::file_time_type changed = modificationTime(file);
    if (changed == fileTime)
    {
        return false;
    }
    fileTime = changed;
    std::error_code ignored;
    if (!fs::exists(file, ignored))
    {
        return false;
    }
    try
    {
        Dictionary read = Dictionary::readFile(file);
        TimeControls controls = readTimeControls(read, needed);
        info("Reading system/controlDict again: it has changed.");
        if (const std::vector<std::string> later = changesForNextStart(dictionary, read); !later.empty())
        {
            printWarning(
                fmt::format("{} of system/controlDict {} as when this run was started; the change takes "
                            "effect when a run is started next.",
                            fmt::join(later, ", "), later.size() == 1 ? "stays" : "stay"),
                read.locationOf(later.front()));
        }
        use(std::move(read), std::move(controls));
        return true;
    }
    catch (const FatalIOError& error)
    {
        printWarning(
            std::string("system/controlDict has changed and cannot be used. The run goes on with what "
                        "was read before.\n")
                + error.what(),
            error.location());
    }
    return false;
}

/// What controlDict says now, which may have changed the steps to come, the output and the names of times.
void Time::use(Dictionary read, TimeControls controls)
{
    const bool isAdjustedNoMore = settings.adjustTimeStep && !controls.adjustTimeStep;
    const bool otherStep = controls.deltaT != settings.deltaT || isAdjustedNoMore;
    const bool otherOutput = controls.output.writeControl != settings.output.writeControl
                             || controls.output.writeInterval != settings.output.writeInterval;
    const bool otherPrecision = controls.timePrecision != settings.timePrecision;
    dictionary = std::move(read);
    settings = std::move(controls);
    if (otherPrecision)
    {
        namePrecision = settings.timePrecision;
    }
    if (otherStep)
    {
        countStepsFromHere(settings.deltaT);
        wanted = 0;
    }
    if (otherOutput)
    {
        startOutput();
    }
}

bool Time::loop()
{
    if (lastOne)
    {
        return false;
    }
    const bool hasChanged = settings.runTimeModifiable && reread();
    if (settings.stopAt == StopAt::endTime && now >= settings.endTime - 0.5 * step && detourEnd <= now)
    {
        return false;
    }
    // The first step is the user's, and any may have been chosen before controlDict was edited.
    if (settings.adjustTimeStep && (hasChanged || stepsDone == 0))
    {
        setDeltaT(wantedDeltaT(), nextChange);
    }

    beforeStep = state();
    lastStepBefore = lastStep;
    unfinished = unfinishedUpToHere();
    ++count;
    ++stepsDone;
    if (detourEnd > now)
    {
        lastStep = detourEnd - now;
        now = detourEnd;
    }
    else
    {
        now = origin + static_cast<double>(count - originIndex) * step;
        lastStep = step;
    }
    endOfStep = now;
    write = Write::undecided;
    lastOne = settings.stopAt == StopAt::writeNow || settings.stopAt == StopAt::noWriteNow;
    sharpenName();
    return true;
}

void Time::sharpenName()
{
    // A name must lie nearer to its time than to that of the next step.
    const auto distance = [&] { return std::abs(std::strtod(name().c_str(), nullptr) - now); };
    const double tolerance = std::max(
        {std::min(std::pow(10.0, -settings.timePrecision), 0.1 * step), 1e-15, 1e-15 * std::abs(now)});
    const int before = namePrecision;
    while (namePrecision < largestTimePrecision && distance() > tolerance)
    {
        ++namePrecision;
    }
    if (namePrecision != before)
    {
        info("Increased timePrecision from {} to {} to tell the times of steps apart at time {}", before,
             namePrecision, name());
    }
}

bool Time::isWriteTime()
{
    if (write == Write::undecided)
    {
        bool isDue = stepsDone > 0 && output.due(pointAfter(lastStep));
        writeTimes += isDue ? 1 : 0;
        if (isDue && settings.stopAt == StopAt::nextWrite)
        {
            lastOne = true;
        }
        if (settings.stopAt == StopAt::writeNow && lastOne)
        {
            isDue = true;
        }
        if (stopSignal() != 0)
        {
            signal = stopSignal();
            lastOne = true;
            isDue = true;
        }
        write = isDue ? Write::yes : Write::no;
    }
    return write == Write::yes;
}

TimePoint Time::point()
{
    isWriteTime(); // which counts them
    return pointAfter(lengthToHere());
}

TimePoint Time::pointAfter(double length) const
{
    TimePoint point{now, length, count, writeTimes};
    point.unfinished = unfinishedUpToHere();
    point.endsOnInstants = settings.adjustTimeStep;
    return point;
}

double Time::fittingStep(double length) const
{
    double remaining = output.timeToNextWrite(now, length);
    if (timeToOtherInstant)
    {
        remaining = std::min(remaining, timeToOtherInstant(now, length));
    }
    if (settings.stopAt == StopAt::endTime && settings.endTime > now + sameInstant(now, length))
    {
        remaining = std::min(remaining, settings.endTime - now);
    }
    // No step is made between a change and an instant that is nearly the same: in the shortest steps the last
    // digits of the places of blocks would be velocities.
    constexpr double nearly = 1e-3;
    const double toChange = nextChange - now;
    if (toChange > nearly * length && toChange < remaining - nearly * length)
    {
        remaining = toChange;
    }
    if (!std::isfinite(remaining) || remaining <= 0)
    {
        return length;
    }
    return remaining / std::max(1.0, std::ceil(remaining / length - 1e-9));
}

void Time::setDeltaT(double length, double changeAt)
{
    wanted = length;
    nextChange = changeAt;
    const double fitting = fittingStep(length);
    if (fitting == step && detourEnd <= now)
    {
        return;
    }
    countStepsFromHere(fitting);
}

void Time::stopAlsoAt(std::function<double(double, double)> timeToNext)
{
    timeToOtherInstant = std::move(timeToNext);
}

void Time::shortenStep(double shorter)
{
    now = beforeStep.value + shorter;
    lastStep = shorter;
    detourEnd = endOfStep;
    originIndex = beforeStep.originIndex + 1; // one step more than there would have been up to the end
    write = Write::undecided;
    sharpenName();
}

void Time::abandonStep()
{
    goTo(beforeStep);
    lastStep = lastStepBefore;
    write = Write::undecided;
}

int Time::exitStatus() const
{
    return signal == 0 ? 0 : exitStatusOfSignal(signal);
}

double Time::progress() const
{
    const double length = settings.endTime - begin;
    return length > 0 ? std::clamp((now - begin) / length, 0.0, 1.0) : 1.0;
}

} // namespace drystone
