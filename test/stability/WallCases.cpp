// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Walls that collapse: many blocks, many impacts in each step.
#include "Suite.h"

#include "contact/Penetration.h"
#include "dynamics/Scenes.h"
#include "texture/RunningBond.h"
#include "texture/Supports.h"

#include <fmt/format.h>

namespace drystone
{
namespace
{

/// As many courses as it is units long, on the ground, pushed by 1 g.
Outcome collapse(SolverType solver, FlowRule flowRule, int size, int steps)
{
    RunningBond bond;
    bond.length = size;
    bond.courses = size;
    bond.firstCourse = FirstCourse::full;
    Assembly<2> assembly = makeAssembly(bond);
    addGround(assembly, "ground", {});
    const double tolerance = solver == SolverType::gaussSeidel ? 1e-3 : 1e-6;
    DynamicCase<2> scene =
        scenes::sceneOf(std::move(assembly), {.mu = 0.65, .flowRule = flowRule, .tolerance = tolerance});
    scene.solution.solver = solver;
    scenes::shake(scene, std::make_shared<ConstantAcceleration>(-g));
    Motion<2> motion = startMotion(scene, stateAtRest(scene.assembly));
    Outcome outcome;
    for (int step = 0; step < steps; ++step)
    {
        if (!advance(scene, motion, 0.002) || !motion.state.velocity.allFinite())
        {
            outcome.broken = fmt::format("step {} not solved", step);
            outcome.figure = std::nan("");
            return outcome;
        }
        if (!(scenes::relativeImbalance(motion.energy) < 1e-9))
        {
            outcome.broken = fmt::format("energy out of balance in step {}", step);
        }
    }
    outcome.note = fmt::format("{} blocks, {} steps", motion.state.velocity.size() / 3, steps);
    outcome.figure = penetration(scene.assembly, motion.state.placements).depth / scene.blockSize;
    return outcome;
}

} // namespace

std::vector<StabilityCase> wallCases()
{
    const std::string hard = "all joints open and slide at once, and each block meets its neighbours anew";
    const std::string measure = "deepest overlap, over the size of a block";
    return {{"wall_68", hard, measure, 1e-5, 1e-3, motionSolvers(),
             [](SolverType solver) { return collapse(solver, FlowRule::nonAssociative, 8, 12); }},
            // The paper's flow rule, 52 minutes on a busy machine: Coulomb's law would take hours.
            {"wall_25680",
             hard,
             measure,
             1e-5,
             1e-3,
             {SolverType::automatic},
             [](SolverType solver) { return collapse(solver, FlowRule::associative, 160, 100); },
             Length::nightly}};
}

} // namespace drystone
