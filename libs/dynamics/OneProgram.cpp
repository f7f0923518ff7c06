// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The solver's answer, with the displacements that its forces give the blocks.
#include "dynamics/OneProgram.h"

#include "dynamics/RestingStep.h"

#include <algorithm>
#include <utility>

namespace drystone
{
namespace
{

/// The solver's choice with no more iterations a program than the work left to the step allows for, but as
/// many as an ordinary program takes: the one that crosses the border is brought to its end, not beyond.
template<int Dim>
SolverChoice withinWork(const StepSettings& settings, const ThetaStep& step, const StepProgram<Dim>& program)
{
    constexpr double ordinary = 30;
    SolverChoice choice = settings.solver;
    // Programs of a step are alike: in space a start that is lost once is lost again, after 24
    // factorisations.
    choice.isNearTried = Dim == 2 || !(step.isStartLost || settings.isFixedPointOnly);
    if (settings.work)
    {
        const double left = settings.work->most - settings.work->done
                            - workOf(step.iterations, step.factorisations, program.points(), program.bodies);
        const double iterations = left / workOf(1, 1, program.points(), program.bodies);
        choice.maximumIterations =
            static_cast<int>(std::min<double>(choice.maximumIterations, std::max(ordinary, iterations)));
    }
    return choice;
}

} // namespace

template<int Dim>
bool solveOnce(ThetaStep& step, const StepProgram<Dim>& program, const StepSettings& settings,
               const ConeSolution& start, SymbolicAnalysis* symbolic)
{
    const SolverChoice solver = withinWork(settings, step, program);
    ConeSolution solution = solveCounted(step, program, solver, start, symbolic);
    ++step.programs;
    step.status = solution.status;
    step.isStartLost = step.isStartLost || solution.isStartLost;
    bool isBalanced = false;
    if (solution.status == SolveStatus::optimal)
    {
        const Eigen::VectorXd outOfBalance = program.load - applyEquilibrium(program, solution.contactForce);
        if (mayRest(program, outOfBalance)
            && standsStill(step, program, settings, solver, solution, symbolic))
        {
            return false;
        }
        Eigen::VectorXd found = std::move(solution.displacement);
        solution.displacement = displacementUnder(program, outOfBalance);
        step.certificate = certifyOptimal(program, solution);
        isBalanced = step.certificate.worst() <= solver.tolerance;
        if (!isBalanced)
        {
            solution.displacement = std::move(found);
        }
    }
    if (!isBalanced)
    {
        step.certificate = certifyOptimal(program, solution);
    }
    step.displacement = std::move(solution.displacement);
    step.contactForce = std::move(solution.contactForce);
    step.closing = applyTransposed(program, step.displacement);
    return isBalanced;
}

template<int Dim>
bool isWorkUsedUp(const StepSettings& settings, const ThetaStep& step, const StepProgram<Dim>& program)
{
    return settings.work
           && settings.work->done
                      + workOf(step.iterations, step.factorisations, program.points(), program.bodies)
                  > settings.work->mostOfAttempt;
}

template bool solveOnce(ThetaStep& step, const StepProgram<2>& program, const StepSettings& settings,
                        const ConeSolution& start, SymbolicAnalysis* symbolic);
template bool isWorkUsedUp(const StepSettings& settings, const ThetaStep& step,
                           const StepProgram<2>& program);
template bool solveOnce(ThetaStep& step, const StepProgram<3>& program, const StepSettings& settings,
                        const ConeSolution& start, SymbolicAnalysis* symbolic);
template bool isWorkUsedUp(const StepSettings& settings, const ThetaStep& step,
                           const StepProgram<3>& program);

} // namespace drystone
