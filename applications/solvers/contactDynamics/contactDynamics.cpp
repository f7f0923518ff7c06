// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// contactDynamics: steps a structure of rigid blocks with dry joints through time (Portioli, Cascini &
/// Landolfo 2017, eq. 1-9).
#include "assembly/AssemblyFile.h"
#include "assembly/Loads.h"
#include "assembly/Materials.h"
#include "core/Error.h"
#include "core/Log.h"
#include "core/Signals.h"
#include "dynamics/Advance.h"
#include "dynamics/GroundMotionPlausibility.h"
#include "dynamics/InitialMotion.h"
#include "effects/SupportMotion.h"
#include "functionObjects/EffectAdvice.h"
#include "functionObjects/MotionLog.h"
#include "functionObjects/MotionResults.h"
#include "functionObjects/StoredStates.h"
#include "functionObjects/UnsolvedStep.h"
#include "runControl/Application.h"
#include "runControl/Case.h"
#include "runControl/ReportApplication.h"
#include "runControl/ThreadControls.h"

using namespace drystone;

namespace
{

/// Which effects a case needs, by what a dry run knows of it.
template<int Dim>
void printAdvice(const DynamicCase<Dim>& scene, const Motion<Dim>& motion)
{
    if constexpr (Dim == 2)
    {
        printLine(adviceText(scene, adviseEffects(scene, motion.state)));
    }
    else
    {
        printLine("Advice by closed-form criteria: none in space.");
    }
}

/// The steps of a run. Each is the program of eq. 9,
///
///     minimise   1/2 r' Mbar^-1 r + g0' c   subject to   r + A0 c = f + Mbar v0 dt,   |t| <= mu n,
///
/// whose multipliers are the displacements over the step. ThetaStep.h derives it; Advance.h has the stages of
/// a step: find contacts, assemble, contribute, solve, collide, review, move, account.
template<int Dim>
void stepThrough(const DynamicCase<Dim>& scene, Motion<Dim>& motion, Time& time, MotionResults<Dim>& results,
                 MotionSummary<Dim>& summary)
{
    Progress progress;
    while (time.loop())
    {
        if (time.isLogTime())
        {
            printLine("Time = " + time.name());
        }
        if (!advance(scene, motion, time))
        {
            results.writeNow();
            results.finish();
            throw FatalError(unsolvedStep(scene, motion, time), 2);
        }
        summary.observe(motion.state, motion.residuals);
        results.write();
        printStep(scene, motion, time);
        progress.update(time.progress());
    }
    results.finish();
    progress.clear();
}

template<int Dim>
int runIn(const CommandLine& commandLine)
{
    Time time(commandLine.caseDirectory, ControlDict::required);
    useThreads(time.controlDict());
    auto scene = readDynamicCase<Dim>(commandLine.caseDirectory);
    question(doubtsAboutTimes(groundMotionOf(scene.effects), time.controls(), time.controlDict()));
    if (commandLine.postProcess)
    {
        postProcess(commandLine.caseDirectory, scene, time);
        printEnd();
        return 0;
    }
    Motion<Dim> motion = startOrContinue(commandLine.caseDirectory, scene, time);
    MotionResults<Dim> results(commandLine.caseDirectory, scene, motion, time,
                               commandLine.noFunctionObjects ? FunctionObjects::none
                                                             : FunctionObjects::asInControlDict);
    printScene(scene, motion, time, results.functions().names());
    printUnappliedLoad(commandLine.caseDirectory);
    if (commandLine.dryRun)
    {
        printAdvice(scene, motion);
        printEnd();
        return 0;
    }

    catchStopSignals();
    writePrograms(scene, commandLine.caseDirectory, time);
    results.writeFirstFrames();
    MotionSummary<Dim> summary(scene);
    stepThrough(scene, motion, time, results, summary);
    printWhereRunBegan(time);
    printIntegrationError(scene, motion, time);
    printEffectUse(scene, motion);
    printStageTimes(motion.stageTimes);
    printSummary(summary, motion);
    results.printWritten();
    if (commandLine.has("report"))
    {
        runReport(commandLine.caseDirectory);
    }
    printStopOrEnd(time);
    return time.exitStatus();
}

int run(const CommandLine& commandLine)
{
    return assemblyDimensions(commandLine.caseDirectory) == 3 ? runIn<3>(commandLine) : runIn<2>(commandLine);
}

} // namespace

int main(int argc, char* argv[])
{
    ApplicationDescription description;
    description.name = "contactDynamics";
    description.summary =
        "Motion of the blocks in constant/assembly/ under their dead load and the motion of "
        "the ground: time directories, tables of system/controlDict/functions, VTK series.";
    description.kind = ApplicationKind::solver;
    description.options = {{"report", "", "also write report.html, as the application report does"}};
    description.examples = {"contactDynamics                 # in a case directory, after blockTexture",
                            "contactDynamics -dry-run        # checks all, says which effects are needed",
                            "contactDynamics -postProcess    # the functions again, from stored states"};
    description.tutorial = "contactDynamics/archUnderPulse";
    description.dictionaries = {{"constant/g", describeOptions<Gravity<2>>},
                                {"constant/g in space", describeOptions<Gravity<3>>},
                                {"constant/materialProperties", describeOptions<MaterialProperties>},
                                {"constant/contactProperties", describeOptions<CaseEffects<2>>},
                                {"constant/loads", describeOptions<LoadCases<2>>},
                                {"constant/loads in space", describeOptions<LoadCases<3>>},
                                {"constant/groundMotion", describeOptions<GroundMotionSettings>},
                                {"constant/supportMotion", describeOptions<SupportMotionFile<2>>},
                                {"constant/supportMotion in space", describeOptions<SupportMotionFile<3>>},
                                {"0/motion", describeOptions<InitialMotion<2>>},
                                {"0/motion in space", describeOptions<InitialMotion<3>>},
                                {"system/controlDict", describeOptions<ControlDictSettings>},
                                {"system/schemes", describeOptions<Schemes>},
                                {"system/solution/contactDynamics", describeOptions<SolverChoice>}};
    return runApplication(argc, argv, description, run);
}
