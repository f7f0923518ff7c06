// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// One sample: in this process without any file, or by applications in a copy of the case.
#include "core/Error.h"
#include "ensembles/CaseRuns.h"
#include "ensembles/SamplesInProcess.h"
#include "statics/LaneAnalyses.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <new>

namespace drystone
{

namespace fs = std::filesystem;

namespace
{

/// The first line of a message.
std::string firstLine(const std::string& text)
{
    return text.substr(0, text.find('\n'));
}

/// The first line of what an application says, without the one that says that it is an error.
std::string firstLineOfError(const std::string& text)
{
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);)
    {
        line.erase(0, line.find_first_not_of(' '));
        if (!line.empty() && !line.starts_with("-->"))
        {
            return line;
        }
    }
    return firstLine(text);
}

} // namespace

SampleRunner::SampleRunner(const Ensemble& of, fs::path folder) : ensemble(of), scratch(std::move(folder))
{
    if (ensemble.isInProcess)
    {
        inProcess = std::make_unique<SamplesInProcess>(ensemble);
    }
}

SampleRunner::~SampleRunner()
{
    std::error_code ignored;
    fs::remove_all(scratch, ignored);
}

SampleOutcome SampleRunner::run(const std::vector<SampleValue>& values)
{
    const std::vector<double> none(ensemble.settings.results.size(), std::nan(""));
    try
    {
        return inProcess ? outcomeOf(inProcess->run(values)) : runByApplications(values);
    }
    catch (const NotConverged& error)
    {
        return {SampleStatus::notConverged, none, error.message};
    }
    catch (const FatalError& error)
    {
        return {SampleStatus::failed, none, firstLine(error.what())};
    }
    catch (const std::bad_alloc&)
    {
        throw;
    }
    catch (const std::exception& error)
    {
        return {SampleStatus::failed, none, firstLine(error.what())};
    }
}

int SampleRunner::together() const
{
    return ensemble.areAlike && isTogetherWorthIt ? LaneSolver::together() : 1;
}

std::vector<std::optional<SampleOutcome>>
SampleRunner::runTogether(const std::vector<std::vector<SampleValue>>& samples,
                          const std::function<void(std::size_t)>& begins)
{
    std::vector<std::optional<SampleOutcome>> outcomes(samples.size());
    if (inProcess && ensemble.areAlike)
    {
        outcomes = inProcess->runTogether(samples, begins);
    }
    isTogetherWorthIt = std::any_of(outcomes.begin(), outcomes.end(),
                                    [](const std::optional<SampleOutcome>& of) { return of.has_value(); });
    return outcomes;
}

SampleOutcome SampleRunner::runByApplications(const std::vector<SampleValue>& values)
{
    const std::size_t count = ensemble.settings.results.size();
    const CaseRun done = runCopy(ensemble.caseDirectory, scratch, entriesOf(ensemble, values),
                                 {ensemble.settings.applications, {"."}, ensemble.options});
    warnings.print(done.warnings);
    const bool isCutShort = done.isInterrupted && done.application != ensemble.settings.applications.back();
    if (done.status != 0 || isCutShort)
    {
        const SampleStatus status = done.status > 128  ? SampleStatus::crashed
                                    : done.status == 2 ? SampleStatus::notConverged
                                                       : SampleStatus::failed;
        SampleOutcome outcome{status, std::vector<double>(count, std::nan("")),
                              fmt::format("{} ended with exit status {}: {}", done.application, done.status,
                                          firstLineOfError(done.errorOutput))};
        const int signal = done.status - 128;
        outcome.isFromOutside =
            isCutShort || signal == SIGKILL || signal == SIGTERM || signal == SIGHUP || signal == SIGINT;
        return outcome;
    }
    std::vector<double> results;
    for (const auto& [name, figure] : ensemble.settings.results)
    {
        const auto column = readColumn(scratch / figure.table->table, figure.table->column);
        if (!column)
        {
            throw FatalError(
                fmt::format("The applications have not written the table {}.", figure.table->table));
        }
        results.push_back(taken(*column, figure.table->take));
    }
    return outcomeOf(std::move(results));
}

} // namespace drystone
