// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The keys of system/controlDict, and what is wrong with their values.
#include "runControl/TimeControls.h"

#include "dictionary/Fingerprint.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace drystone
{
namespace
{

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

constexpr const char* docOfStep = "length of a time step";
constexpr const char* docOfEnd = "for `stopAt endTime`";

void declareStartAndStop(Options& options, TimeControls& controls)
{
    options.optional("application", controls.application, "the application that this case is made for");
    options.question("application", [&controls] { return doubtOfApplication(controls.application); });
    options.optional(
        "startFrom", controls.startFrom,
        "where a run starts or continues; the runs of a study begin at startTime instead of latestTime");
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
    options
        .optional(
            "writePrecision", controls.writePrecision,
            "accepted as OpenFOAM has it, without effect: tables have the writePrecision of their function")
        .atLeast(1)
        .atMost(largestTimePrecision);
    options.optional("timeFormat", controls.timeFormat, "of the names of time directories");
    options.optional("timePrecision", controls.timePrecision, "digits of the names of time directories")
        .atLeast(1)
        .atMost(largestTimePrecision);
    declarePictureFormats(options, controls.pictureFormats);
    options.optional("runTimeModifiable", controls.runTimeModifiable,
                     "read this file again when it has changed");
    options.optional(
        "adjustTimeStep", controls.adjustTimeStep,
        "let the run choose the length of its steps, so that some end where it writes, and at endTime");
    options.readElsewhere({"nThreads"}); // ThreadControls.h
    options.readElsewhere({"functions"}, "function objects, each a dictionary with a name of the user's");
    options.check("stopAt",
                  [&controls]
                  {
                      return controls.stopAt == StopAt::nextWrite
                                     && controls.output.writeControl == WriteControl::none
                                 ? "With `writeControl none;` nothing is written, and `stopAt nextWrite;` "
                                   "would never end the run.\n\nGive another writeControl, or `stopAt "
                                   "endTime;` and endTime."
                                 : "";
                  });
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

/// Where the run is to start from another time, startTime may be any.
std::string faultOfEnd(const TimeControls& controls, double endTime)
{
    return controls.startFrom == StartFrom::startTime && controls.stopAt == StopAt::endTime
                   && endTime < controls.startTime
               ? endsBeforeStart
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

TimeControls readTimeControls(const Dictionary& dictionary, ControlDict needed)
{
    if (needed == ControlDict::optional)
    {
        return readOptions<TimeControls>(dictionary);
    }
    auto controls = readOptions<SteppedTimeControls>(dictionary);
    controls.endTime = controls.givenEndTime.value_or(controls.endTime);
    return controls;
}

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

} // namespace drystone
