// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Runs the function objects of a case at their own intervals.
#include "functionObjects/FunctionList.h"

#include "core/Error.h"
#include "core/Log.h"
#include "functionObjects/Histories.h"
#include "runControl/CaseFiles.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

namespace drystone
{

namespace
{

/// Whether one of the times was reached by this step. \param written up to where they were reached before
bool isTimeReached(const std::vector<double>& times, double written, const TimePoint& now)
{
    const auto next = std::upper_bound(times.begin(), times.end(), written);
    return next != times.end() && *next <= now.value + reachOf(now);
}

/// Whether a function may write then. \param plan with its timeStart and timeEnd
template<int Dim>
bool isWithin(const FunctionPlan<Dim>& plan, const TimePoint& now)
{
    const double small =
        sameInstant(now.value, now.deltaT); // the end of a step may miss the limit by rounding
    return !(plan.timeStart && now.value < *plan.timeStart - small)
           && !(plan.timeEnd && now.value > *plan.timeEnd + small);
}

/// An interval with what it counts.
std::string inWords(const OutputSettings& settings)
{
    const auto unit = [&settings]() -> std::string_view
    {
        switch (settings.writeControl)
        {
        case WriteControl::timeStep:
            return "steps";
        case WriteControl::writeTime:
            return "writes of the state";
        case WriteControl::cpuTime:
            return "s of the processor's time";
        case WriteControl::clockTime:
            return "s of real time";
        default:
            return "s";
        }
    };
    return fmt::format("{:g} (in {})", settings.writeInterval, unit());
}

/// Of a function without type: its name is one. \throws FatalIOError where it is not
template<int Dim>
void requireType(const std::string& name, const SourceLocation& place)
{
    std::vector<std::string> types;
    for (const Model<FunctionPlan<Dim>>& model : functionTypes<Dim>().models)
    {
        types.push_back(model.name);
    }
    if (std::find(types.begin(), types.end(), name) == types.end())
    {
        throw FatalIOError(unknownWordMessage("function type", name, types)
                               + "\n\nThis function has no entry type, and so its name is taken for one.",
                           place);
    }
}

} // namespace

void declare(Options& options, ControlDictSettings& settings)
{
    declare(options, settings.controls);
    declare(options, settings.threads);
    options.optional("functions", settings.functions, functionTypes<2>(),
                     "what is written besides the animation; each has a name of yours");
}

template<int Dim>
FunctionList<Dim>::FunctionList(const Dictionary& dictionary, const std::filesystem::path& caseDirectory,
                                const std::string& startName, const TimePoint& begin, double startTime,
                                const Assembly<Dim>& assembly)
    : title(caseName(caseDirectory)),
      pictureFormats(readPictureFormats(caseDirectory)),
      written(begin.value + reachOf(begin))
{
    for (const Entry& entry : dictionary.entries())
    {
        if (!entry.isDictionary() && entry.isUsed()) // a value that others refer to as a macro
        {
            continue;
        }
        const std::string& name = entry.keyword();
        if (entry.isPattern() || name.find('/') != std::string::npos || name == "." || name == "..")
        {
            throw FatalIOError("The name of a function is that of its folder: a word, not \"" + name + "\".",
                               entry.location());
        }
        Dictionary own = entry.dictionary();
        if (!own.found("type"))
        {
            requireType<Dim>(name, entry.location());
            own.set("type", name);
        }
        Function function;
        function.name = name;
        function.place = entry.location();
        function.plan = functionTypes<Dim>().select(own);
        if (!function.plan.enabled)
        {
            continue;
        }
        function.control = OutputControl(function.plan.control, begin, startTime);
        function.folder = postProcessingFolder(caseDirectory, name, startName);
        function.object = function.plan.make(
            {function.folder, function.plan.writePrecision, caseDirectory, pictureFormats}, assembly);
        functions.push_back(std::move(function));
    }
}

template<int Dim>
void FunctionList<Dim>::write(const StepObservation<Dim>& step, const TimePoint& now)
{
    for (Function& function : functions)
    {
        const bool isInterval = function.control.due(now); // counts steps, and so is called at every step
        const bool due =
            function.plan.times.empty() ? isInterval : isTimeReached(function.plan.times, written, now);
        if (due && isWithin(function.plan, now))
        {
            function.object->write(step);
            function.hasWritten = true;
        }
    }
    written = std::max(written, now.value + reachOf(now));
}

template<int Dim>
void FunctionList<Dim>::writeStored(const StepObservation<Dim>& step, const TimePoint& now)
{
    for (Function& function : functions)
    {
        const std::vector<double>& times = function.plan.times;
        if (isWithin(function.plan, now) && (times.empty() || isTimeReached(times, written, now)))
        {
            function.object->write(step);
        }
    }
    written = std::max(written, now.value + reachOf(now));
}

template<int Dim>
double FunctionList<Dim>::timeToNextWrite(double time, double deltaT) const
{
    double next = std::numeric_limits<double>::infinity();
    for (const Function& function : functions)
    {
        const std::vector<double>& times = function.plan.times;
        if (times.empty())
        {
            next = std::min(next, function.control.timeToNextWrite(time, deltaT));
            continue;
        }
        const auto coming = std::upper_bound(times.begin(), times.end(), time + sameInstant(time, deltaT));
        next = coming == times.end() ? next : std::min(next, *coming - time);
    }
    return next;
}

template<int Dim>
void FunctionList<Dim>::questionTimes(double endTime, double deltaT) const
{
    for (const Function& function : functions)
    {
        const FunctionPlan<Dim>& plan = function.plan;
        const std::optional<double> first =
            plan.timeStart ? plan.timeStart
                           : (plan.times.empty() ? std::nullopt : std::optional(plan.times.front()));
        const double last = endTime + reachOf({endTime, deltaT});
        if (first && *first > last)
        {
            printWarning(fmt::format("Function {} writes nothing: it begins at {:g} s, and the run ends at "
                                     "endTime {:g} s. Give an earlier time, or a later endTime.",
                                     function.name, *first, endTime),
                         function.place);
        }
        else if (!plan.times.empty() && plan.times.back() > last)
        {
            printWarning(fmt::format("Function {} does not write at {:g} s: the run ends at endTime {:g} s. "
                                     "Give earlier `times`, or a later endTime.",
                                     function.name, plan.times.back(), endTime),
                         function.place);
        }
    }
}

template<int Dim>
void FunctionList<Dim>::questionUnwritten(double end) const
{
    for (const Function& function : functions)
    {
        const FunctionPlan<Dim>& plan = function.plan;
        const bool isLater = plan.timeStart && *plan.timeStart > end; // see questionTimes
        if (function.hasWritten || !plan.times.empty() || isLater
            || plan.control.writeControl == WriteControl::none)
        {
            continue;
        }
        const std::string interval = inWords(plan.control);
        printWarning(
            plan.timeEnd && *plan.timeEnd < end
                ? fmt::format("Function {} has written nothing: its writeInterval {} came due at no step up "
                              "to its timeEnd {:g} s. Give a later timeEnd, or a shorter writeInterval.",
                              function.name, interval, *plan.timeEnd)
                : fmt::format("Function {} has written nothing: its writeInterval {} came due at no step of "
                              "the run, which has ended at {:g} s. Give a shorter writeInterval.",
                              function.name, interval, end),
            function.place);
    }
}

template<int Dim>
void FunctionList<Dim>::questionTimesBeforeMotion() const
{
    for (const Function& function : functions)
    {
        const std::vector<double>& times = function.plan.times;
        if (!times.empty() && times.front() <= written)
        {
            printWarning(
                fmt::format("Function {} does not write at {:g} s: the motion begins then or later, and "
                            "the first that is written is the end of its first step. Remove what is "
                            "earlier from `times`.",
                            function.name, times.front()),
                function.place);
        }
    }
}

template<int Dim>
void FunctionList<Dim>::writePictures() const
{
    for (const Function& function : functions)
    {
        if (!function.plan.pictures)
        {
            continue;
        }
        const std::size_t count = writeHistoryPictures(
            function.folder, fmt::format("{}, {}", title, function.name), pictureFormats);
        if (count > 0)
        {
            info("Wrote {}: its tables over time, {} picture{}", function.folder.lexically_normal().string(),
                 count, count == 1 ? "" : "s");
        }
        else
        {
            info("Function {}: there are no two rows of a table to draw", function.name);
        }
    }
}

template<int Dim>
std::vector<std::string> FunctionList<Dim>::names() const
{
    std::vector<std::string> result;
    for (const Function& function : functions)
    {
        result.push_back(function.name);
    }
    return result;
}

template<int Dim>
std::vector<std::string> FunctionList<Dim>::writtenNames() const
{
    std::vector<std::string> result;
    for (const Function& function : functions)
    {
        std::error_code none;
        if (std::filesystem::exists(function.folder, none)
            && !std::filesystem::is_empty(function.folder, none))
        {
            result.push_back(function.name);
        }
    }
    return result;
}

template class FunctionList<2>;
template class FunctionList<3>;

} // namespace drystone
