// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Takes known points from the history, runs the others, and keeps the best one's copy by renaming it.
#include "ensembles/SearchRun.h"

#include "core/Log.h"
#include "core/Signals.h"
#include "dictionary/EntryLocations.h"
#include "ensembles/CopyMessages.h"
#include "ensembles/StudyInput.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <limits>
#include <map>
#include <optional>

namespace drystone
{
namespace
{

namespace fs = std::filesystem;

void keepAsBest(const ParameterSearch& search)
{
    const fs::path folder = search.caseDirectory / "parameterSearch";
    std::error_code ignored;
    fs::remove_all(folder / "best", ignored);
    fs::rename(folder / "evaluation", folder / "best", ignored);
}

std::string outcomeText(const ParameterSearchSettings& settings, const Evaluation& found)
{
    std::string text = pointText(settings, found.variables);
    for (std::size_t i = 0; i < found.results.size(); ++i)
    {
        text += fmt::format("  {} = {:.9g}", settings.results[i].first, found.results[i]);
    }
    return text
           + fmt::format(
               "  objective = {:.9g}{}", found.objective,
               found.violation > 0 ? fmt::format("  violates a constraint by {:.3g}", found.violation) : "");
}

/// Whether every result has a number for points at which there is none.
bool hasOtherwise(const ParameterSearchSettings& settings)
{
    return std::all_of(settings.results.begin(), settings.results.end(),
                       [](const auto& result) { return result.second.otherwise.has_value(); });
}

/// Whether no point was computed, as applications refused their input: a bound may be such a point, but if
/// two are, the case is at fault.
bool areInputErrors(const std::vector<SearchRecord>& records)
{
    return std::all_of(records.begin(), records.end(),
                       [](const SearchRecord& record) { return record.exitStatus == 1; });
}

/// A search while it runs: what has been evaluated so far, and the best of it.
struct RunningSearch
{
    const ParameterSearch& search;
    SearchHistory& history;
    double start = clockTime(); ///< [s]
    std::optional<double> bestObjective = {};
    double bestViolation = std::numeric_limits<double>::infinity();
    InputWatch input{search.caseDirectory, runsOf(search), search.caseInput, "# "};
    int evaluations = 0;
    int computed = 0;                                     ///< of these, the others were known
    std::map<std::vector<double>, int> exitStatuses = {}; ///< of the points, see SearchRecord
    WarningsOfCopies warnings = {};
    int cutShort = 0;            ///< of the computed ones: maximumTime has ended a search in a case of theirs
    std::string cutShortIn = {}; ///< the last such case
};

/// \return whether it is the best point so far, which from now on is the one to be compared with
bool takeIfBest(RunningSearch& running, const Evaluation& found)
{
    const double sign = running.search.settings.objective.sign();
    const bool isBest = !running.bestObjective || found.violation < running.bestViolation
                        || (found.violation == running.bestViolation
                            && sign * found.objective < sign * *running.bestObjective);
    if (isBest)
    {
        running.bestObjective = found.objective;
        running.bestViolation = found.violation;
    }
    return isBest;
}

void printEvaluation(const RunningSearch& running, const Evaluation& found, const std::string& remark)
{
    info("Evaluation {}: {}{}", running.evaluations, outcomeText(running.search.settings, found), remark);
    std::fflush(stdout); // for those who follow the log
}

/// The longest that the search may still take, as fast as it was until now.
std::string longestLeft(const RunningSearch& running)
{
    int most = 0;
    for (const SearchStage& stage : running.search.settings.search)
    {
        most += stage.maximumEvaluations;
    }
    return durationText((clockTime() - running.start) / running.computed
                        * std::max(0, most - running.evaluations));
}

/// The case is at fault where nothing but input errors comes of the first points.
void requireComputable(const RunningSearch& running, const std::vector<double>& variables,
                       const PointRun& run)
{
    const std::vector<SearchRecord>& records = running.history.records();
    const bool mayBeAtABound = records.empty() && hasOtherwise(running.search.settings);
    if (!run.failure.empty() && run.failureStatus == 1 && areInputErrors(records) && !mayBeAtABound)
    {
        throw FatalError(fmt::format("The first point{} of the search cannot be computed: {}.\n{}\n\nAt {}.",
                                     records.empty() ? "" : "s", run.failure, run.errorOutput,
                                     pointText(running.search.settings, variables)));
    }
}

/// Why a table of a point may have no number.
std::string reasonOfNoNumber(const PointRun& run)
{
    if (!run.failure.empty())
    {
        return run.failure + ".\n" + run.errorOutput;
    }
    return run.cutShortIn.empty()
               ? "The table says so: the structure does not stand there, or any load is carried."
               : "The table says so, and maximumTime has ended the search for collapses by Coulomb's law "
                 "there, before all was tried: raise it, or remove it.";
}

Evaluation evaluateKnown(RunningSearch& running, const SearchRecord& known)
{
    const ParameterSearch& search = running.search;
    const Evaluation found =
        evaluate(search.settings, known.variables,
                 completed(search, known.variables, known.results, "The history of the search has none."));
    running.exitStatuses[known.variables] = known.exitStatus;
    takeIfBest(running, found);
    printEvaluation(running, found, "  (known)");
    return found;
}

/// What the applications have warned of, but for the searches by Coulomb's law that maximumTime has ended:
/// these are counted, see questionCutShort.
std::vector<std::string> warningsOf(const PointRun& run)
{
    std::vector<std::string> warnings = run.warnings;
    const auto isCounted = [](const std::string& warning)
    { return warning.find("/limitAnalysis/nonAssociative/maximumTime at line") != std::string::npos; };
    if (!run.cutShortIn.empty())
    {
        std::erase_if(warnings, isCounted);
    }
    return warnings;
}

Evaluation evaluateComputed(RunningSearch& running, const std::vector<double>& variables, const PointRun& run)
{
    const ParameterSearch& search = running.search;
    if (const std::string change = running.input.change(); !change.empty())
    {
        throw FatalError(editedCaseText(change, "the search was", "Points", parameterSearchName));
    }
    running.warnings.print(warningsOf(run));
    requireComputable(running, variables, run);
    const Evaluation found = evaluate(search.settings, variables,
                                      completed(search, variables, run.results, reasonOfNoNumber(run)));
    running.history.add({variables, run.results, run.failureStatus, run.cpuTime});
    running.exitStatuses[variables] = run.failureStatus;
    ++running.computed;
    if (!run.cutShortIn.empty())
    {
        ++running.cutShort;
        running.cutShortIn = run.cutShortIn;
    }
    printEvaluation(running, found,
                    fmt::format("{}  ({:.2f} s; at most {} left)",
                                run.failure.empty() ? "" : "  " + run.failure, run.cpuTime,
                                longestLeft(running)));
    if (takeIfBest(running, found))
    {
        keepAsBest(search);
    }
    return found;
}

/// Warns that multipliers of computed points depend on the time that there was for them.
void questionCutShort(const RunningSearch& running)
{
    if (running.cutShort == 0)
    {
        return;
    }
    const fs::path solution = running.search.caseDirectory / running.cutShortIn / "system/solution";
    printWarning(
        fmt::format("maximumTime has ended the search for collapses by Coulomb's law at {} of {} points that "
                    "were computed, before all was tried: their multipliers depend on how fast this "
                    "machine is and what else it does, and are no numbers where no collapse was found. "
                    "Raise maximumTime, or remove it.",
                    running.cutShort, running.computed),
        EntryLocations(Dictionary::readFileIfPresent(solution.lexically_normal()))
            .of("limitAnalysis/nonAssociative/maximumTime"));
}

} // namespace

SearchOutcome carryOut(const ParameterSearch& search, SearchHistory& history)
{
    RunningSearch running{search, history};
    const Evaluator evaluator = [&running](const std::vector<double>& variables) -> std::optional<Evaluation>
    {
        if (stopSignal() != 0)
        {
            return {};
        }
        ++running.evaluations;
        if (const SearchRecord* known = running.history.find(variables))
        {
            return evaluateKnown(running, *known);
        }
        const PointRun run = runPoint(running.search, variables);
        return run.isInterrupted ? std::optional<Evaluation>() : evaluateComputed(running, variables, run);
    };
    SearchOutcome outcome = searchBest(search.settings, search.start, evaluator);
    outcome.points = running.exitStatuses.size();
    outcome.failedPoints =
        static_cast<std::size_t>(std::count_if(running.exitStatuses.begin(), running.exitStatuses.end(),
                                               [](const auto& point) { return point.second != 0; }));
    std::error_code ignored;
    fs::remove_all(search.caseDirectory / "parameterSearch/evaluation", ignored);
    questionCutShort(running);
    return outcome;
}

} // namespace drystone
