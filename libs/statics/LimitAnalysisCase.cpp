// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
#include "statics/LimitAnalysisCase.h"

#include "assembly/AssemblyChecks.h"
#include "assembly/AssemblyFile.h"
#include "assembly/Materials.h"
#include "core/Solution.h"

namespace drystone
{

void declare(Options& options, LimitAnalysisControls& controls)
{
    declare(options, controls.solver);
    options.optional("nonAssociative", controls.nonAssociative,
                     "how the lowest collapse with `flowRule nonAssociative;` is searched for");
}

LimitAnalysisCase readLimitAnalysisCase(const std::filesystem::path& caseDirectory)
{
    LimitAnalysisCase result;
    const auto controls = readOptions<LimitAnalysisControls>(readSolution(caseDirectory, "limitAnalysis"));
    result.solution = controls.solver;
    result.nonAssociative = controls.nonAssociative;
    if (solvesMotionOnly(result.solution.solver))
    {
        throw FatalIOError(nameOf(result.solution.solver)
                               + " solves steps in time only. Write `solver interiorPoint;`.",
                           readSolution(caseDirectory, "limitAnalysis").locationOf("solver"));
    }
    result.solution.solver = SolverType::interiorPoint;
    result.assembly = readAssembly(caseDirectory);
    refuseOverlaps(result.assembly, caseDirectory);
    requireFreeBlock(result.assembly, caseDirectory);

    result.contact = readContactProperties(caseDirectory);
    const Vector<2> gravity = readGravity(caseDirectory);
    const std::vector<BlockMass<2>> blocks = blockMasses(result.assembly);
    const std::vector<double> masses =
        massesOf(blocks, readDensities(caseDirectory, result.assembly, gravity));
    const LoadVectors loads =
        readLoads(caseDirectory, {result.assembly, masses, gravity}, LiveLoad::required);

    result.points = findContactPoints(result.assembly);
    result.friction = frictionCoefficients(result.contact, result.points.size());
    result.freeBlocks = static_cast<int>(loads.dead.size()) / 3;
    result.program =
        limitAnalysisProgram(result.freeBlocks, equilibriumColumns(result.assembly, blocks, result.points),
                             result.friction, loads);
    return result;
}

LimitAnalysis solveLimitAnalysis(const LimitAnalysisCase& structure)
{
    const InteriorPointSettings solver = interiorPointSettings(structure.solution);
    const std::optional<CoulombFriction>& friction = structure.contact.friction;
    return friction && friction->flowRule == FlowRule::nonAssociative
               ? solveNonAssociative(structure.program, jointsOf(structure.points), structure.nonAssociative,
                                     solver)
               : solveLimitAnalysis(structure.program, solver);
}

} // namespace drystone
