// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// limitAnalysis: max alpha with A0 c = fD + alpha fL and |t| <= mu n (Portioli, Cascini & Landolfo 2017, eq.
/// 10).
#include "assembly/AssemblyFile.h"
#include "assembly/Loads.h"
#include "assembly/Materials.h"
#include "core/Log.h"
#include "effects/EffectList.h"
#include "functionObjects/CollapseProgressLog.h"
#include "functionObjects/KeptResults.h"
#include "functionObjects/LimitAnalysisLog.h"
#include "functionObjects/LimitAnalysisResults.h"
#include "functionObjects/PushoverResults.h"
#include "io/MechanismPicture.h"
#include "runControl/Application.h"
#include "runControl/ReportApplication.h"
#include "runControl/Schemes.h"
#include "runControl/ThreadControls.h"
#include "runControl/Time.h"
#include "statics/SolveCase.h"

#include <algorithm>

using namespace drystone;

namespace
{

/// From where the picture of the mechanism is seen.
Vector<3> viewOf(const CommandLine& commandLine, int dimensions)
{
    const std::optional<std::string> view = commandLine.get("view");
    if (view && dimensions == 2)
    {
        throw FatalError("-view is for structures in space: in the plane there is one view. Leave it out.");
    }
    return view ? viewFrom(*view) : usualView();
}

/// Solves the program of eq. 10,
///
///     maximise   alpha   subject to   A0 c = fD + alpha fL,   |t| <= mu n,
///
/// for each answer that the case requests (SolveCase.h), and writes what it says. The multipliers of the
/// first constraint are the mechanism. limitAnalysisProgram (LimitAnalysis.h) fills it in. \return whether
/// there is an answer
template<int Dim>
bool analyse(LimitAnalysisCase<Dim>& structure, const std::filesystem::path& directory,
             const AnswerPictures& pictures)
{
    flushLog();
    structure.nonAssociative.observe =
        collapseProgressLog(structure.nonAssociative.maximumTime ? SearchTime::limited : SearchTime::endless);
    const double start = cpuTime();
    const std::vector<LimitAnalysis> results = solveLimitAnalyses(structure);
    const double used = cpuTime() - start;
    printLimitAnalysis(structure, results);
    writeLimitAnalysisProgram(directory, structure, results.front());
    if (!std::all_of(results.begin(), results.end(), hasAnswer))
    {
        removeLimitAnalysisResults(directory);
        return false;
    }
    writeLimitAnalysisResults(directory, structure, results, used, pictures);
    return !structure.pushover || runPushover(directory, structure, pictures.formats);
}

template<int Dim>
int runIn(const CommandLine& commandLine)
{
    const std::filesystem::path& directory = commandLine.caseDirectory;
    const Vector<3> towardsViewer = viewOf(commandLine, Dim);
    const Time time(directory); // nothing moves, but a fault in controlDict is reported here too
    useThreads(time.controlDict());
    auto structure = readLimitAnalysisCase<Dim>(directory);
    if (!commandLine.noFunctionObjects)
    {
        checkFunctions(time.controlDict(), directory, structure.assembly);
    }
    printLimitAnalysisCase(structure, directory);
    if (commandLine.postProcess)
    {
        confirmResults(directory);
        compareWithInput(limitAnalysisInput(directory), inputOfLimitAnalysis(directory, structure.assembly));
    }
    else if (!commandLine.dryRun)
    {
        requireWritableResults(directory);
    }
    if (!commandLine.dryRun && !commandLine.postProcess)
    {
        if (!analyse(structure, directory, {towardsViewer, time.controls().pictureFormats}))
        {
            return 2;
        }
    }
    if (commandLine.has("report") && !commandLine.dryRun)
    {
        runReport(directory);
    }
    printExecutionTime();
    printEnd();
    return 0;
}

int run(const CommandLine& commandLine)
{
    return assemblyDimensions(commandLine.caseDirectory) == 3 ? runIn<3>(commandLine) : runIn<2>(commandLine);
}

} // namespace

int main(int argc, char* argv[])
{
    ApplicationDescription description;
    description.name = "limitAnalysis";
    description.summary =
        "Collapse load multiplier, mechanism and contact forces of the blocks in constant/assembly/ "
        "under constant/loads, with a certificate.";
    description.kind = ApplicationKind::solver;
    description.options = {
        {"report", "", "also write report.html, as the application report does"},
        {"view", "DIRECTION",
         "one of front back left right top, from where mechanism.svg is seen in space, or the "
         "direction to the viewer, as \"(1 -1.4 0.8)\""}};
    description.examples = {"limitAnalysis                       # in a case directory, after blockTexture",
                            "limitAnalysis -case wall -dry-run   # checks every dictionary, solves nothing",
                            "limitAnalysis -view back            # in space: the picture seen from behind"};
    description.tutorial = "limitAnalysis/masonryPanels";
    description.dictionaries = {{"constant/g", describeOptions<Gravity<2>>},
                                {"constant/g in space", describeOptions<Gravity<3>>},
                                {"constant/materialProperties", describeOptions<MaterialProperties>},
                                {"constant/contactProperties", describeOptions<CaseEffects<2>>},
                                {"constant/loads", describeOptions<LoadCases<2>>},
                                {"constant/loads in space", describeOptions<LoadCases<3>>},
                                {"system/schemes", describeOptions<Schemes>},
                                {"system/solution/limitAnalysis", describeOptions<LimitAnalysisControls>}};
    return runApplication(argc, argv, description, run);
}
