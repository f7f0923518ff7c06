// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The log and the files of a search, of what has been read and of what its algorithms have come to.
#include "ensembles/SearchReport.h"

#include "core/Log.h"
#include "core/Signals.h"
#include "ensembles/SearchPicture.h"
#include "ensembles/StudyInput.h"
#include "functionObjects/ColumnFile.h"
#include "functionObjects/KeptResults.h"

#include <fmt/format.h>

#include <cmath>
#include <filesystem>

namespace drystone
{
namespace
{

namespace fs = std::filesystem;

/// Whether the search has ended without finding what it was to find.
bool isShort(const SearchOutcome& outcome)
{
    return outcome.end == SearchEnd::failed || outcome.end == SearchEnd::astray
           || outcome.end == SearchEnd::notMonotone
           || (outcome.end == SearchEnd::evaluations && !isGlobal(outcome.stages.back().first));
}

std::string statusText(const ParameterSearch& search, const SearchOutcome& outcome)
{
    switch (outcome.end)
    {
    case SearchEnd::converged:
        return "converged";
    case SearchEnd::astray:
        return "not converged: the last algorithm ended at a point that violates the constraints";
    case SearchEnd::notMonotone:
        return "not converged: the objective does not grow, or fall, all the way from one bound to the "
               "other, as bisection needs: take COBYLA or DIRECT";
    case SearchEnd::evaluations:
        if (isShort(outcome) && outcome.beyondBounds > 0)
        {
            return fmt::format(
                "not converged: {0} has spent {1} of {2} evaluations outside the bounds, where "
                "nothing is computed: take BOBYQA or SBPLX, which keep to them, or raise "
                "maximumEvaluations",
                nameOf(outcome.stages.back().first), outcome.beyondBounds,
                search.settings.search[outcome.stages.size() - 1].maximumEvaluations);
        }
        return isShort(outcome) ? "not converged: raise maximumEvaluations" : "all evaluations made";
    case SearchEnd::failed:
        return outcome.stages.back().first == SearchAlgorithm::bisection
                   ? "not converged: neither bound meets the constraints, and bisection begins with one that "
                     "does: change the bounds, or take COBYLA or DIRECT"
                   : "not converged: the last algorithm failed";
    case SearchEnd::interrupted:
        break;
    }
    return "interrupted";
}

/// Warns of a best point that is best by what stands for a number which it does not have.
void questionBest(const ParameterSearch& search, const SearchHistory& history, const Evaluation& best)
{
    const SearchRecord* record = history.find(best.variables);
    for (std::size_t i = 0; record && i < record->results.size(); ++i)
    {
        if (!std::isfinite(record->results[i]))
        {
            const auto& [name, result] = search.settings.results[i];
            printWarning(
                fmt::format("The best point has no {}{}: {:g} is its `otherwise`. Where such a point "
                            "is no answer, give `otherwise` a value that is worse than any answer.",
                            name, record->exitStatus == 0 ? "" : ", since an application failed there",
                            best.results[i]),
                search.dictionary.subDict("results").subDict(name).locationOf("otherwise"));
        }
    }
}

} // namespace

void printSearch(const ParameterSearch& search, const SearchHistory& history)
{
    const ParameterSearchSettings& settings = search.settings;
    info("Applications: {}{}", fmt::join(settings.applications, " "),
         settings.cases == std::vector<std::string>{"."}
             ? ""
             : fmt::format(", in {}", fmt::join(settings.cases, " ")));
    info("Variables:");
    for (std::size_t i = 0; i < settings.variables.size(); ++i)
    {
        const auto& [name, variable] = settings.variables[i];
        info("    {}: {}/{} from {:g} to {:g}, start {:g}", name, variable.place.file, variable.place.entry,
             variable.bounds[0], variable.bounds[1], search.start[i]);
    }
    info("Objective: {} {}", settings.objective.goal == SearchGoal::minimise ? "minimise" : "maximise",
         settings.objective.value);
    for (const auto& [name, constraint] : settings.constraints)
    {
        info("Constraint {}: {}{}{}", name, constraint.value,
             constraint.atLeast ? fmt::format(", at least {:g}", *constraint.atLeast) : "",
             constraint.atMost ? fmt::format(", at most {:g}", *constraint.atMost) : "");
    }
    std::string algorithms;
    for (const SearchStage& stage : settings.search)
    {
        algorithms += fmt::format("{}{} (up to {} evaluations)", algorithms.empty() ? "" : ", then ",
                                  nameOf(stage.algorithm), stage.maximumEvaluations);
    }
    info("Search: {}", algorithms);
    if (!history.records().empty())
    {
        info("Continuing: {} points are known from postProcessing/parameterSearch/0/history.dat",
             history.records().size());
    }
    printLine();
}

void printOutcome(const ParameterSearch& search, const SearchHistory& history, const SearchOutcome& outcome)
{
    const ParameterSearchSettings& settings = search.settings;
    printLine();
    if (outcome.end == SearchEnd::interrupted)
    {
        info("Stopped before the end of the search; started again, it continues from here");
    }
    if (!outcome.best)
    {
        if (outcome.end == SearchEnd::failed)
        {
            info("Status: not converged: {} failed before its first point",
                 nameOf(outcome.stages.back().first));
        }
        return;
    }
    if (outcome.best->violation > 0)
    {
        info("No point that was tried meets the constraints; the nearest one violates them by {:.6g}:",
             outcome.best->violation);
    }
    else
    {
        info("{} {} = {:.9g}", settings.objective.goal == SearchGoal::minimise ? "Least" : "Largest",
             settings.objective.value, outcome.best->objective);
    }
    for (std::size_t i = 0; i < settings.variables.size(); ++i)
    {
        const auto& [name, variable] = settings.variables[i];
        const double value = outcome.best->variables[i];
        info("    {} = {:.9g}{}", name, value,
             value == variable.bounds[0]   ? "  (at its lower bound)"
             : value == variable.bounds[1] ? "  (at its upper bound)"
                                           : "");
    }
    for (std::size_t i = 0; i < settings.results.size(); ++i)
    {
        info("    {} = {:.9g}", settings.results[i].first, outcome.best->results[i]);
    }
    std::string stages;
    for (const auto& [algorithm, evaluations] : outcome.stages)
    {
        stages += fmt::format("{}{} {}", stages.empty() ? "" : ", ", nameOf(algorithm), evaluations);
    }
    if (outcome.failedPoints > 0)
    {
        info("At {} of {} points an application failed, and `otherwise` was used: see exitStatus in "
             "history.dat",
             outcome.failedPoints, outcome.points);
    }
    info("Status: {} (evaluations: {})", statusText(search, outcome), stages);
    questionBest(search, history, *outcome.best);
}

void writeOutcome(const ParameterSearch& search, const SearchHistory& history, const SearchOutcome& outcome)
{
    if (!outcome.best)
    {
        return;
    }
    const ParameterSearchSettings& settings = search.settings;
    const fs::path folder = searchFolder(search.caseDirectory);
    std::vector<std::string> columns;
    std::vector<double> row;
    const auto add = [&](const std::string& name, double value)
    {
        columns.push_back(name);
        row.push_back(value);
    };
    for (std::size_t i = 0; i < settings.variables.size(); ++i)
    {
        add(settings.variables[i].first, outcome.best->variables[i]);
    }
    for (std::size_t i = 0; i < settings.results.size(); ++i)
    {
        add(settings.results[i].first, outcome.best->results[i]);
    }
    add("objective", outcome.best->objective);
    add("violation", outcome.best->violation);
    add("end", static_cast<double>(outcome.end));
    add("evaluations", static_cast<double>(history.records().size()));
    ColumnFile(folder / "best.dat", columns, 12).write(row);
    writeInput(folder / "input", inputOfQuestions(search.caseDirectory, parameterSearchName));

    std::vector<Evaluation> points;
    for (const SearchRecord& record : history.records())
    {
        points.push_back(
            evaluate(settings, record.variables, completed(search, record.variables, record.results, "")));
    }
    writePlot(folder / "parameterSearch", searchPicture(settings, points, *outcome.best),
              search.pictureFormats);
}

int exitStatus(const SearchOutcome& outcome)
{
    if (outcome.end == SearchEnd::interrupted)
    {
        return exitStatusOfSignal(stopSignal());
    }
    return isShort(outcome) || !outcome.best || outcome.best->violation > 0 ? 2 : 0;
}

} // namespace drystone
