// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Coulomb's law by Newton's method, and how far a solution is from it.
#include "dynamics/CoulombFlow.h"

#include "conic/CoulombNewton.h"
#include "conic/coulomb/AlternatingDirections.h"
#include "dynamics/FollowedFlow.h"
#include "dynamics/RestingStep.h"

#include <algorithm>
#include <cmath>

namespace drystone
{
namespace
{

/// From the forces of the last step it ends soon or not at all.
constexpr int newtonStepsFromLastStep = 20;

/// With gaps as they are. \param program that of the problem, linearised about where the start leads; with
/// what the flow opens on return \return whether it was reached; otherwise the step is as it was but for the
/// work counted
template<int Dim>
bool solveWithGivenGaps(ThetaStep& step, StepProgram<Dim>& program, const FlowProblem<Dim>& problem,
                        const ConeSolution& start, const NewtonEffort& effort)
{
    constexpr double beyond = 1e-3; // nearly for nothing: the last Newton step is exact
    const StepSettings& settings = problem.settings;
    ConeSolution solution = solveCoulombNewton(
        program, start, {beyond * settings.solver.tolerance, effort.gapTolerance, effort.steps},
        problem.symbolic);
    addWork(step, solution);
    if (solution.status != SolveStatus::optimal)
    {
        return false;
    }
    takeOver(step, program, std::move(solution), settings, effort.gapTolerance, 0);
    return true;
}

} // namespace

template<int Dim>
void takeOver(ThetaStep& step, StepProgram<Dim>& program, ConeSolution solution, const StepSettings& settings,
              double gapTolerance, double backwards)
{
    solution.displacement =
        displacementUnder(program, program.load - applyEquilibrium(program, solution.contactForce));
    Eigen::VectorXd closing = applyTransposed(program, solution.displacement);
    // Gaps that are right to a tolerance only may as well be those that the points which touch want.
    for (int point = 0; point < program.points(); ++point)
    {
        const double mu = program.friction[static_cast<std::size_t>(point)];
        const Strength strength = program.strengthOf(static_cast<std::size_t>(point));
        const auto force = solution.contactForce.segment<Dim>(Dim * point);
        auto gap = program.gap.template segment<Dim>(Dim * point);
        const Vector<Dim> open = gap - closing.segment<Dim>(Dim * point);
        if ((force[0] > -strength.tension || open[0] < 0) && std::abs(open[0]) <= gapTolerance)
        {
            gap[0] -= open[0];
        }
        auto shearGap = program.gap.template segment<Dim - 1>(Dim * point + 1);
        const auto shearOpen = open.template tail<Dim - 1>();
        const auto shear = force.template tail<Dim - 1>();
        const bool sticks = shear.norm() < strength.cohesion + mu * force[0];
        const bool isBackwards = shear.dot(shearOpen) > 0;
        if ((sticks && shearOpen.norm() <= gapTolerance)
            || (!sticks && isBackwards && shearOpen.norm() <= backwards))
        {
            shearGap -= shearOpen;
        }
        gap[0] += mu * (closing.segment<Dim - 1>(Dim * point + 1) - shearGap).norm();
    }
    step.certificate = certifyOptimal(program, solution);
    step.flowError = 0;
    if (settings.solver.observer)
    {
        settings.solver.observer(program, solution);
    }
    step.status = SolveStatus::optimal;
    step.displacement = std::move(solution.displacement);
    step.contactForce = std::move(solution.contactForce);
    step.closing = std::move(closing);
}

template<int Dim>
Eigen::VectorXd dilatancy(const StepProgram<Dim>& program, const Eigen::VectorXd& closing,
                          const Eigen::VectorXd& contactForce)
{
    const Eigen::VectorXd gap = program.hasCompliance() ? gapUnder(program, contactForce) : program.gap;
    Eigen::VectorXd opening(program.points());
    for (int point = 0; point < program.points(); ++point)
    {
        opening[point] =
            program.friction[static_cast<std::size_t>(point)]
            * (closing.segment<Dim - 1>(Dim * point + 1) - gap.segment<Dim - 1>(Dim * point + 1)).norm();
    }
    return opening;
}

template<int Dim>
Eigen::VectorXd openingsOfLeastForces(ThetaStep& step, const FlowProblem<Dim>& problem)
{
    if constexpr (Dim == 3)
    {
        const StepProgram<Dim>& program = problem.program;
        if (program.contacts.size() >= pointsOfLarge && problem.settings.kind == StepKind::motion
            && !program.hasCompliance() && !program.hasStrength())
        {
            const ConeSolution near =
                solveAlternatingDirections(program, problem.expected, {}, problem.symbolic);
            addWork(step, near);
            return dilatancy(program, applyTransposed(program, near.displacement), near.contactForce);
        }
    }
    return {};
}

template<int Dim>
double errorOfFlow(const Eigen::VectorXd& imposed, const Eigen::VectorXd& opening, const Eigen::VectorXd& gap,
                   const ThetaStep& step, double least)
{
    double error = 0;
    for (Eigen::Index point = 0; point < opening.size(); ++point)
    {
        const bool presses = step.contactForce[Dim * point] > least;
        const bool enters = gap[Dim * point] < step.closing[Dim * point];
        if (presses || enters)
        {
            error = std::max(error, std::abs(opening[point] - imposed[point]));
        }
    }
    return error;
}

template<int Dim>
bool solveFlow(ThetaStep& step, const FlowProblem<Dim>& problem, ConeSolution start,
               const NewtonEffort& effort)
{
    constexpr double partOfStep = 1e-3;
    const StepSettings& settings = problem.settings;
    const Relinearisation<Dim>& relinearise = problem.relinearise;
    StepProgram<Dim> program = problem.program;
    for (int round = 0; round <= mostRelinearisations; ++round)
    {
        const auto change = [&] {
            return farthestMotion<Dim>(Eigen::VectorXd(start.displacement - problem.expected),
                                       settings.blockSize);
        };
        const double gapTolerance = relinearise ? std::min(effort.gapTolerance, partOfStep * change()) : 0;
        StepProgram<Dim> flowing = program;
        if (!solveWithGivenGaps(step, flowing, problem, start, {effort.steps, gapTolerance}))
        {
            return false;
        }
        const bool isRight =
            !relinearise || relinearise(step.displacement, step.contactForce, program) <= effort.gapTolerance;
        if (isRight && step.certificate.worst() <= settings.solver.tolerance
            && (!relinearise || keepMomenta(step, program, relinearise)))
        {
            return true;
        }
        if (!relinearise)
        {
            return false;
        }
        start.displacement = step.displacement;
        start.contactForce = step.contactForce;
    }
    return false;
}

template<int Dim>
bool mayGoOn(const StepProgram<Dim>& program, const StepSettings& settings, const ConeSolution& start)
{
    return settings.solver.solver == SolverType::automatic && !program.hasCompliance()
           && !start.contactForce.isZero(0);
}

template<int Dim>
bool goesOnFromLastStep(ThetaStep& step, const FlowProblem<Dim>& problem, const ConeSolution& start,
                        Following following)
{
    const StepProgram<Dim>& program = problem.program;
    const StepSettings& settings = problem.settings;
    if (!mayGoOn(program, settings, start))
    {
        return false;
    }
    const auto isFarFromRest = [&]
    { return !mayRest(program, program.load - applyEquilibrium(program, step.contactForce)); };
    if (followFlow(step, problem, start, following) && isFarFromRest())
    {
        return true;
    }
    if (settings.isFixedPointOnly)
    {
        return false;
    }
    const NewtonEffort effort{
        newtonStepsFromLastStep,
        std::min(settings.contactTolerance, settings.solver.tolerance * settings.blockSize)};
    return solveFlow(step, problem, start, effort) && isFarFromRest();
}

template Eigen::VectorXd dilatancy(const StepProgram<2>& program, const Eigen::VectorXd& closing,
                                   const Eigen::VectorXd& contactForce);
template Eigen::VectorXd openingsOfLeastForces(ThetaStep& step, const FlowProblem<2>& problem);
template double errorOfFlow<2>(const Eigen::VectorXd& imposed, const Eigen::VectorXd& opening,
                               const Eigen::VectorXd& gap, const ThetaStep& step, double least);
template bool solveFlow(ThetaStep& step, const FlowProblem<2>& problem, ConeSolution start,
                        const NewtonEffort& effort);
template bool mayGoOn(const StepProgram<2>& program, const StepSettings& settings, const ConeSolution& start);
template bool goesOnFromLastStep(ThetaStep& step, const FlowProblem<2>& problem, const ConeSolution& start,
                                 Following following);
template Eigen::VectorXd dilatancy(const StepProgram<3>& program, const Eigen::VectorXd& closing,
                                   const Eigen::VectorXd& contactForce);
template Eigen::VectorXd openingsOfLeastForces(ThetaStep& step, const FlowProblem<3>& problem);
template double errorOfFlow<3>(const Eigen::VectorXd& imposed, const Eigen::VectorXd& opening,
                               const Eigen::VectorXd& gap, const ThetaStep& step, double least);
template bool solveFlow(ThetaStep& step, const FlowProblem<3>& problem, ConeSolution start,
                        const NewtonEffort& effort);
template bool goesOnFromLastStep(ThetaStep& step, const FlowProblem<3>& problem, const ConeSolution& start,
                                 Following following);
template void takeOver(ThetaStep& step, StepProgram<2>& program, ConeSolution solution,
                       const StepSettings& settings, double gapTolerance, double backwards);
template void takeOver(ThetaStep& step, StepProgram<3>& program, ConeSolution solution,
                       const StepSettings& settings, double gapTolerance, double backwards);

} // namespace drystone
