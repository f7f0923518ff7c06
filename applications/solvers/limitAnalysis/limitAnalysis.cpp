// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// limitAnalysis: max alpha with A0 c = fD + alpha fL and |t| <= mu n (Portioli, Cascini & Landolfo 2017, eq.
/// 10).
#include "assembly/ContactProperties.h"
#include "core/Case.h"
#include "core/CommandLine.h"
#include "core/Error.h"
#include "core/Log.h"
#include "core/Time.h"
#include "functionObjects/LimitAnalysisResults.h"

using namespace drystone;

namespace
{

void printSize(const LimitAnalysisCase& structure)
{
    std::vector<std::string> absent;
    for (const AbsentEffect& effect : absentEffects())
    {
        absent.emplace_back(effect.name);
    }
    printEffects({"friction"}, absent);
    info("Blocks: {} free, contact points: {}", structure.freeBlocks, structure.points.size());
    info("Solver: {}, tolerance {:g}\n", structure.solution.solver, structure.solution.settings.tolerance);
}

/// \return exit status: 0 for an answer, 2 for none
int printAnswer(const LimitAnalysis& result)
{
    const Certificate& certificate = result.certificate;
    const auto status = [&](std::string_view text)
    {
        info("Status: {}", text);
        info(
            "Certificate: primal residual = {:.3e}, dual residual = {:.3e}, gap = {:.3e}, No Iterations {}\n",
            certificate.primalResidual, certificate.dualResidual, certificate.gap, result.iterations);
    };
    switch (result.status)
    {
    case CollapseStatus::optimal:
        info("Collapse load multiplier alpha = {:.9g}", result.alpha);
        status("optimal");
        return 0;
    case CollapseStatus::unstable:
        status("unstable (the blocks cannot carry the dead load: the mechanism is written)");
        return 0;
    case CollapseStatus::unbounded:
        status("unbounded (no load of this direction makes it collapse)");
        return 0;
    case CollapseStatus::notConverged:
        break;
    }
    status("not converged: there is no answer. Raise tolerance or maximumIterations in "
           "system/solution/limitAnalysis");
    return 2;
}

int run(const CommandLine& commandLine)
{
    printBanner(commandLine);
    if (commandLine.postProcess)
    {
        throw FatalError("limitAnalysis writes all its results as it runs: leave -postProcess away.");
    }
    const Time time(commandLine.caseDirectory); // nothing moves, but a fault in controlDict is one here too
    const LimitAnalysisCase structure = readLimitAnalysisCase(commandLine.caseDirectory);
    requireWritableResults(commandLine.caseDirectory);
    printSize(structure);
    if (!commandLine.dryRun)
    {
        const double start = cpuTime();
        const LimitAnalysis result = solveLimitAnalysis(structure.program, structure.solution.settings);
        const double used = cpuTime() - start;
        if (const int exitStatus = printAnswer(result))
        {
            return exitStatus;
        }
        writeLimitAnalysisResults(commandLine.caseDirectory, structure, result, used);
    }
    printExecutionTime();
    printEnd();
    return 0;
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
    description.details = []
    {
        return fmt::format("system/solution/limitAnalysis:\n{}",
                           helpText(describeOptions<LimitAnalysisSolution>()));
    };
    return runApplication(argc, argv, description, run);
}
