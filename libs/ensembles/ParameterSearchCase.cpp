// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Takes known points from the history, runs the others, and keeps the best one's copy by renaming it.
#include "ensembles/ParameterSearchCase.h"

#include "core/Log.h"
#include "core/Signals.h"
#include "core/WholeFile.h"
#include "ensembles/CaseRuns.h"
#include "ensembles/SearchPicture.h"
#include "ensembles/StudyHistory.h"
#include "ensembles/StudyInput.h"
#include "ensembles/WrittenTables.h"
#include "functionObjects/ColumnFile.h"
#include "functionObjects/KeptResults.h"
#include "runControl/Case.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <map>

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

/// What the points follow from.
StudyRuns runsOf(const ParameterSearch& search)
{
    return {"system/parameterSearchDict", search.settings.applications, search.settings.cases};
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

} // namespace

ParameterSearch readParameterSearch(const fs::path& caseDirectory, const CommandLine& commandLine)
{
    ParameterSearch search;
    search.caseDirectory = caseDirectory;
    search.pictureFormats = readPictureFormats(caseDirectory);
    search.dictionary =
        Dictionary::readFile(requireCaseFile(caseDirectory, "system/parameterSearchDict",
                                             "It specifies which entries to vary and what to find; "
                                             "etc/annotated/system/parameterSearchDict is one to copy."));
    search.settings = readSearchSettings(search.dictionary);
    std::error_code unknown; // a name that no file can have is not a file
    for (const std::string& directory : search.settings.cases)
    {
        if (!fs::is_directory(caseDirectory / directory, unknown))
        {
            throw FatalIOError(
                fmt::format("There is no directory {} in this case: name one that is.", directory),
                search.dictionary.locationOf("cases"));
        }
    }
    for (const auto& [name, variable] : search.settings.variables)
    {
        const Dictionary& own = search.dictionary.subDict("variables").subDict(name);
        const Entry entry = lookUp(caseDirectory, variable.place, own);
        double value = 0;
        try
        {
            value = entry.as<double>();
        }
        catch (const FatalIOError& error)
        {
            throw FatalIOError(fmt::format("The entry {} of {} cannot be varied: it has to be a number.\n{}",
                                           variable.place.entry, variable.place.file, error.what()),
                               own.locationOf("entry"));
        }
        search.start.push_back(
            variable.start.value_or(std::clamp(value, variable.bounds[0], variable.bounds[1])));
    }
    const StudyRuns runs = runsOf(search);
    for (const auto& [name, result] : search.settings.results)
    {
        requireTable(result.figure, caseDirectory, runs, search.dictionary.subDict("results").subDict(name));
    }
    search.caseInput = historyInput(inputOfStudy(caseDirectory, runs));
    if (commandLine.noFunctionObjects)
    {
        search.options.emplace_back("-noFunctionObjects");
    }
    return search;
}

void requireWritableResults(const ParameterSearch& search)
{
    requireWritable(searchFolder(search.caseDirectory));
    requireWritable(search.caseDirectory / parameterSearchName);
}

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

namespace
{

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

Evaluation evaluateComputed(RunningSearch& running, const std::vector<double>& variables, const PointRun& run)
{
    const ParameterSearch& search = running.search;
    if (const std::string change = running.input.change(); !change.empty())
    {
        throw FatalError(editedCaseText(change, "the search was", "Points", parameterSearchName));
    }
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

namespace
{

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
    writeInput(folder / "input", inputOfSearch(search.caseDirectory));

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
