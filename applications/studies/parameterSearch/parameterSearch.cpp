// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// parameterSearch: the values of selected entries of a case for which a result is least or largest.
#include "core/Error.h"
#include "core/Log.h"
#include "core/Signals.h"
#include "ensembles/ParameterSearchCase.h"
#include "ensembles/SearchReport.h"
#include "ensembles/SearchRun.h"
#include "runControl/Application.h"

using namespace drystone;

namespace
{

int run(const CommandLine& commandLine)
{
    if (commandLine.postProcess)
    {
        throw FatalError("parameterSearch writes its tables when it runs: omit -postProcess.");
    }
    const ParameterSearch search = readParameterSearch(commandLine.caseDirectory, commandLine);
    SearchHistory history(search);
    printSearch(search, history);
    if (commandLine.dryRun)
    {
        requireReadableCase(search);
        printEnd();
        return 0;
    }

    requireWritableResults(search);
    catchStopSignals();
    const SearchOutcome outcome = carryOut(search, history);
    printOutcome(search, history, outcome);
    writeOutcome(search, history, outcome);
    printExecutionTime();
    printStopOrEnd("Started again, it continues.");
    return exitStatus(outcome);
}

} // namespace

int main(int argc, char* argv[])
{
    ApplicationDescription description;
    description.name = "parameterSearch";
    description.summary =
        "Varies entries of a case until a result is least or largest, within constraints: runs applications "
        "in copies of the case and lets algorithms of NLopt choose the points. Started again, it continues.";
    description.kind = ApplicationKind::solver;
    description.postProcess.clear();
    description.examples = {"parameterSearch -case arch"};
    description.tutorial = "parameterSearch/archThickness";
    description.dictionaries = {{"system/parameterSearchDict", describeOptions<ParameterSearchSettings>}};
    return runApplication(argc, argv, description, run);
}
