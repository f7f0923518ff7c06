// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// ensemble: many samples of one case, by processes on one machine, under mpirun or srun, or as a Slurm
/// array.
#include "core/Error.h"
#include "core/Log.h"
#include "core/Signals.h"
#include "core/WholeFile.h"
#include "ensembles/EnsembleResults.h"
#include "ensembles/Evaluate.h"
#include "ensembles/Submit.h"
#include "ensembles/Workers.h"
#include "runControl/Application.h"

#include <charconv>
#include <cstdlib>

using namespace drystone;

namespace
{

int results(const Ensemble& ensemble)
{
    std::map<long, SampleRow> rows;
    const SampleTable table = collectSamples(ensemble, rows);
    return writeEnsemble(ensemble, rows, table);
}

/// Samples belong to the values that system/ensembleDict gave them: with others nothing is written. A case
/// that has changed since is warned of.
void compareWithPlan(const Ensemble& ensemble)
{
    const std::filesystem::path work = ensembleWork(ensemble.caseDirectory);
    const std::optional<PlanChange> change = planChange(work, ensemble.plan);
    if (!change)
    {
        throw FatalError(fmt::format("There are no samples to process: {} has no plan. Run ensemble without "
                                     "-postProcess first.",
                                     work.string()));
    }
    if (!change->questions.empty())
    {
        throw FatalError(fmt::format(
            "The samples in {} were computed for other questions than those of now, so that no table is "
            "written: {}. Restore that to process them, or remove postProcessing/ensemble and run ensemble "
            "anew.",
            work.string(), change->questions));
    }
    if (!change->hasInput)
    {
        info("An older version has written {} and noted its input in another way: changes since are not "
             "noticed.",
             work.string());
    }
    if (!change->input.empty())
    {
        printWarning(fmt::format("The samples are those of other input: {}. What follows is of the old "
                                 "samples; remove postProcessing/ensemble and run ensemble to compute anew.",
                                 change->input),
                     {(work / "plan").string(), "", 0});
    }
}

/// `Samples: 1200 of 100000, 3 attempts ended, 2100/s, 47 s left`
void printProgress(const EnsembleProgress& progress)
{
    const auto left = static_cast<double>(progress.samples - progress.done);
    info("Samples: {} of {}{}{}", progress.done, progress.samples,
         progress.failed > 0 ? fmt::format(", {} attempts ended", progress.failed) : "",
         progress.rate > 0
             ? fmt::format(", {:.3g}/s, {} left", progress.rate, durationText(left / progress.rate))
             : "");
    std::fflush(stdout);
}

int jobsOf(const CommandLine& commandLine)
{
    if (const auto jobs = commandLine.get("jobs"))
    {
        int count = 0;
        const auto [end, error] = std::from_chars(jobs->data(), jobs->data() + jobs->size(), count);
        if (error != std::errc() || end != jobs->data() + jobs->size() || count < 1 || count > 1024)
        {
            throw FatalError(fmt::format("-jobs {} is no number of processes: give 1 to 1024.", *jobs));
        }
        return count;
    }
    if (!commandLine.parallel)
    {
        return threadCount();
    }
    // The launcher has as many of us as there are cores, unless it gives each of us several.
    const char* cores = std::getenv("SLURM_CPUS_PER_TASK");
    return cores ? std::max(std::atoi(cores), 1) : 1;
}

/// Answers one sample of another program. \param files that of the parameters and that of the results, a line
/// each
int evaluate(const CommandLine& commandLine, const std::string& files)
{
    const std::size_t end = files.find('\n');
    if (end == std::string::npos)
    {
        throw FatalError("-evaluate takes two files: that of the parameters and that of the results.");
    }
    return evaluateSample(commandLine.caseDirectory, files.substr(0, end), files.substr(end + 1));
}

Ensemble ensembleOf(const CommandLine& commandLine)
{
    std::vector<std::string> options;
    if (commandLine.noFunctionObjects)
    {
        options.emplace_back("-noFunctionObjects");
    }
    return readEnsemble(commandLine.caseDirectory, options);
}

/// Makes the tables of the samples that are there.
int process(const Ensemble& ensemble)
{
    compareWithPlan(ensemble);
    const int status = results(ensemble);
    printExecutionTime();
    printEnd();
    return status;
}

/// Whether this program is the one of its launch that writes the log.
bool writesLog(const LaunchedAs& launched)
{
    return launched.rank == 0 || launched.isArray;
}

/// Computes the samples that are not there yet, and makes the tables.
int compute(const Ensemble& ensemble, const WorkerSettings& workers)
{
    catchStopSignals();
    const bool reports = writesLog(workers.launched);
    if (reports)
    {
        // Made before the case is tried in a copy there, which takes away the folders that it had to make:
        // others of the launch are about to use this one.
        std::error_code error;
        std::filesystem::create_directories(ensembleWork(ensemble.caseDirectory), error);
        requireReadableCase(ensemble);
    }
    SampleStore store(ensemble.caseDirectory, ensemble.plan, ensemble.samples(), ensemble.wholeChunk());
    if (reports)
    {
        info("Processes: {}{}", workers.jobs,
             workers.launched.size > 1 ? fmt::format(" in each of {} programs", workers.launched.size) : "");
    }
    const auto report = [reports](const EnsembleProgress& progress)
    {
        if (reports)
        {
            printProgress(progress);
        }
    };
    const bool isComplete = computeSamples(ensemble, store, workers, report);
    const bool isToBeWritten = workers.waitsForOthers && (isComplete || stopSignal() != 0);
    const int status = isToBeWritten ? results(ensemble) : 0;
    printExecutionTime();
    printStopOrEnd("Started again, it continues.");
    return stopSignal() != 0 ? exitStatusOfSignal(stopSignal()) : status;
}

int run(const CommandLine& commandLine)
{
    if (const auto files = commandLine.get("evaluate"))
    {
        return evaluate(commandLine, *files);
    }
    const Ensemble ensemble = ensembleOf(commandLine);
    const LaunchedAs launched = commandLine.parallel ? launchedAs() : LaunchedAs();
    if (writesLog(launched))
    {
        printEnsemble(ensemble);
    }
    if (commandLine.dryRun)
    {
        requireReadableCase(ensemble);
        printEnd();
        return 0;
    }
    requireWritable(ensembleFolder(ensemble.caseDirectory));
    if (commandLine.has("submit"))
    {
        submitToSlurm(ensemble, *commandLine.get("submit"));
        printEnd();
        return 0;
    }
    if (commandLine.postProcess)
    {
        return process(ensemble);
    }
    return compute(ensemble, {jobsOf(commandLine), launched, launched.rank == 0 && !launched.isArray});
}

/// The two files of -evaluate as one argument, a line each: other options have one.
std::vector<std::string> joined(int argc, char* argv[])
{
    std::vector<std::string> arguments(argv, argv + argc);
    for (std::size_t i = 0; i + 2 < arguments.size(); ++i)
    {
        if (arguments[i] == "-evaluate" || arguments[i] == "--evaluate")
        {
            arguments[i + 1] += "\n" + arguments[i + 2];
            arguments.erase(arguments.begin() + static_cast<std::ptrdiff_t>(i) + 2);
            break;
        }
    }
    return arguments;
}

} // namespace

int main(int argc, char* argv[])
{
    ApplicationDescription description;
    description.name = "ensemble";
    description.summary =
        "Computes many samples of a case with uncertain entries: Monte Carlo, fragility, incremental dynamic "
        "analysis, sensitivity. Uses all cores; started again, it continues.";
    description.kind = ApplicationKind::solver;
    description.postProcess = "make the tables of the samples that are there";
    description.parallel = "share the samples with the other processes of mpirun, srun or a Slurm array";
    description.options = {
        {"jobs", "N", "worker processes; the number of cores unless given"},
        {"submit", "OPTIONS", "write and submit a Slurm script with these options, such as \"--array=1-32\""},
        {"evaluate", "PARAMETERS RESULTS", "answer one sample of Dakota or quoFEM"}};
    description.sharing = {"evaluate"};
    description.examples = {"ensemble -case wall              # on all cores; started again, it continues",
                            "mpirun -np 64 ensemble -case wall -parallel",
                            "ensemble -case wall -submit \"--array=1-32 --cpus-per-task=8\"    # Slurm"};
    description.tutorial = "ensemble/wall6";
    description.dictionaries = {{"system/ensembleDict", describeOptions<EnsembleSettings>}};
    const std::vector<std::string> arguments = joined(argc, argv);
    std::vector<const char*> given;
    for (const std::string& argument : arguments)
    {
        given.push_back(argument.c_str());
    }
    return runApplication(static_cast<int>(given.size()), given.data(), description, run);
}
