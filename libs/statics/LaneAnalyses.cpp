// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Which limit analyses lanes can answer, and batches of those that are alike.
#include "statics/LaneAnalyses.h"

#include "conic/form/Form.h"
#include "statics/CompletedAnalysis.h"
#include "statics/SurfaceContact.h"

namespace drystone
{
namespace
{

/// The answer of a solution that lanes have found, or none: what is not clearly an optimum at a multiplier of
/// the right sign is for the ordinary solver.
std::optional<LimitAnalysis> answerOf(const LimitAnalysisCase<2>& structure, const ConeSolution& solution,
                                      SymbolicAnalysis& kept)
{
    if (solution.status != SolveStatus::optimal || solution.multiplier < 0)
    {
        return {};
    }
    return completedAnalysis(structure.program, solution, interiorPointSettings(structure.solution), kept);
}

/// Solves the first of the structures that are left with all that are like it.
void solveNext(const std::vector<LimitAnalysisCase<2>>& structures, std::vector<std::size_t>& left,
               LaneSolver& lanes, SymbolicAnalysis& kept, std::vector<std::optional<LimitAnalysis>>& answers)
{
    const LimitAnalysisCase<2>& first = structures[left.front()];
    std::vector<std::size_t> together;
    std::vector<std::size_t> later;
    std::vector<const PlaneConeProgram*> programs;
    for (const std::size_t index : left)
    {
        const LimitAnalysisCase<2>& structure = structures[index];
        const bool isAlike = structure.solution.tolerance == first.solution.tolerance
                             && LaneSolver::areAlike(structure.program, first.program);
        if (isAlike)
        {
            together.push_back(index);
            programs.push_back(&structure.program);
        }
        else
        {
            later.push_back(index);
        }
    }
    const std::vector<ConeSolution> solutions = lanes.solve(programs, first.solution.tolerance);
    for (std::size_t i = 0; i < together.size(); ++i)
    {
        answers[together[i]] = answerOf(structures[together[i]], solutions[i], kept);
    }
    left = std::move(later);
}

/// Whether lanes solve as chosen. They have a number of correctors of their own, and end after fewer
/// iterations than are allowed by default: fewer still, or others, are for the solver that the user has set.
bool areHonoured(const SolverChoice& choice)
{
    const SolverChoice usual;
    return (choice.solver == SolverType::automatic || choice.solver == SolverType::interiorPoint)
           && choice.maximumIterations >= usual.maximumIterations && choice.correctors == usual.correctors
           && choice.writeProgram == WriteProgram::never && !choice.writeIterations && !choice.observer;
}

} // namespace

bool isForLanes(const LimitAnalysisCase<2>& structure)
{
    return structure.multiplier == Multiplier::positive && !structure.movement && !structure.pushover
           && structure.loads.positions.empty() && structure.combinations.empty()
           && !isSurfaceContact(structure.contact) && flowRuleOf(structure.contact) == FlowRule::associative
           && areHonoured(structure.solution) && LaneSolver::takes(structure.program);
}

void beginLanesFrom(const std::vector<LimitAnalysisCase<2>>& structures, LaneSolver& lanes)
{
    std::vector<PlaneConeProgram> references;
    for (const LimitAnalysisCase<2>& structure : structures)
    {
        if (isForLanes(structure)
            && (references.empty() || LaneSolver::areAlike(references.front(), structure.program)))
        {
            references.push_back(structure.program);
        }
    }
    lanes.beginFrom(std::move(references));
}

template<int Dim>
std::vector<std::optional<LimitAnalysis>> solveInLanes(const std::vector<LimitAnalysisCase<Dim>>& structures,
                                                       LaneSolver& lanes, SymbolicAnalysis& kept)
{
    std::vector<std::optional<LimitAnalysis>> answers(structures.size());
    if constexpr (Dim == 2)
    {
        std::vector<std::size_t> left;
        for (std::size_t index = 0; index < structures.size(); ++index)
        {
            if (isForLanes(structures[index]))
            {
                left.push_back(index);
            }
        }
        while (!left.empty())
        {
            solveNext(structures, left, lanes, kept, answers);
        }
    }
    return answers;
}

template std::vector<std::optional<LimitAnalysis>>
solveInLanes(const std::vector<LimitAnalysisCase<2>>& structures, LaneSolver& lanes, SymbolicAnalysis& kept);
template std::vector<std::optional<LimitAnalysis>>
solveInLanes(const std::vector<LimitAnalysisCase<3>>& structures, LaneSolver& lanes, SymbolicAnalysis& kept);

} // namespace drystone
