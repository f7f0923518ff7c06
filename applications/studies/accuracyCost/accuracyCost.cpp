// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// accuracyCost: the CPU time of accuracy: errors of figures against a reference and the CPU time they take,
/// over steps, schemes, flow rules, solvers, tolerances and contact points.
#include "assembly/AssemblyFile.h"
#include "core/Error.h"
#include "core/Log.h"
#include "core/Signals.h"
#include "core/WholeFile.h"
#include "ensembles/AccuracyStudyRun.h"
#include "runControl/Application.h"
#include "runControl/PictureFormats.h"

using namespace drystone;

namespace
{

int run(const CommandLine& commandLine)
{
    if (commandLine.postProcess)
    {
        throw FatalError("accuracyCost writes its tables when it runs: omit -postProcess. Called again, "
                         "it writes them again from the known runs.");
    }
    const std::filesystem::path& directory = commandLine.caseDirectory;
    readPictureFormats(directory); // a fault in it is to be reported before the runs
    const AccuracyStudy study = assemblyDimensions(directory) == 3 ? readAccuracyStudy<3>(directory)
                                                                   : readAccuracyStudy<2>(directory);
    printAccuracyStudy(study);
    AccuracyRuns runs(study);
    if (commandLine.dryRun)
    {
        printEnd();
        return 0;
    }

    requireWritable(accuracyFolder(directory));
    catchStopSignals();
    const AccuracyResults results = carryOut(study, runs);
    printAccuracyResults(study, results);
    writeAccuracyResults(study, results);
    printExecutionTime();
    printStopOrEnd("Started again, it continues.");
    return exitStatus(results);
}

} // namespace

int main(int argc, char* argv[])
{
    ApplicationDescription description;
    description.name = "accuracyCost";
    description.summary =
        "Computes figures of a case with many settings: their errors against a reference and CPU times, as "
        "table, pictures and a page. Started again, it continues where it was stopped.";
    description.kind = ApplicationKind::solver;
    description.postProcess.clear();
    description.examples = {"accuracyCost -case rockingBlock"};
    description.tutorial = "accuracyCost/rockingBlock";
    description.dictionaries = {{"system/accuracyCostDict", describeOptions<AccuracySettings>}};
    return runApplication(argc, argv, description, run);
}
