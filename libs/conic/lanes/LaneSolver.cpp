// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The choice among the kernels, and what they are asked.
#include "conic/lanes/LaneSolver.h"

#include "conic/Certificate.h"
#include "conic/form/PointCones.h"
#include "conic/lanes/LaneBeginnings.h"
#include "linear/DenseKernel.h"

#include <stdexcept>
#include <string_view>

namespace drystone
{

// Each in a file of its own, compiled for its processors: LaneKernelAvx512.cpp and so on.
void solveLanesWithAvx512(LaneTask& task);
void solveLanesWithAvx2(LaneTask& task);
void solveLanesWithBaseline(LaneTask& task);

namespace
{

/// Bodies up to which the factor, by blocks without supernodes, is the better one (linear/SchurSystem.cpp),
/// and the memory of all lanes is that of a cache.
constexpr int mostBodiesInLanes = 300;

/// That for the processors of the dense kernel in use.
LaneKernel chooseKernel()
{
    [[maybe_unused]] const std::string_view processors = denseKernel().name;
#if defined(__x86_64__)
    if (processors == "avx512")
    {
        return {8, solveLanesWithAvx512};
    }
    if (processors == "avx2")
    {
        return {4, solveLanesWithAvx2};
    }
#endif
    return {2, solveLanesWithBaseline};
}

const LaneKernel& laneKernel()
{
    static const LaneKernel chosen = chooseKernel();
    return chosen;
}

} // namespace

LaneSolver::LaneSolver() = default;
LaneSolver::~LaneSolver() = default;

int LaneSolver::lanes()
{
    return laneKernel().lanes;
}

bool LaneSolver::takes(const PlaneConeProgram& program)
{
    if (!program.hasMultiplier() || program.hasInertia() || program.gap.size() > 0 || program.hasCompliance()
        || program.hasStrength() || program.points() == 0 || program.bodies == 0
        || program.bodies > mostBodiesInLanes)
    {
        return false;
    }
    for (int point = 0; point < program.points(); ++point)
    {
        const ConeColumns<3, 2>& columns = program.contacts[point];
        const double mu = program.friction[point];
        const bool isOfSameBodies = point > 0 && columns.first == program.contacts[point - 1].first
                                    && columns.second == program.contacts[point - 1].second;
        if (!(mu > 0 && mu < largeFriction) || (isOfSameBodies && mu != program.friction[point - 1])
            || (columns.first < 0 && columns.second < 0) || !hasOppositeForces(columns))
        {
            return false;
        }
    }
    return true;
}

bool LaneSolver::areAlike(const PlaneConeProgram& one, const PlaneConeProgram& other)
{
    return one.bodies == other.bodies && haveSamePoints(one.contacts, other.contacts);
}

void LaneSolver::beginFrom(std::vector<PlaneConeProgram> programs)
{
    references = std::move(programs);
    beginnings.reset();
}

/// Follows the paths of the references where the program has their points. \return whether it has
bool LaneSolver::prepareBeginnings(const PlaneConeProgram& program, double tolerance)
{
    if (references.empty() || !areAlike(references.front(), program))
    {
        return false;
    }
    if (!beginnings || beginnings->tolerance != tolerance)
    {
        beginnings = std::make_unique<LaneBeginnings>(*geometry, laneKernel(), references, tolerance);
    }
    return !beginnings->isEmpty();
}

/// \param isBegun from the references; those that are not near one have no answer
std::vector<ConeSolution> LaneSolver::solveAtOnce(const std::vector<const PlaneConeProgram*>& programs,
                                                  double tolerance, bool isBegun)
{
    geometry->setPrograms(programs);
    geometry->task.tolerance = tolerance;
    geometry->task.complementarity = 0;
    geometry->task.isBegun = isBegun;
    for (std::size_t index = 0; index < programs.size() && isBegun; ++index)
    {
        beginnings->begin(*geometry, *programs[index], index);
    }
    laneKernel().solve(geometry->task);
    std::vector<ConeSolution> solutions;
    for (std::size_t index = 0; index < programs.size(); ++index)
    {
        solutions.push_back(geometry->solutionOf(*programs[index], index));
        ConeSolution& solution = solutions.back();
        if (solution.contactForce.size() > 0
            && certifyOptimal(*programs[index], solution).worst() <= tolerance)
        {
            solution.status = SolveStatus::optimal;
        }
    }
    return solutions;
}

std::vector<ConeSolution> LaneSolver::solve(const std::vector<const PlaneConeProgram*>& programs,
                                            double tolerance)
{
    if (programs.empty())
    {
        throw std::invalid_argument("LaneSolver solves one program or more");
    }
    if (!geometry || !geometry->isOf(*programs.front()))
    {
        geometry = std::make_unique<LaneGeometry>(*programs.front(), lanes());
    }
    std::vector<ConeSolution> solutions =
        solveAtOnce(programs, tolerance, prepareBeginnings(*programs.front(), tolerance));
    if (!geometry->task.isBegun)
    {
        return solutions;
    }
    std::vector<std::size_t> left;
    std::vector<const PlaneConeProgram*> again;
    for (std::size_t index = 0; index < solutions.size(); ++index)
    {
        if (solutions[index].status != SolveStatus::optimal)
        {
            left.push_back(index);
            again.push_back(programs[index]);
        }
    }
    if (!again.empty())
    {
        const std::vector<ConeSolution> fromScratch = solveAtOnce(again, tolerance, false);
        for (std::size_t index = 0; index < left.size(); ++index)
        {
            const SolverWork before = solutions[left[index]];
            solutions[left[index]] = fromScratch[index];
            addWork(solutions[left[index]], before);
        }
    }
    return solutions;
}
} // namespace drystone
