// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The stage of a step that gives the blocks their new placements and velocities.
#include "dynamics/Step.h"

namespace drystone
{

void move(Step& step)
{
    const StageTimer timer(step.motion.stageTimes, Stage::move);
    DynamicState& state = step.motion.state;
    StepSolution& solved = step.solved;
    state.velocity = solved.velocity;
    advance(state, step.scene.free, solved.result.displacement, step.scheme);
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
    const Eigen::VectorXd change = state.velocity - solved.velocity;
    for (Eigen::Index row = 0; row < change.size(); row += 3)
    {
        const bool flies = !solved.flight.segment<3>(row).isZero(0);
        step.keptInFlight +=
            flies ? (step.scheme.theta - 0.5)
                        * change.segment<3>(row).cwiseAbs2().dot(step.scene.mass.segment<3>(row))
                  : 0;
    }
}

} // namespace drystone
