// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// report: one self-contained page of a case and its results.
#include "core/Log.h"
#include "ensembles/KeptStudies.h"
#include "ensembles/StudyAnswers.h"
#include "report/CaseReport.h"
#include "runControl/Application.h"

#include <fmt/format.h>

using namespace drystone;

namespace
{

int run(const CommandLine& commandLine)
{
    const std::filesystem::path& directory = commandLine.caseDirectory;
    const auto output = commandLine.get("output");
    std::vector<ReportSection> studies;
    for (StudyAnswer& answer : answersOfStudies(directory))
    {
        for (const std::string& fault : answer.faults)
        {
            printWarning(fmt::format("{}: {}.", answer.study, fault));
            answer.sentences.push_back(fault + ".");
        }
        studies.push_back({fmt::format("Study: {}", answer.study), std::move(answer.sentences),
                           std::move(answer.head), std::move(answer.rows)});
    }
    writeReport(directory, output ? std::filesystem::path(*output) : reportFile(directory),
                compareStudies(directory), studies);
    printExecutionTime();
    printEnd();
    return 0;
}

} // namespace

int main(int argc, char* argv[])
{
    ApplicationDescription description;
    description.name = "report";
    description.summary =
        "Writes report.html into the case: input with units, results with their meaning and certificate, "
        "pictures, time histories and a viewer in three dimensions, in one file that needs no other.";
    description.options = {
        {"output", "FILE", "instead of report.html in the case; relative to where you are"}};
    description.examples = {"report -case wall        # after limitAnalysis or contactDynamics"};
    return runApplication(argc, argv, description, run);
}
