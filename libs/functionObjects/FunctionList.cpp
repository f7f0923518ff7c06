// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Runs the function objects of a case at their own intervals.
#include "functionObjects/FunctionList.h"

#include <algorithm>
#include <limits>

namespace drystone
{

void declare(Options& options, ControlDictSettings& settings)
{
    declare(options, settings.controls);
    options.optional("functions", settings.functions, functionTypes<2>(),
                     "what is written beside the animation; each has a name of yours");
}

template<int Dim>
FunctionList<Dim>::FunctionList(const Dictionary& dictionary, const std::filesystem::path& caseDirectory,
                                const std::string& startName, const TimePoint& begin, double startTime,
                                const Assembly<Dim>& assembly)
{
    for (const Entry& entry : dictionary.entries())
    {
        if (!entry.isDictionary() && entry.isUsed()) // a value that others refer to as a macro
        {
            continue;
        }
        const std::string& name = entry.keyword();
        if (entry.isPattern() || name.find('/') != std::string::npos)
        {
            throw FatalIOError("The name of a function is that of its folder: a word, not \"" + name + "\".",
                               entry.location());
        }
        Dictionary own = entry.dictionary();
        if (!own.found("type"))
        {
            own.set("type", name);
        }
        Function function;
        function.name = name;
        function.plan = functionTypes<Dim>().select(own);
        if (!function.plan.enabled)
        {
            continue;
        }
        function.control = OutputControl(function.plan.control, begin, startTime);
        function.object = function.plan.make(
            {postProcessingFolder(caseDirectory, name, startName), function.plan.writePrecision}, assembly);
        functions.push_back(std::move(function));
    }
}

template<int Dim>
void FunctionList<Dim>::write(const StepObservation<Dim>& step, const TimePoint& now)
{
    for (Function& function : functions)
    {
        const bool due = function.control.due(now); // counts steps, and so is called at every step
        // the end of a step may miss the limit by rounding
        const double small = 1e-9 * now.deltaT;
        const bool early = function.plan.timeStart && now.value < *function.plan.timeStart - small;
        const bool late = function.plan.timeEnd && now.value > *function.plan.timeEnd + small;
        if (due && !early && !late)
        {
            function.object->write(step);
        }
    }
}

template<int Dim>
void FunctionList<Dim>::writeAlways(const StepObservation<Dim>& step)
{
    for (Function& function : functions)
    {
        function.object->write(step);
    }
}

template<int Dim>
double FunctionList<Dim>::timeToNextWrite(double time, double deltaT) const
{
    double next = std::numeric_limits<double>::infinity();
    for (const Function& function : functions)
    {
        next = std::min(next, function.control.timeToNextWrite(time, deltaT));
    }
    return next;
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

template class FunctionList<2>;
template class FunctionList<3>;

} // namespace drystone
