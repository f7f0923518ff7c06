// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The stage of a step that solves its program, and what the others ask of a solution.
#include "dynamics/Step.h"

#include <algorithm>

namespace drystone
{

void beginAgain(Step& step)
{
    step.solved = {};
    step.solved.velocity = step.motion.state.velocity;
    step.program.load = step.loadAtStart;
    step.guess.displacement = step.scheme.timeStep * step.solved.velocity;
}

void solve(Step& step)
{
    const StageTimer timer(step.motion.stageTimes, Stage::solve);
    StepSolution& solved = step.solved;
    solved.result =
        solveThetaStep(step.program, step.settings, step.guess, step.relinearise, step.motion.symbolic.get());
    solved.isSolved = solved.result.status == SolveStatus::optimal;
    countWork(step, solved.result.iterations, solved.result.factorisations, solved.result.programs);
}

void countWork(Step& step, int iterations, int factorisations, int programs)
{
    StepWork& work = step.motion.work;
    work.mostPoints = std::max(work.mostPoints, step.program.points());
    work.done += workOf(iterations, factorisations, step.program.points(), step.program.bodies);
    StepResiduals& attempt = step.motion.attempt;
    attempt.iterations += iterations;
    attempt.factorisations += factorisations;
    attempt.programs += programs;
}

Eigen::VectorXd openingAtEnd(const Step& step, const Eigen::VectorXd& displacement,
                             const Eigen::VectorXd& contactForce)
{
    PlaneConeProgram program = step.program;
    if (step.relinearise)
    {
        step.relinearise(displacement, contactForce, program);
    }
    return program.gap - applyTransposed(program, displacement);
}

} // namespace drystone
