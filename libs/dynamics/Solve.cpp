// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The stage of a step that solves its program, and what the others need of a solution.
#include "dynamics/FollowedFlow.h"
#include "dynamics/HeldBlocks.h"
#include "dynamics/Step.h"
#include "dynamics/StickingStep.h"

#include <algorithm>

namespace drystone
{

template<int Dim>
void beginAgain(Step<Dim>& step)
{
    step.solved = {};
    step.solved.velocity = step.motion.state.velocity;
    step.program.load = step.loadAtStart;
    step.guess.displacement = step.scheme.timeStep * step.solved.velocity;
}

namespace
{

/// By the flow rule of the settings. \param partOfGaps of the error allowed in gaps, where all blocks are
/// solved for: the settings then have it, and the caller restores them
template<int Dim>
void solveByFlowRule(Step<Dim>& step, double partOfGaps = 1)
{
    StepSolution& solved = step.solved;
    if (solveAwake(step))
    {
        solved.isSolved = true;
        return;
    }
    step.settings.contactTolerance *= partOfGaps;
    StepGuess guess = step.guess;
    if (step.nearForce.size() > 0 && followsFlow(step.settings))
    {
        guess.contactForce = step.nearForce;
    }
    solved.result =
        solveThetaStep(step.program, step.settings, guess, step.relinearise, step.motion.symbolic.get());
    solved.isSolved = solved.result.status == SolveStatus::optimal;
    countWork(step, solved.result.iterations, solved.result.factorisations, solved.result.programs);
}

/// By the associative law, if that is what Coulomb's gives as well. \return whether it is
template<int Dim>
bool solveWithoutSliding(Step<Dim>& step)
{
    const StepSettings settings = step.settings;
    const double done = step.motion.work.done;
    step.settings.flowRule = FlowRule::associative;
    step.settings.contactTolerance *= partOfGapWithLess;
    // Drums that a blow has parted are one body again as soon as their gaps are less than bodies may keep.
    constexpr double partWhereBlocksMayJoin = Dim == 2 ? 0.03 : 1;
    solveByFlowRule(step, partWhereBlocksMayJoin);
    step.settings = settings;
    if (step.solved.isSolved && sticks(step))
    {
        return true;
    }
    forgetBodies(step);
    step.motion.work.done = done; // work that led to nothing takes none from the step
    return false;
}

} // namespace

template<int Dim>
void solve(Step<Dim>& step)
{
    const StageTimer timer(step.motion.stageTimes, Stage::solve);
    StepSolution& solved = step.solved;
    step.workBeforeSolution = step.motion.work.done;
    const bool mayBeStuck = mayStick(step);
    const bool isTried = mayBeStuck && !step.motion.slides;
    solved.sticks = isTried && solveWithoutSliding(step);
    if (!solved.sticks)
    {
        solveByFlowRule(step);
        solved.slides = isTried || (mayBeStuck && solved.isSolved && !hardlySlides(step));
    }
}

template<int Dim>
void countWork(Step<Dim>& step, int iterations, int factorisations, int programs)
{
    StepWork& work = step.motion.work;
    work.mostPoints = std::max(work.mostPoints, step.program.points());
    work.done += workOf(iterations, factorisations, step.program.points(), step.program.bodies);
    StepResiduals& attempt = step.motion.attempt;
    attempt.iterations += iterations;
    attempt.factorisations += factorisations;
    attempt.programs += programs;
}

template<int Dim>
Eigen::VectorXd openingAtEnd(const Step<Dim>& step, const Eigen::VectorXd& displacement,
                             const Eigen::VectorXd& contactForce)
{
    StepProgram<Dim> program = step.program;
    if (step.relinearise)
    {
        step.relinearise(displacement, contactForce, program);
    }
    return program.gap - applyTransposed(program, displacement);
}

template void beginAgain(Step<2>& step);
template void solve(Step<2>& step);
template void countWork(Step<2>& step, int iterations, int factorisations, int programs);
template Eigen::VectorXd openingAtEnd(const Step<2>& step, const Eigen::VectorXd& displacement,
                                      const Eigen::VectorXd& contactForce);
template void beginAgain(Step<3>& step);
template void solve(Step<3>& step);
template void countWork(Step<3>& step, int iterations, int factorisations, int programs);
template Eigen::VectorXd openingAtEnd(const Step<3>& step, const Eigen::VectorXd& displacement,
                                      const Eigen::VectorXd& contactForce);

} // namespace drystone
