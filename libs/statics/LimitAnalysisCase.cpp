// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
#include "statics/LimitAnalysisCase.h"

#include "assembly/AssemblyChecks.h"
#include "assembly/AssemblyFile.h"
#include "assembly/Materials.h"
#include "core/Solution.h"

namespace drystone
{

LimitAnalysisCase readLimitAnalysisCase(const std::filesystem::path& caseDirectory)
{
    LimitAnalysisCase result;
    result.solution = readSolverChoice(caseDirectory, "limitAnalysis");
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
    if (result.contact.friction && result.contact.friction->flowRule == FlowRule::nonAssociative)
    {
        const Dictionary dictionary = Dictionary::readFile(caseDirectory / "constant/contactProperties");
        throw FatalIOError(
            "limitAnalysis follows the associative flow rule only, in which a joint that slides opens. "
            "Write `flowRule associative;`: its multiplier is an upper bound on that of Coulomb's law.",
            dictionary.subDict("friction").locationOf("flowRule"));
    }
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

} // namespace drystone
