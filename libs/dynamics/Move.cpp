// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The stage of a step that gives the blocks their new placements and velocities.
#include "dynamics/Step.h"

namespace drystone
{

template<int Dim>
void move(Step<Dim>& step)
{
    const StageTimer timer(step.motion.stageTimes, Stage::move);
    DynamicState<Dim>& state = step.motion.state;
    StepSolution& solved = step.solved;
    state.velocity = solved.velocity;
    step.velocityAtEnd = advance(state, step.scene.free, solved.result.displacement, step.scheme);
    moveWithSupports(state.placements, step.supports);
    if (solved.flight.size() == 0)
    {
        return;
    }
    state.placements = moved(std::move(state.placements), step.scene.free, solved.flight);
    solved.result.displacement += solved.flight;
    if (solved.result.closing.size() > 0)
    {
        solved.result.closing += applyTransposed(step.program, solved.flight);
    }
    const Eigen::VectorXd change = step.velocityAtEnd - solved.velocity;
    for (int body = 0; body < step.program.bodies; ++body)
    {
        const Eigen::Index row = freedomCount<Dim> * body;
        const bool flies = !solved.flight.segment<freedomCount<Dim>>(row).isZero(0);
        step.keptInFlight += flies ? (step.scheme.theta - 0.5)
                                         * squareOf(step.mass, body, change.segment<freedomCount<Dim>>(row))
                                   : 0;
    }
}

template void move(Step<2>& step);
template void move(Step<3>& step);

} // namespace drystone
