// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The clock of a run. The time is never summed up: it is origin + (number of steps since) deltaT, so that it
/// has drifted by no more than one rounding after a million steps.
#include "runControl/Time.h"

#include "core/Log.h"
#include "core/Signals.h"
#include "dictionary/Fingerprint.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace drystone
{

namespace fs = std::filesystem;

namespace
{

/// More digits than a double has.
constexpr int largestPrecision = 17;

fs::file_time_type modificationTime(const fs::path& file)
{
    std::error_code ignored;
    return fs::last_write_time(file, ignored);
}

TimeControls readControls(const Dictionary& dictionary, ControlDict needed)
{
    if (needed == ControlDict::optional)
    {
        return readOptions<TimeControls>(dictionary);
    }
    auto controls = readOptions<SteppedTimeControls>(dictionary);
    controls.endTime = controls.givenEndTime.value_or(controls.endTime);
    return controls;
}

/// Nearer to 0 than this [s] is the start: -0, and the rounding left of 0.3 - 0.1 - 0.2.
constexpr double sameTime = 1e-14;

/// What a case may be made for.
const std::vector<std::string>& applicationNames()
{
    static const std::vector<std::string> names{
        "accuracyCost",    "blockTexture",    "caseDictionary", "checkBlocks",
        "contactDynamics", "ensemble",        "exportBlocks",   "incrementalDynamics",
        "limitAnalysis",   "parameterSearch", "report",         "solveProgram"};
    return names;
}

/// Any application of this suite may be run in a case, and another's name says that the case is not one.
std::string doubtOfApplication(const std::string& application)
{
    const std::vector<std::string>& names = applicationNames();
    if (application.empty() || std::find(names.begin(), names.end(), application) != names.end())
    {
        return {};
    }
    const std::string nearest = nearestWord(application, names);
    return fmt::format("application {} is none of Drystone's: is this another program's case?{} Usual is one "
                       "of {}.",
                       application, nearest.empty() ? "" : fmt::format(" Did you mean {}?", nearest),
                       fmt::join(names, " "));
}

/// What of controlDict a run takes up when it is started, and is not as it was.
std::vector<std::string> changesForNextStart(const Dictionary& before, const Dictionary& now)
{
    std::vector<std::string> changed;
    for (const char* key : {"functions", "nThreads", "pictureFormats", "purgeWrite", "writeFormat"})
    {
        const auto contentOf = [key](const Dictionary& all)
        {
            std::vector<std::string> others;
            for (const Entry& entry : all.entries())
            {
                if (entry.keyword() != key)
                {
                    others.push_back(entry.keyword());
                }
            }
            return fingerprint(all, others);
        };
        if (contentOf(before) != contentOf(now))
        {
            changed.emplace_back(key);
        }
    }
    return changed;
}

constexpr const char* docOfStep = "length of a time step";
constexpr const char* docOfEnd = "for `stopAt endTime`";

void declareStartAndStop(Options& options, TimeControls& controls)
{
    options.optional("application", controls.application, "the application that this case is made for");
    options.question("application", [&controls] { return doubtOfApplication(controls.application); });
    options.optional("startFrom", controls.startFrom, "where a run starts or continues");
    options.optional("startTime", controls.startTime, "for `startFrom startTime`").unit("s");
    options.optional("stopAt", controls.stopAt, "when a run ends");
}

/// All but the times of its start, its end and its steps.
void declareOutput(Options& options, TimeControls& controls)
{
    declare(options, controls.output);
    options
        .optional("logFrequency", controls.logFrequency,
                  "one step in so many has its lines in the log; events are printed in any step")
        .atLeast(1);
    options
        .optional("purgeWrite", controls.purgeWrite,
                  "number of time directories to keep of those that a run writes, 0 for all")
        .atLeast(0);
    options.optional("writeFormat", controls.writeFormat, "of the restart state");
    options.optional("writePrecision", controls.writePrecision, "significant digits of tables")
        .atLeast(1)
        .atMost(largestPrecision);
    options.optional("timeFormat", controls.timeFormat, "of the names of time directories");
    options.optional("timePrecision", controls.timePrecision, "digits of the names of time directories")
        .atLeast(1)
        .atMost(largestPrecision);
    declarePictureFormats(options, controls.pictureFormats);
    options.optional("runTimeModifiable", controls.runTimeModifiable,
                     "read this file again when it has changed");
    options.optional(
        "adjustTimeStep", controls.adjustTimeStep,
        "let the run choose the length of its steps, so that some end where it writes, and at endTime");
    options.readElsewhere({"nThreads"}); // ThreadControls.h
    options.readElsewhere({"functions"}, "function objects, each a dictionary with a name of the user's");
    options.check("writeControl",
                  [&controls]() -> std::string
                  {
                      if (controls.output.writeControl != WriteControl::writeTime)
                      {
                          return {};
                      }
                      return "writeControl writeTime is for function objects.\n\nChoose timeStep or runTime.";
                  });
}

/// Times of steps are numbers and names of directories: nearer to each other than this they are the same.
std::string faultOfStep(const SteppedTimeControls& controls)
{
    const double latest =
        std::max(std::abs(controls.startTime),
                 controls.stopAt == StopAt::endTime ? std::abs(controls.givenEndTime.value_or(0)) : 0);
    const double shortest = std::max(10 * sameTime, 4 * std::numeric_limits<double>::epsilon() * latest);
    return controls.deltaT < shortest
               ? fmt::format("deltaT {:g} s is too short: the times of two steps could not be told apart.\n\n"
                             "Give at least {:.2g} s; usual are 1e-4 to 0.01 s.",
                             controls.deltaT, shortest)
               : "";
}

constexpr const char* endsBefore =
    "endTime lies before startTime.\n\nA run goes forward in time: give a later endTime.";

/// Where the run is to start from another time, startTime may be any.
std::string faultOfEnd(const TimeControls& controls, double endTime)
{
    return controls.startFrom == StartFrom::startTime && controls.stopAt == StopAt::endTime
                   && endTime < controls.startTime
               ? endsBefore
               : "";
}

} // namespace

void declare(Options& options, TimeControls& controls)
{
    declareStartAndStop(options, controls);
    options.optional("endTime", controls.endTime, docOfEnd).unit("s");
    options.optional("deltaT", controls.deltaT, docOfStep).unit("s").above(0);
    declareOutput(options, controls);
    options.check("endTime", [&controls] { return faultOfEnd(controls, controls.endTime); });
}

void declare(Options& options, SteppedTimeControls& controls)
{
    declareStartAndStop(options, controls);
    options
        .optional("endTime", controls.givenEndTime,
                  std::string(docOfEnd) + ", which is the default, and then required")
        .unit("s")
        .example("1");
    options.required("deltaT", controls.deltaT, docOfStep).unit("s").above(0).example("0.01");
    declareOutput(options, controls);
    options.check("deltaT", [&controls] { return faultOfStep(controls); });
    options.check("endTime",
                  [&controls]() -> std::string
                  {
                      if (controls.givenEndTime)
                      {
                          return faultOfEnd(controls, *controls.givenEndTime);
                      }
                      return controls.stopAt == StopAt::endTime
                                 ? "The entry endTime is missing: when the run ends [s]. Write for example "
                                   "`endTime 1;`."
                                 : "";
                  });
}

std::string timeName(double value, TimeFormat format, int precision)
{
    if (std::abs(value) < sameTime)
    {
        value = 0;
    }
    switch (format)
    {
    case TimeFormat::fixed:
        return fmt::format("{:.{}f}", value, precision);
    case TimeFormat::scientific:
        return fmt::format("{:.{}e}", value, precision);
    case TimeFormat::general:
        break;
    }
    return fmt::format("{:.{}g}", value, precision);
}

Time::Time(const fs::path& caseDirectory, ControlDict presence)
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
    settings = readControls(dictionary, presence);

    const std::vector<TimeDirectory> times = timeDirectories(caseDirectory);
    findStart(times);
    if (times.empty() && settings.stopAt == StopAt::endTime && settings.endTime < settings.startTime)
    {
        throw FatalIOError(endsBefore, dictionary.locationOf("endTime"));
    }
    now = origin = beginning = begin;
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
    namePrecision = largestPrecision; // no name is too short, so that there is nothing to tell
    resume(from);
    startDirectory = timeName(begin, settings.timeFormat, namePrecision);
}

void Time::startOutput()
{
    output = OutputControl(settings.output, {now, lengthToHere(), count, cpuTime(), clockTime(), writeTimes},
                           settings.startTime);
}

void Time::resume(const TimeState& saved)
{
    begin = now = saved.value;
    beginning = saved.beginning;
    count = saved.index;
    step = saved.deltaT;
    wanted = saved.wanted;
    origin = saved.origin;
    originIndex = saved.originIndex;
    detourEnd = saved.detourEnd;
    stepToStart = saved.stepLength;
    writeTimes = saved.writeTimes;
    const bool isGivenAnew =
        settings.adjustTimeStep ? saved.given > 0 && saved.given != settings.deltaT : step != settings.deltaT;
    if (isGivenAnew)
    {
        origin = now;
        originIndex = count;
        step = settings.deltaT;
        wanted = 0;
        detourEnd = now;
    }
    lastStep = 0;
    startOutput();
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
        TimeControls controls = readControls(read, needed);
        info("Reading system/controlDict again: it has changed.");
        if (const std::vector<std::string> later = changesForNextStart(dictionary, read); !later.empty())
        {
            printWarning(
                fmt::format("{} of system/controlDict {} as when this run was started; the change takes "
                            "effect when a run is started next.",
                            fmt::join(later, ", "), later.size() == 1 ? "stays" : "stay"),
                read.locationOf(later.front()));
        }
        const bool otherStep = controls.deltaT != settings.deltaT;
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
            origin = now;
            originIndex = count;
            step = settings.deltaT;
            wanted = 0;
            detourEnd = now;
        }
        if (otherOutput)
        {
            startOutput();
        }
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
    while (namePrecision < largestPrecision && distance() > tolerance)
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
        bool isDue = stepsDone > 0 && output.due({now, lastStep, count, cpuTime(), clockTime(), writeTimes});
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
    return {now, lengthToHere(), count, cpuTime(), clockTime(), writeTimes};
}

double Time::fittingStep(double length) const
{
    double remaining = output.timeToNextWrite(now, length);
    if (timeToOtherInstant)
    {
        remaining = std::min(remaining, timeToOtherInstant(now, length));
    }
    if (settings.stopAt == StopAt::endTime && settings.endTime > now)
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
    origin = now;
    originIndex = count;
    step = fitting;
    detourEnd = now;
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
    now = beforeStep.value;
    step = beforeStep.deltaT;
    wanted = beforeStep.wanted;
    count = beforeStep.index;
    origin = beforeStep.origin;
    originIndex = beforeStep.originIndex;
    detourEnd = beforeStep.detourEnd;
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
