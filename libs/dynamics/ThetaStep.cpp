// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The theta step: its program, and the programs in turn that lead to its solution.
#include "dynamics/ThetaStep.h"

#include "conic/form/Form.h"
#include "dynamics/AcceleratedIteration.h"
#include "dynamics/CoulombFlow.h"
#include "dynamics/FollowedFlow.h"
#include "dynamics/RestingStep.h"

#include <algorithm>

namespace drystone
{
namespace
{

constexpr int maximumPrograms = 60;

/// Of the fixed point from where the blocks were heading; then once more from the associative solution, as if
/// they stuck. Where no sliding motion exists (Painleve's rod) only that leads to the solution. Before it,
/// Newton's method from no forces at all: just above a threshold Coulomb's motion is thousands of times the
/// associative one, near which it is not (a prism that begins to slide in a groove).
constexpr int programsToRestart = 30;

/// Newton's method reaches Coulomb's law exactly, most often from the first program or the second, and is
/// tried after both, in an impact after the first. From the fourth program on the law may have the error
/// below: one point of hundreds that would neither slide nor stick makes steps without an end.
constexpr int programsToExactFlow = 4;
constexpr int newtonSteps = 60; // nearly all tries that end take less than 50

/// Impacts of a wall hit 150 points at once, where Newton's method seldom ends.
constexpr int newtonStepsOfImpact = 20;

/// The error of mu |u_t| may be this share of what the step changes the motion by, and after so many programs
/// the larger one: just above a threshold the fixed point is not reached closer.
constexpr double shareOfStep = 1e-2;
constexpr double largerShareOfStep = 5e-2;
constexpr int programsToLargerShare = 15;
constexpr double nearlySolved = 1000; // times the tolerance

/// \return whether the displacements are those that the contact forces give the blocks
template<int Dim>
bool solveOnce(ThetaStep& step, const StepProgram<Dim>& program, const SolverChoice& solver,
               const ConeSolution& start, SymbolicAnalysis* symbolic)
{
    ConeSolution solution = solveCounted(step, program, solver, start, symbolic);
    ++step.programs;
    step.status = solution.status;
    bool isBalanced = false;
    if (solution.status == SolveStatus::optimal)
    {
        const Eigen::VectorXd outOfBalance = program.load - applyEquilibrium(program, solution.contactForce);
        if (mayRest(program, outOfBalance) && standsStill(step, program, solver, solution, symbolic))
        {
            return false;
        }
        ConeSolution balanced = solution;
        balanced.displacement = displacementUnder(program, outOfBalance);
        const Certificate certificate = certifyOptimal(program, balanced);
        isBalanced = certificate.worst() <= solver.tolerance;
        if (isBalanced)
        {
            step.certificate = certificate;
            solution = std::move(balanced);
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

/// Whether another program would go beyond the work allowed.
template<int Dim>
bool isWorkUsedUp(const StepSettings& settings, const ThetaStep& step, const StepProgram<Dim>& program)
{
    return settings.work
           && settings.work->done
                      + workOf(step.iterations, step.factorisations, program.points(), program.bodies)
                  > settings.work->mostOfAttempt;
}

/// The solver's choice with no more iterations a program than the work left to the step allows for, but as
/// many as an ordinary program takes: the one that crosses the border is brought to its end, not beyond.
template<int Dim>
SolverChoice withinWork(const StepSettings& settings, const ThetaStep& step, const StepProgram<Dim>& program)
{
    constexpr double ordinary = 30;
    SolverChoice choice = settings.solver;
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
Eigen::VectorXd displacementUnder(const StepProgram<Dim>& program, Eigen::VectorXd rows)
{
    for (int body = 0; body < program.bodies; ++body)
    {
        auto own = rows.segment<freedomCount<Dim>>(freedomCount<Dim> * body);
        own = solveBlock(program.inertia[static_cast<std::size_t>(body)], BlockVector<Dim>(own));
    }
    return rows;
}

template<int Dim>
void keepMomenta(ThetaStep& step, StepProgram<Dim>& program, const Relinearisation<Dim>& relinearise)
{
    // Each leaves the square of the last, in effect; in space the part by which a block turns in a step.
    constexpr int mostRounds = Dim == 2 ? 4 : 40;
    constexpr double lastDigits = 1e-15;
    for (int round = 0; round < mostRounds; ++round)
    {
        Eigen::VectorXd displacement =
            displacementUnder(program, program.load - applyEquilibrium(program, step.contactForce));
        const double change = (displacement - step.displacement).lpNorm<Eigen::Infinity>();
        if (change <= lastDigits * displacement.lpNorm<Eigen::Infinity>())
        {
            return;
        }
        step.displacement = std::move(displacement);
        step.closing = applyTransposed(program, step.displacement);
        relinearise(step.displacement, step.contactForce, program);
    }
}

template<int Dim>
void setColumns(StepProgram<Dim>& program, const std::vector<ContactColumns<Dim>>& columns)
{
    program.contacts.clear();
    for (const ContactColumns<Dim>& column : columns)
    {
        program.contacts.push_back({column.block, column.neighbour, column.onBlock, column.onNeighbour});
    }
}

template<int Dim>
StepProgram<Dim> thetaStepProgram(const std::type_identity_t<MassMatrix<Dim>>& mass,
                                  const Eigen::VectorXd& velocity, const Eigen::VectorXd& load,
                                  const std::vector<ContactPoint<Dim>>& points,
                                  const std::vector<ContactColumns<Dim>>& columns,
                                  const std::vector<double>& friction, const ThetaScheme& scheme)
{
    StepProgram<Dim> program;
    program.bodies = static_cast<int>(velocity.size() / freedomCount<Dim>);
    program.friction = friction;
    setColumns(program, columns);
    program.gap = Eigen::VectorXd::Zero(Dim * static_cast<Eigen::Index>(points.size()));
    for (std::size_t point = 0; point < points.size(); ++point)
    {
        program.gap[Dim * static_cast<Eigen::Index>(point)] = points[point].gap;
    }
    const MassMatrix<Dim> inertia = over(mass, scheme.theta * scheme.timeStep * scheme.timeStep);
    for (int body = 0; body < program.bodies; ++body)
    {
        program.inertia.push_back(blockOf(inertia, body));
    }
    program.load = load + scheme.timeStep * times(inertia, velocity);
    return program;
}

template<int Dim>
ThetaStep solveThetaStep(StepProgram<Dim> program, const StepSettings& settings, const StepGuess& guess,
                         const Relinearisation<Dim>& relinearise, SymbolicAnalysis* symbolic)
{
    ThetaStep step;
    step.interior = guess.interior;
    if (program.points() == 0)
    {
        step.displacement = displacementUnder(program, program.load); // free flight
        if constexpr (Dim == 3)
        {
            if (relinearise) // blocks that turn
            {
                step.contactForce.resize(0);
                relinearise(step.displacement, step.contactForce, program);
                keepMomenta(step, program, relinearise);
            }
        }
        step.status = SolveStatus::optimal;
        return step;
    }

    ConeSolution start;
    start.displacement = guess.displacement;
    start.contactForce = guess.contactForce.size() == Dim * program.points()
                             ? guess.contactForce
                             : Eigen::VectorXd::Zero(Dim * program.points());
    Rest rest = restWith(program, start.contactForce);
    step.initialResidual = rest.certificate.worst();
    if (comesToRest(step, program, std::move(rest), settings.solver.tolerance))
    {
        return step;
    }

    start.interior = step.interior;
    if (start.contactForce.lpNorm<Eigen::Infinity>() > 0)
    {
        // Where the forces of the last step would take the blocks: in steady motion that is nearly the
        // solution.
        start.displacement =
            displacementUnder(program, program.load - applyEquilibrium(program, start.contactForce));
    }
    const bool isCoulomb = settings.flowRule == FlowRule::nonAssociative;
    const bool isImpact = settings.kind == StepKind::impact;
    Eigen::VectorXd imposed = Eigen::VectorXd::Zero(program.points());
    if (isCoulomb && guess.displacement.size() > 0)
    {
        imposed = dilatancy(program, applyTransposed(program, guess.displacement), start.contactForce);
    }
    if (relinearise && guess.displacement.size() > 0)
    {
        // About where the blocks are heading, so that what is left is of second order in their acceleration.
        relinearise(guess.displacement, start.contactForce, program);
    }
    const Eigen::VectorXd heading =
        guess.displacement.size() > 0 ? guess.displacement : Eigen::VectorXd::Zero(program.load.size());
    SymbolicAnalysis own;
    SymbolicAnalysis& analysis = symbolic ? *symbolic : own;
    if (isCoulomb && goesOnFromLastStep(step, program, start, heading, settings, relinearise, analysis))
    {
        return step;
    }
    AcceleratedIteration fixedPoint;
    Eigen::VectorXd gap = program.gap; // without the share that is imposed
    for (;;)
    {
        const bool isFromNothing = step.programs == programsToRestart;
        const bool isNewtonsTurn =
            isCoulomb && !program.hasCompliance()
            && (step.programs == 1 || (step.programs == 2 && !isImpact) || isFromNothing);
        if (isNewtonsTurn)
        {
            program.gap = gap;
            if (step.programs == 1 && followFlow(step, program, start, settings, relinearise, analysis))
            {
                return step;
            }
            ConeSolution from = start;
            if (isFromNothing)
            {
                from.displacement = heading;
                from.contactForce.setZero();
            }
            if (solveFlow(step, program, std::move(from), heading, settings, relinearise,
                          {isImpact ? newtonStepsOfImpact : newtonSteps, settings.contactTolerance},
                          analysis))
            {
                return step;
            }
        }
        for (int point = 0; isCoulomb && point < program.points(); ++point)
        {
            program.gap[Dim * point] = gap[Dim * point] + imposed[point];
        }
        const bool isBalanced =
            solveOnce(step, program, withinWork(settings, step, program), start, symbolic);
        // Only the last program of Coulomb's law has to be solved to the tolerance.
        const bool isSolved = step.status == SolveStatus::optimal;
        if (!isSolved
            && (!isCoulomb || step.certificate.worst() > nearlySolved * settings.solver.tolerance
                || step.programs == maximumPrograms))
        {
            return step;
        }
        start.displacement = step.displacement;
        start.contactForce = step.contactForce;
        start.interior = step.interior;
        bool stands = isSolved;
        if (isCoulomb)
        {
            const Eigen::VectorXd opening = dilatancy(program, step.closing, step.contactForce);
            const double least = settings.solver.tolerance * step.contactForce.lpNorm<Eigen::Infinity>();
            const double change = errorOfFlow<Dim>(imposed, opening, gap, step, least);
            const double exact = std::max(1e-12 * settings.blockSize,
                                          10 * settings.solver.tolerance * opening.lpNorm<Eigen::Infinity>());
            // Otherwise a small part of what the step itself does: with steps so short that gravity moves a
            // block by less than some length, any force at all would do. Nor less than what a program
            // certified to its tolerance determines.
            const double moved =
                (step.displacement
                 - (guess.displacement.size() > 0 ? guess.displacement
                                                  : Eigen::VectorXd::Zero(step.displacement.size())))
                    .lpNorm<Eigen::Infinity>();
            const double share = step.programs < programsToLargerShare ? shareOfStep : largerShareOfStep;
            const double certified =
                settings.solver.tolerance
                * std::max(step.displacement.lpNorm<Eigen::Infinity>(), gap.lpNorm<Eigen::Infinity>());
            const bool isExact = !isImpact
                                 && (step.programs < programsToExactFlow
                                     || (!isBalanced && step.programs < programsToLargerShare));
            stands = stands && change <= (isExact ? exact : std::max({exact, certified, share * moved}));
            step.flowError = change;
            imposed = fixedPoint.next(imposed, opening);
            if (step.programs == programsToRestart)
            {
                fixedPoint = {};
                imposed.setZero();
            }
        }
        if (relinearise)
        {
            program.gap = gap;
            stands = relinearise(step.displacement, step.contactForce, program) <= settings.contactTolerance
                     && stands;
            gap = program.gap;
        }
        if (stands)
        {
            if (relinearise && isBalanced)
            {
                keepMomenta(step, program, relinearise);
            }
            return step;
        }
        if (step.programs == maximumPrograms || isWorkUsedUp(settings, step, program))
        {
            step.status = SolveStatus::notConverged;
            return step;
        }
    }
}

template<int Dim>
Eigen::VectorXd advance(DynamicState<Dim>& state, const std::vector<int>& free,
                        const Eigen::VectorXd& displacement, const ThetaScheme& scheme)
{
    state.placements = moved(std::move(state.placements), free, displacement);
    const Eigen::VectorXd mean = displacement / scheme.timeStep;
    Eigen::VectorXd velocity = (mean - (1 - scheme.theta) * state.velocity) / scheme.theta;
    state.velocity = turnedWithBlocks<Dim>(velocity, displacement);
    state.time += scheme.timeStep;
    return velocity;
}

template<int Dim>
StepEnergy stepEnergy(const ThetaStep& step, const MassMatrix<Dim>& mass, const Eigen::VectorXd& load,
                      const Eigen::VectorXd& velocityBefore, const Eigen::VectorXd& velocityAfter,
                      const ThetaScheme& scheme)
{
    StepEnergy energy;
    energy.loadWork = load.dot(step.displacement);
    const Eigen::VectorXd change = velocityAfter - velocityBefore;
    energy.algorithmicLoss = (scheme.theta - 0.5) * times(mass, change).dot(change);
    for (Eigen::Index row = 0; row < step.closing.size(); row += Dim)
    {
        energy.normalLoss += step.contactForce[row] * step.closing[row];
        energy.frictionLoss +=
            step.contactForce.segment<Dim - 1>(row + 1).dot(step.closing.segment<Dim - 1>(row + 1));
    }
    return energy;
}

template Eigen::VectorXd displacementUnder(const StepProgram<2>& program, Eigen::VectorXd rows);
template void keepMomenta(ThetaStep& step, StepProgram<2>& program, const Relinearisation<2>& relinearise);
template void setColumns(StepProgram<2>& program, const std::vector<ContactColumns<2>>& columns);
template StepProgram<2> thetaStepProgram<2>(const MassMatrix<2>& mass, const Eigen::VectorXd& velocity,
                                            const Eigen::VectorXd& load,
                                            const std::vector<ContactPoint<2>>& points,
                                            const std::vector<ContactColumns<2>>& columns,
                                            const std::vector<double>& friction, const ThetaScheme& scheme);
template ThetaStep solveThetaStep(StepProgram<2> program, const StepSettings& settings,
                                  const StepGuess& guess, const Relinearisation<2>& relinearise,
                                  SymbolicAnalysis* symbolic);
template Eigen::VectorXd advance(DynamicState<2>& state, const std::vector<int>& free,
                                 const Eigen::VectorXd& displacement, const ThetaScheme& scheme);
template StepEnergy stepEnergy(const ThetaStep& step, const MassMatrix<2>& mass, const Eigen::VectorXd& load,
                               const Eigen::VectorXd& velocityBefore, const Eigen::VectorXd& velocityAfter,
                               const ThetaScheme& scheme);
template Eigen::VectorXd displacementUnder(const StepProgram<3>& program, Eigen::VectorXd rows);
template void keepMomenta(ThetaStep& step, StepProgram<3>& program, const Relinearisation<3>& relinearise);
template void setColumns(StepProgram<3>& program, const std::vector<ContactColumns<3>>& columns);
template StepProgram<3> thetaStepProgram<3>(const MassMatrix<3>& mass, const Eigen::VectorXd& velocity,
                                            const Eigen::VectorXd& load,
                                            const std::vector<ContactPoint<3>>& points,
                                            const std::vector<ContactColumns<3>>& columns,
                                            const std::vector<double>& friction, const ThetaScheme& scheme);
template ThetaStep solveThetaStep(StepProgram<3> program, const StepSettings& settings,
                                  const StepGuess& guess, const Relinearisation<3>& relinearise,
                                  SymbolicAnalysis* symbolic);
template Eigen::VectorXd advance(DynamicState<3>& state, const std::vector<int>& free,
                                 const Eigen::VectorXd& displacement, const ThetaScheme& scheme);
template StepEnergy stepEnergy(const ThetaStep& step, const MassMatrix<3>& mass, const Eigen::VectorXd& load,
                               const Eigen::VectorXd& velocityBefore, const Eigen::VectorXd& velocityAfter,
                               const ThetaScheme& scheme);

} // namespace drystone
