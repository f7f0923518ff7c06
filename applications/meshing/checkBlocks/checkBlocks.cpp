// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// checkBlocks: reports whether the blocks of a case are suitable for computation.
#include "assembly/AssemblyFile.h"
#include "contact/AssemblyChecks.h"
#include "contact/ClosedAssembly.h"
#include "contact/JointClosure.h"
#include "core/Log.h"
#include "runControl/Application.h"

using namespace drystone;

namespace
{

template<int Dim>
int runIn(const CommandLine& commandLine)
{
    const Assembly<Dim> assembly = readAssembly<Dim>(commandLine.caseDirectory);
    printClosure(assembly);
    const CheckExtent extent = commandLine.has("allChecks") ? CheckExtent::all : CheckExtent::standard;
    const AssemblyReport<Dim> report = checkAssembly(assembly, extent);
    printLine(printedReport(assembly, report)); // its last line is the verdict
    return failedChecks(report) == 0 ? 0 : 1;
}

int run(const CommandLine& commandLine)
{
    return assemblyDimensions(commandLine.caseDirectory) == 3 ? runIn<3>(commandLine) : runIn<2>(commandLine);
}

} // namespace

int main(int argc, char* argv[])
{
    ApplicationDescription description;
    description.name = "checkBlocks";
    description.summary =
        "Checks the blocks in constant/assembly/: volumes, inertia, duplicates, overlaps, gaps, "
        "slivers, and blocks with no path to a support. The exit status is 1 when a check fails.";
    description.options = {
        {"allChecks", "", "also short joints, and blocks that stand on a corner or an edge without a joint"}};
    description.examples = {"checkBlocks -case wall -allChecks"};
    return runApplication(argc, argv, description, run);
}
