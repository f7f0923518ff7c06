// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// incrementalDynamics: repeats the motion of contactDynamics over a growing ground acceleration and finds
/// the least one that meets a criterion; with several records an incremental dynamic analysis.
#include "assembly/AssemblyFile.h"
#include "core/Error.h"
#include "core/Log.h"
#include "core/Signals.h"
#include "core/WholeFile.h"
#include "ensembles/IncrementalDynamicsCase.h"
#include "ensembles/IncrementalDynamicsLog.h"
#include "ensembles/IncrementalHistory.h"
#include "ensembles/StudyInput.h"
#include "functionObjects/KeptResults.h"
#include "functionObjects/LimitAnalysisResults.h"
#include "runControl/Application.h"

using namespace drystone;

namespace
{

template<int Dim>
int runIn(const CommandLine& commandLine)
{
    if (commandLine.postProcess)
    {
        throw FatalError("incrementalDynamics writes its tables when it runs: omit -postProcess.");
    }
    Time time(commandLine.caseDirectory, ControlDict::required, RunsOfCase::many);
    const auto study = readIncrementalDynamics<Dim>(commandLine.caseDirectory, time);
    if (!commandLine.noFunctionObjects)
    {
        checkFunctions(time.controlDict(), commandLine.caseDirectory, study.scene.assembly);
    }
    printStudy(study);
    if (commandLine.dryRun)
    {
        printEnd();
        return 0;
    }

    catchStopSignals();
    const std::filesystem::path folder = incrementalDynamicsFolder(commandLine.caseDirectory, time);
    requireWritable(folder);
    IncrementalHistory<Dim> history(commandLine.caseDirectory, folder, study);
    const std::vector<IncrementalCurve> known = history.known();
    if (!history.changeOfInput().empty())
    {
        info("The runs of history.dat are of other input ({}): all are carried out again",
             history.changeOfInput());
    }
    else if (history.count() > 0)
    {
        info("Continuing: {} runs are known from {}", history.count(), (folder / "history.dat").string());
    }
    StudyClock clock(study.intensity.mostRuns * static_cast<long>(study.motions.size()),
                     static_cast<long>(history.count()));
    const std::vector<IncrementalCurve> curves = carryOut(
        study,
        [&](std::size_t motion, const IncrementalRun& done)
        {
            history.add(motion, done);
            clock.count();
            printRun(study, motion, done, clock.timeLeft());
        },
        known);
    printLeast(study, curves);
    writeIncrementalDynamics(folder, study, curves);
    writeInput(folder / "input", inputOfQuestions(commandLine.caseDirectory, "incrementalDynamics"));
    printExecutionTime();
    printStopOrEnd("The tables hold the runs that are done; started again, it continues.");
    return exitStatus(curves);
}

int run(const CommandLine& commandLine)
{
    return assemblyDimensions(commandLine.caseDirectory) == 3 ? runIn<3>(commandLine) : runIn<2>(commandLine);
}

} // namespace

int main(int argc, char* argv[])
{
    ApplicationDescription description;
    description.name = "incrementalDynamics";
    description.summary =
        "Repeats the motion that contactDynamics computes over a growing ground acceleration and finds the "
        "least one that meets a criterion, as log, table and picture. The runs use all cores.";
    description.kind = ApplicationKind::solver;
    description.postProcess.clear();
    description.examples = {"incrementalDynamics -case wall"};
    description.tutorial = "incrementalDynamics/masonryPanels";
    description.dictionaries = {
        {"system/incrementalDynamicsDict", describeOptions<IncrementalDynamicsSettings>}};
    return runApplication(argc, argv, description, run);
}
