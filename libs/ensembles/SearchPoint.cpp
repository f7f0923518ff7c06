// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Sets the entries in a copy of the case; takes the CPU time of child processes and figures from tables.
#include "ensembles/SearchPoint.h"

#include "ensembles/CaseRuns.h"
#include "ensembles/CopyMessages.h"
#include "functionObjects/LimitAnalysisResults.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include <sys/resource.h>

namespace drystone
{
namespace
{

namespace fs = std::filesystem;

/// Reports why there is no number, and how to continue.
[[noreturn]] void failResult(const ParameterSearch& search, std::size_t index,
                             const std::vector<double>& variables, const std::string& reason)
{
    const std::string& name = search.settings.results[index].first;
    throw FatalIOError(
        fmt::format(
            "There is no finite number for the result {} at {}.\n{}\n\nThe files of this point are in "
            "{}. A search that may reach such points needs a value to continue with: `otherwise` in "
            "this result.",
            name, pointText(search.settings, variables), reason,
            (search.caseDirectory / "parameterSearch/evaluation").string()),
        search.dictionary.subDict("results").locationOf(name));
}

/// CPU time of the applications that have ended [s].
double childrenCpuTime()
{
    rusage usage{};
    getrusage(RUSAGE_CHILDREN, &usage);
    const auto seconds = [](const timeval& time)
    { return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec); };
    return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

} // namespace

StudyRuns runsOf(const ParameterSearch& search)
{
    return {"system/parameterSearchDict", search.settings.applications, search.settings.cases};
}

std::string pointText(const ParameterSearchSettings& settings, const std::vector<double>& variables)
{
    std::string text;
    for (std::size_t i = 0; i < variables.size(); ++i)
    {
        text += fmt::format("{}{} = {:.9g}", i > 0 ? "  " : "", settings.variables[i].first, variables[i]);
    }
    return text;
}

std::vector<double> completed(const ParameterSearch& search, const std::vector<double>& variables,
                              std::vector<double> results, const std::string& reason)
{
    for (std::size_t i = 0; i < results.size(); ++i)
    {
        if (!std::isfinite(results[i]))
        {
            const std::optional<double>& otherwise = search.settings.results[i].second.otherwise;
            if (!otherwise)
            {
                failResult(search, i, variables, reason);
            }
            results[i] = *otherwise;
        }
    }
    return results;
}

namespace
{

std::vector<OtherEntry> entriesOf(const ParameterSearch& search, const std::vector<double>& variables)
{
    std::vector<OtherEntry> entries;
    for (std::size_t i = 0; i < variables.size(); ++i)
    {
        entries.emplace_back(search.settings.variables[i].second.place, fmt::format("{}", variables[i]));
    }
    return entries;
}

} // namespace

void requireReadableCase(const ParameterSearch& search)
{
    std::vector<double> middle;
    for (const auto& [name, variable] : search.settings.variables)
    {
        middle.push_back((variable.bounds[0] + variable.bounds[1]) / 2);
    }
    WarningsOfCopies().print(
        requireReadableCase(search.caseDirectory, search.caseDirectory / parameterSearchName / "dryRun",
                            {entriesOf(search, search.start), entriesOf(search, middle)},
                            {search.settings.applications, search.settings.cases, search.options}));
}

PointRun runPoint(const ParameterSearch& search, const std::vector<double>& variables)
{
    const ParameterSearchSettings& settings = search.settings;
    const fs::path folder = search.caseDirectory / "parameterSearch/evaluation";
    const double before = childrenCpuTime();
    const CaseRun done = runCopy(search.caseDirectory, folder, entriesOf(search, variables),
                                 {settings.applications, settings.cases, search.options});
    PointRun run;
    run.cpuTime = childrenCpuTime() - before;
    run.isInterrupted = done.isInterrupted;
    if (run.isInterrupted)
    {
        return run;
    }
    run.warnings = done.warnings;
    if (done.status != 0) // a table of an earlier application may be from before the failure
    {
        run.failure = fmt::format("{} ended with exit status {} (parameterSearch/evaluation/{}log.{})",
                                  done.application, done.status,
                                  done.directory == "." ? "" : done.directory + "/", done.application);
        run.failureStatus = done.status;
        run.errorOutput = faultOfCopy(done.errorOutput, folder);
    }
    const auto cutShort = std::find_if(settings.cases.begin(), settings.cases.end(),
                                       [&folder](const std::string& directory)
                                       { return isSearchCutShort(folder / directory); });
    run.cutShortIn = cutShort == settings.cases.end() ? "" : *cutShort;
    for (std::size_t i = 0; i < settings.results.size(); ++i)
    {
        const auto& [name, result] = settings.results[i];
        std::optional<std::vector<double>> column;
        try
        {
            column = readColumn(folder / result.figure.table, result.figure.column);
        }
        catch (const FatalError& error)
        {
            throw FatalIOError(error.what(),
                               search.dictionary.subDict("results").subDict(name).locationOf("column"));
        }
        if (!column && run.failure.empty())
        {
            throw FatalIOError(fmt::format("The applications have not written the table {}.\n\nDo they write "
                                           "it, and does a function "
                                           "of controlDict? Their files are in {}.",
                                           result.figure.table, folder.string()),
                               search.dictionary.subDict("results").subDict(name).locationOf("table"));
        }
        run.results.push_back(column ? taken(*column, result.figure.take) : std::nan(""));
    }
    return run;
}

} // namespace drystone
