// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Hard cases of motion: single blocks and towers. In each of them, whatever is measured, every step must be
/// solved, nothing may be NaN, blocks may not enter each other, and the ledger of energy must balance.
#include "DisturbedAssembly.h"
#include "Suite.h"

#include "contact/Penetration.h"
#include "dynamics/Scenes.h"
#include "ensembles/References.h"
#include "texture/Arch.h"

#include <Eigen/Geometry>
#include <fmt/format.h>

#include <numbers>
#include <random>
#include <span>

namespace drystone
{
namespace
{

using scenes::rectangle;

/// Tolerances that each solver is for.
DynamicCase<2> sceneFor(SolverType solver, Assembly<2> assembly, scenes::Settings settings = {})
{
    settings.tolerance = solver == SolverType::gaussSeidel     ? 1e-4
                         : solver == SolverType::interiorPoint ? 1e-10
                                                               : 1e-11;
    DynamicCase<2> scene = scenes::sceneOf(std::move(assembly), settings);
    scene.solution.solver = solver;
    return scene;
}

/// A run that watches over what must always hold. Stops at the first thing that does not.
struct Watched
{
    const DynamicCase<2>& scene;
    Motion<2> motion;
    Outcome& outcome;
    double deepest; ///< overlap allowed [m]
    bool holds = true;
    double largestImbalance = 1e-9; ///< of energy allowed, relative

    Watched(const DynamicCase<2>& watched, DynamicState<2> start, Outcome& result)
        : scene(watched),
          motion(startMotion(watched, std::move(start))),
          outcome(result),
          deepest((watched.solution.solver == SolverType::gaussSeidel ? 1e-3 : 1e-6) * watched.blockSize)
    {
    }

    Watched(const DynamicCase<2>& watched, Outcome& result)
        : Watched(watched, stateAtRest(watched.assembly), result)
    {
    }

    bool fails(const std::string& what)
    {
        if (holds)
        {
            outcome.broken = fmt::format("{} at {:g} s", what, motion.state.time);
            outcome.figure = std::nan("");
            holds = false;
        }
        return false;
    }

    /// \return whether all still holds
    bool step(double timeStep)
    {
        if (!holds)
        {
            return false;
        }
        if (!advance(scene, motion, timeStep))
        {
            return fails(fmt::format("a step not solved to its tolerance (certificate {:.1e} {:.1e} {:.1e})",
                                     motion.attempt.primalResidual, motion.attempt.dualResidual,
                                     motion.attempt.dualityGap));
        }
        if (!motion.state.velocity.allFinite() || !std::isfinite(motion.energy.potential))
        {
            return fails("NaN");
        }
        if (!(scenes::relativeImbalance(motion.energy) < largestImbalance))
        {
            return fails(
                fmt::format("energy out of balance by {:.1e}", scenes::relativeImbalance(motion.energy)));
        }
        return true;
    }

    /// To look at now and then: it takes longer than a step.
    bool keepsBlocksApart()
    {
        const double depth = penetration(scene.assembly, motion.state.placements).depth;
        return depth <= deepest || fails(fmt::format("blocks overlap by {:.1e} m", depth));
    }

    bool until(double time, double timeStep)
    {
        while (motion.state.time < time - 0.5 * timeStep && step(timeStep))
        {
        }
        return keepsBlocksApart();
    }

    double largestDisplacement() const
    {
        double largest = 0;
        for (const Placement<2>& placement : motion.state.placements)
        {
            largest = std::max({largest, placement.translation.norm(), std::abs(placement.rotation)});
        }
        return largest;
    }
};

Assembly<2> onGround(const std::vector<Block<2>>& blocks)
{
    Assembly<2> assembly = scenes::ground(-8, 8);
    assembly.blocks.insert(assembly.blocks.end(), blocks.begin(), blocks.end());
    return assembly;
}

constexpr std::array bothRules{FlowRule::associative, FlowRule::nonAssociative};

// Sliding.

DynamicState<2> movingAlongX(const DynamicCase<2>& scene, double velocity)
{
    DynamicState<2> state = stateAtRest(scene.assembly);
    state.velocity[0] = velocity;
    return state;
}

Outcome impulsiveSlide(SolverType solver)
{
    Outcome outcome;
    const DynamicCase<2> scene = sceneFor(solver, onGround({rectangle(0, 0, 1, 0.4)}));
    Watched run(scene, movingAlongX(scene, 1), outcome);
    double highest = 0;
    while (run.motion.state.time < 0.2 && run.step(5e-4))
    {
        highest = std::max(highest, std::abs(run.motion.state.placements[1].translation.y()));
    }
    worsen(outcome, std::abs(run.motion.state.placements[1].translation.x() / 0.0849473 - 1));
    outcome.note = fmt::format("hops {:.0e} m", highest);
    if (!(highest < (solver == SolverType::gaussSeidel ? 1e-3 : 1e-9)))
    {
        run.fails("the block hops");
    }
    return outcome;
}

Outcome impulsiveSlideAssociative(SolverType solver)
{
    Outcome outcome;
    for (const double timeStep : {1e-4, 1e-6})
    {
        const DynamicCase<2> scene =
            sceneFor(solver, onGround({rectangle(0, 0, 1, 0.4)}), {.flowRule = FlowRule::associative});
        Watched run(scene, movingAlongX(scene, 1), outcome);
        run.step(timeStep);
        worsen(outcome, std::abs(run.motion.energy.kinetic / run.motion.energy.opening - 1 / (1 + 0.36)));
    }
    return outcome;
}

Outcome steadySlide(SolverType solver)
{
    Outcome outcome;
    for (const double timeStep : {1e-3, 2.5e-4})
    {
        const DynamicCase<2> scene =
            sceneFor(solver, onGround({rectangle(0, 0, 1, 0.4)}), {.flowRule = FlowRule::associative});
        Watched run(scene, movingAlongX(scene, 1), outcome);
        run.until(0.1, timeStep);
        const double hover = 0.6 * timeStep * run.motion.state.velocity[0];
        worsen(outcome, std::abs(run.motion.state.placements[1].translation.y() / hover - 1));
    }
    return outcome;
}

/// A block between two fixed walls that it fits exactly.
Assembly<2> slot()
{
    Assembly<2> assembly;
    assembly.supports = {{"walls", "blocks"}};
    for (const double left : {-1.0, 1.0})
    {
        assembly.blocks.push_back(rectangle(left, -1, 1, 3));
        assembly.blocks.back().support = 0;
    }
    assembly.blocks.push_back(rectangle(0, 0, 1, 1));
    return assembly;
}

/// Between two fixed walls that it fits exactly a block may fall freely or hang: Coulomb's law allows either.
Outcome exactFitSlot(SolverType solver)
{
    Outcome outcome;
    const Assembly<2> assembly = slot();
    for (const double velocity : {0.0, -0.5})
    {
        const DynamicCase<2> scene = sceneFor(solver, assembly);
        DynamicState<2> start = stateAtRest(scene.assembly);
        start.velocity[1] = velocity;
        Watched run(scene, start, outcome);
        run.until(0.1, 1e-3);
        const Placement<2>& block = run.motion.state.placements[2];
        const double free = velocity * 0.1 - 0.5 * g * 0.01;
        outcome.note +=
            fmt::format("{}many solutions: from {:g} m/s it falls {:.4f} of {:.4f} m",
                        outcome.note.empty() ? "" : "; ", velocity, -block.translation.y(), -free);
        worsen(outcome, std::max({0.0, block.translation.y(), free - 0.005 - block.translation.y(),
                                  std::abs(block.translation.x()), std::abs(block.rotation)}));
    }
    return outcome;
}

/// The associative law never lets it fall: to slide it would have to open both joints.
Outcome exactFitSlotAssociative(SolverType solver)
{
    Outcome outcome;
    const Assembly<2> assembly = slot();
    const DynamicCase<2> scene = sceneFor(solver, assembly, {.flowRule = FlowRule::associative});
    Watched run(scene, outcome);
    run.until(0.1, 1e-3);
    worsen(outcome, run.largestDisplacement());
    return outcome;
}

/// mu of almost nothing and of much: a base that accelerates leaves the block behind, or takes it along.
Outcome frictionInMotion(SolverType solver, double mu)
{
    Outcome outcome;
    const double timeStep = 1e-3;
    for (const FlowRule flowRule : bothRules)
    {
        DynamicCase<2> scene =
            sceneFor(solver, onGround({rectangle(0, 0, 1, 0.5)}), {.mu = mu, .flowRule = flowRule});
        const double acceleration = mu < 1 ? 0.5 * g : 1.2 * g; // tips from 2 g on
        scenes::shake(scene, std::make_shared<ConstantAcceleration>(acceleration));
        Watched run(scene, outcome);
        run.until(0.1, timeStep);
        // Backward Euler: the sum of 1 to n steps.
        const double exact = mu < 1 ? -0.5 * acceleration * 0.1 * (0.1 + timeStep) : 0;
        worsen(outcome, std::abs(run.motion.state.placements[1].translation.x() - exact));
    }
    return outcome;
}

// Impact.

constexpr double slender = 0.24497866312686414; // atan(0.5/2)

/// Stands on one corner, turned by `rotation`.
DynamicState<2> onCorner(const DynamicCase<2>& scene, double rotation, double angularVelocity)
{
    DynamicState<2> state = stateAtRest(scene.assembly);
    const Vector<2> arm(std::copysign(0.25, rotation), 1);
    const Vector<2> turned = Eigen::Rotation2Dd(rotation) * arm;
    state.placements[1] = {turned - arm, rotation};
    state.velocity << -angularVelocity * turned.y(), angularVelocity * turned.x(), angularVelocity;
    return state;
}

Assembly<2> rockingBlock()
{
    return onGround({rectangle(-0.25, 0, 0.5, 2)});
}

Outcome impactAtEveryPhase(SolverType solver, double theta)
{
    const double timeStep = theta == 1 ? 1e-4 : 5e-5;
    const double frequency2 = 3 * g / (4 * std::hypot(0.25, 1));
    const auto upright = [&](double rotation, double velocity)
    {
        return std::sqrt(velocity * velocity
                         + 2 * frequency2 * (std::cos(slender - std::abs(rotation)) - std::cos(slender)));
    };
    const double housner = 1 - 1.5 * std::pow(std::sin(slender), 2);
    Outcome outcome;
    for (const FlowRule flowRule : bothRules)
    {
        const DynamicCase<2> scene =
            sceneFor(solver, rockingBlock(), {.theta = theta, .mu = 1, .flowRule = flowRule});
        for (const double side : {1, -1})
        {
            for (int phase = 0; phase < 20; ++phase)
            {
                const double rotation = side * timeStep * (3 + phase / 20.0);
                Watched run(scene, onCorner(scene, rotation, -side), outcome);
                while (run.motion.state.placements[1].rotation * side > -5 * timeStep
                       && run.motion.state.time < 1 && run.step(timeStep))
                {
                }
                const double after =
                    upright(run.motion.state.placements[1].rotation, run.motion.state.velocity[2]);
                worsen(outcome, std::abs(after / upright(rotation, 1) - housner));
            }
        }
    }
    return outcome;
}

/// Two squares on their corners, one above the other: falls straight on its corner.
Outcome cornerOnCorner(SolverType solver, double aside, std::span<const FlowRule> flowRules)
{
    Outcome outcome;
    Assembly<2> assembly;
    assembly.supports = {{"base", "blocks"}};
    assembly.blocks.push_back({{{0, -1}, {1, 0}, {0, 1}, {-1, 0}}, 1, 0});
    assembly.blocks.push_back({{{aside, 1.01}, {1 + aside, 2.01}, {aside, 3.01}, {-1 + aside, 2.01}}, 1, -1});
    for (const FlowRule flowRule : flowRules)
    {
        const DynamicCase<2> scene = sceneFor(solver, assembly, {.flowRule = flowRule});
        Watched run(scene, outcome);
        double energy = 0;
        while (run.motion.state.time < 0.5 && run.step(1e-3) && run.keepsBlocksApart())
        {
            const double next = run.motion.energy.kinetic + run.motion.energy.potential;
            worsen(outcome, (next - energy) / (scene.mass[0] * g));
            energy = next;
        }
    }
    return outcome;
}

/// What is measured is the impulse that stops the rod.
Outcome painleve(SolverType solver)
{
    Outcome outcome;
    const scenes::PainlevesRod rod = scenes::painlevesRod();
    for (const FlowRule flowRule : bothRules)
    {
        const double timeStep = 1e-5;
        const DynamicCase<2> scene = sceneFor(solver, onGround({rod.block}), {.mu = 2, .flowRule = flowRule});
        Watched run(scene, movingAlongX(scene, -1), outcome);
        run.step(timeStep);
        double normal = 0;
        for (const Vector<2>& force : run.motion.contactForces)
        {
            normal += force.x();
        }
        worsen(outcome, std::abs(normal * timeStep / scene.mass[0] - rod.impulse.y()));
        for (int step = 0; step < 20; ++step)
        {
            run.step(timeStep);
        }
        run.keepsBlocksApart();
    }
    return outcome;
}

/// Infinitely many bounces in finite time.
Outcome zenoBounce(SolverType solver)
{
    Outcome outcome;
    const DynamicCase<2> scene =
        sceneFor(solver, onGround({rectangle(0, 0, 1, 0.4)}), {.theta = 0.5, .restitution = 0.8});
    DynamicState<2> start = stateAtRest(scene.assembly);
    start.placements[1].translation.y() = 1;
    Watched run(scene, start, outcome);
    double atRest = 0;
    while (run.motion.state.time < 4.5 && run.step(2.5e-4))
    {
        if (run.motion.state.velocity.norm() > 1e-6)
        {
            atRest = run.motion.state.time;
        }
    }
    worsen(outcome, std::abs(atRest / bouncingTime(1, 0.8) - 1));
    return outcome;
}

/// One whole sine of 0.5 s: the block overturns from 0.60626 g on, but not between 1.54692 and 1.67415 g.
Outcome safeIsland(SolverType solver)
{
    Outcome outcome;
    const std::pair<double, bool> amplitudes[] = {{0.594, false}, {0.625, true}, {1.53, true},
                                                  {1.56, false},  {1.66, false}, {1.69, true}};
    for (const auto& [amplitude, overturns] : amplitudes)
    {
        for (const double direction : {1, -1})
        {
            DynamicCase<2> scene = sceneFor(solver, rockingBlock(), {.theta = 0.5, .mu = 10});
            scenes::shake(scene,
                          std::make_shared<SinePulse>(PulseShape{direction * amplitude * g, 0.5, 0}, 2.0));
            Watched run(scene, outcome);
            const Placement<2>& block = run.motion.state.placements[1];
            // After the pulse it stands for sure once its energy is too little to lift its mass centre over
            // the corner.
            const double barrier = scene.mass[0] * g * (std::hypot(0.25, 1) - 1);
            const EnergyLedger& energy = run.motion.energy;
            while (std::abs(block.rotation) < 1 && run.motion.state.time < 10
                   && !(run.motion.state.time > 0.5 && std::abs(block.rotation) < slender
                        && energy.kinetic + energy.potential < barrier)
                   && run.step(5e-4))
            {
            }
            if ((std::abs(block.rotation) >= 1) != overturns)
            {
                outcome.note += fmt::format("wrong at {} g; ", direction * amplitude);
                worsen(outcome, outcome.figure + 1);
            }
        }
    }
    return outcome;
}

// Steps and scales.

/// No step at all: the state stays as it is, or the step is refused.
Outcome noStep(SolverType solver)
{
    Outcome outcome;
    const DynamicCase<2> scene = sceneFor(solver, onGround({rectangle(0, 0, 1, 0.4)}));
    DynamicState<2> start = stateAtRest(scene.assembly);
    start.velocity << 0.3, 0, 0.1;
    Motion<2> motion = startMotion(scene, start);
    outcome.note = advance(scene, motion, 0) ? "taken" : "refused";
    worsen(outcome, (motion.state.velocity - start.velocity).norm());
    worsen(outcome, motion.state.placements[1].translation.norm());
    return outcome;
}

/// At rest, and in free fall.
Outcome stepOf(SolverType solver, double timeStep)
{
    Outcome outcome;
    for (const double height : {0.0, 200.0})
    {
        const DynamicCase<2> scene = sceneFor(solver, onGround({rectangle(0, height, 1, 0.4)}));
        Watched run(scene, outcome);
        for (int step = 0; step < 3; ++step)
        {
            run.step(timeStep);
        }
        const double exact = height > 0 ? -g * timeStep * timeStep * 6 : 0; // 1 + 2 + 3 steps
        worsen(outcome,
               std::abs(run.motion.state.placements[1].translation.y() - exact) / (g * timeStep * timeStep));
    }
    return outcome;
}

Assembly<2> leaningTower(double scale)
{
    Assembly<2> assembly = scenes::ground(-6 * scale, 6 * scale, scale);
    const double left[] = {-0.25, -0.21, -0.15, -0.22, -0.18};
    for (int i = 0; i < 5; ++i)
    {
        assembly.blocks.push_back(
            rectangle(scale * left[i], scale * 0.4 * i, scale * (i % 2 ? 0.4 : 0.5), scale * 0.4));
    }
    return assembly;
}

/// As AHundredThousandSteps... of test/dynamics.
Outcome rest(SolverType solver, long steps)
{
    Outcome outcome;
    for (const FlowRule flowRule : bothRules)
    {
        DynamicCase<2> scene = sceneFor(solver, leaningTower(1), {.flowRule = flowRule});
        Watched run(scene, outcome);
        for (long step = 0; step < steps && run.step(1e-3); ++step)
        {
        }
        worsen(outcome, run.largestDisplacement());
    }
    return outcome;
}

/// A tower thrown over by a pulse, in another unit of length; times grow with the root of lengths (Froude).
std::vector<double> thrownTower(SolverType solver, double scale, double theta, FlowRule flowRule,
                                Outcome& outcome, double density = 1800)
{
    const double timeScale = std::sqrt(scale);
    DynamicCase<2> scene =
        sceneFor(solver, leaningTower(scale), {.theta = theta, .flowRule = flowRule, .density = density});
    scenes::shake(scene, std::make_shared<RectangularPulse>(PulseShape{0.6 * g, 0.4 * timeScale, 0}));
    Watched run(scene, outcome);
    std::vector<double> places;
    for (int step = 0; step < 250 && run.step(2e-3 * timeScale); ++step)
    {
        if (step % 10 == 9)
        {
            run.keepsBlocksApart();
            for (const Placement<2>& placement : run.motion.state.placements)
            {
                places.insert(places.end(), {placement.translation.x() / scale,
                                             placement.translation.y() / scale, placement.rotation});
            }
        }
    }
    return places;
}

/// In other units of length and of force.
Outcome scaledFall(SolverType solver, double lengths, double forces)
{
    Outcome outcome;
    const auto metres = thrownTower(solver, 1, 1, FlowRule::nonAssociative, outcome);
    const auto other = thrownTower(solver, lengths, 1, FlowRule::nonAssociative, outcome, 1800 * forces);
    for (std::size_t i = 0; i < std::min(metres.size(), other.size()); ++i)
    {
        worsen(outcome, std::abs(metres[i] - other[i]));
    }
    return outcome;
}

Outcome fallWithTheta(SolverType solver, double theta)
{
    Outcome outcome;
    for (const FlowRule flowRule : bothRules)
    {
        const auto path = thrownTower(solver, 1, theta, flowRule, outcome);
        worsen(outcome, path.empty() ? std::nan("") : 0);
    }
    return outcome;
}

// Geometry.

/// A block `gap` above the ground.
Outcome nearlyTouching(SolverType solver, double gap)
{
    Outcome outcome;
    for (const FlowRule flowRule : bothRules)
    {
        const DynamicCase<2> scene =
            sceneFor(solver, onGround({rectangle(0, gap, 1, 0.4)}), {.flowRule = flowRule});
        Watched run(scene, outcome);
        run.until(0.05, 1e-3);
        worsen(outcome, run.largestDisplacement());
    }
    return outcome;
}

/// A block whose lower face is not quite parallel to the ground: it settles by turning, or stays.
Outcome outOfParallel(SolverType solver, double angle)
{
    Outcome outcome;
    for (const FlowRule flowRule : bothRules)
    {
        const DynamicCase<2> scene =
            sceneFor(solver, onGround({{{{-0.5, 0}, {0.5, angle}, {0.5, 0.5}, {-0.5, 0.5}}, 1, -1}}),
                     {.flowRule = flowRule});
        Watched run(scene, outcome);
        run.until(0.1, 1e-3);
        worsen(outcome, run.largestDisplacement() / (angle + 1e-9));
        worsen(outcome, run.motion.state.velocity.norm());
    }
    return outcome;
}

Outcome slivers(SolverType solver)
{
    Outcome outcome;
    const double s = 1e-4;
    const DynamicCase<2> scene = sceneFor(
        solver, onGround({rectangle(0, 0, 1, 0.5), rectangle(1, 0, s, 0.5), rectangle(1 + s, 0, 1, 0.5),
                          rectangle(0, 0.5, 2 + s, s), rectangle(0.5, 0.5 + s, 1, 0.5)}));
    Watched run(scene, outcome);
    run.until(0.1, 2e-3);
    worsen(outcome, run.largestDisplacement());
    return outcome;
}

Outcome towerWithoutSupport(SolverType solver)
{
    Outcome outcome;
    Assembly<2> assembly = leaningTower(1);
    assembly.blocks.erase(assembly.blocks.begin());
    assembly.supports.clear();
    const DynamicCase<2> scene = sceneFor(solver, assembly);
    Watched run(scene, outcome);
    run.until(0.2, 1e-3);
    const double exact = -0.5 * g * 0.2 * 0.201;
    for (const Placement<2>& placement : run.motion.state.placements)
    {
        worsen(outcome, std::abs(placement.translation.y() - exact) + std::abs(placement.translation.x())
                            + std::abs(placement.rotation));
    }
    return outcome;
}

/// A block that starts 1 mm deep in the ground comes out of it, and must not be shot out.
Outcome initialOverlap(SolverType solver, double timeStep)
{
    Outcome outcome;
    for (const FlowRule flowRule : bothRules)
    {
        const DynamicCase<2> scene =
            sceneFor(solver, onGround({rectangle(0, -1e-3, 1, 0.4)}), {.flowRule = flowRule});
        Watched run(scene, outcome);
        const double out = 1.2e-3 / (g * timeStep); // at g dt
        while (run.motion.state.time < out && run.step(timeStep))
        {
            worsen(outcome,
                   (run.motion.state.placements[1].translation.y() - 1e-3) / (g * timeStep * timeStep));
        }
        run.keepsBlocksApart();
    }
    return outcome;
}

Outcome massRatio(SolverType solver, double ratio)
{
    Outcome outcome;
    Assembly<2> assembly = onGround({rectangle(-0.5, 0, 1, 0.5), rectangle(-0.5, 0.5, 1, 0.5)});
    DynamicCase<2> scene = sceneFor(solver, assembly);
    setStructure(scene, assembly, {1, 1, ratio});
    for (Eigen::Index row = 0; row < scene.mass.size(); row += 3)
    {
        scene.deadLoad.rows.segment<2>(row) = scene.mass[row] * scene.gravity;
    }
    Watched run(scene, outcome);
    run.until(0.05, 1e-3);
    worsen(outcome, run.largestDisplacement());
    return outcome;
}

Outcome tallTower(SolverType solver, int blocks)
{
    Outcome outcome;
    std::vector<Block<2>> tower;
    for (int block = 0; block < blocks; ++block)
    {
        tower.push_back(rectangle(-0.5, 0.5 * block, 1, 0.5));
    }
    DynamicCase<2> scene = sceneFor(solver, onGround(tower));
    // The first pulse it stands; its multiplier is 2/blocks.
    scenes::shake(scene, std::make_shared<RectangularPulse>(PulseShape{1.6 / blocks * g, 0.01, 0}));
    Watched run(scene, outcome);
    run.until(0.02, 2e-3);
    worsen(outcome, run.largestDisplacement());
    return outcome;
}

/// At a share below 1 of what it can carry a structure stands, and what it moves by is the figure; above, it
/// moves by more than `least` [m].
void standsOrMoves(Watched& run, Outcome& outcome, double share, double least)
{
    if (share < 1)
    {
        worsen(outcome, run.largestDisplacement());
    }
    else if (run.holds && !(run.largestDisplacement() > least))
    {
        run.fails("it stands");
    }
}

/// A block that is pushed by 0.8 and by 1.25 of what it tips at: it stands, and it moves.
Outcome slenderBlock(SolverType solver, double slenderness)
{
    Outcome outcome;
    for (const double share : {0.8, 1.25})
    {
        DynamicCase<2> scene = sceneFor(solver, onGround({rectangle(0, 0, 1, slenderness)}), {.mu = 3});
        scenes::shake(scene, std::make_shared<ConstantAcceleration>(share / slenderness * g));
        Watched run(scene, outcome);
        run.until(0.2, 2e-3);
        standsOrMoves(run, outcome, share, 1e-4);
    }
    return outcome;
}

/// Towers side by side that are thrown over, each of which does what one alone does.
Outcome twinTowers(SolverType solver, int copies)
{
    Outcome outcome;
    std::vector<double> path;
    for (const int towers : {1, copies})
    {
        Assembly<2> assembly = scenes::ground(-4, 4.0 * copies);
        for (int tower = 0; tower < towers; ++tower)
        {
            const Assembly<2> one = leaningTower(1);
            for (std::size_t block = 1; block < one.blocks.size(); ++block)
            {
                assembly.blocks.push_back(one.blocks[block]);
                for (Vector<2>& vertex : assembly.blocks.back().outline)
                {
                    vertex.x() += 4 * tower;
                }
            }
        }
        DynamicCase<2> scene = sceneFor(solver, std::move(assembly));
        scenes::shake(scene, std::make_shared<RectangularPulse>(PulseShape{0.6 * g, 0.4, 0}));
        Watched run(scene, outcome);
        run.until(0.3, 2e-3);
        for (std::size_t block = 1; block < run.motion.state.placements.size(); ++block)
        {
            const Placement<2>& placement = run.motion.state.placements[block];
            const std::array<double, 3> place{placement.translation.x(), placement.translation.y(),
                                              placement.rotation};
            for (std::size_t i = 0; i < 3; ++i)
            {
                const std::size_t known = 3 * ((block - 1) % 5) + i;
                towers == 1 ? path.push_back(place[i]) : worsen(outcome, std::abs(place[i] - path.at(known)));
            }
        }
    }
    return outcome;
}

/// Bricks that overhang by `share` of what they can.
Outcome overhangingBricks(SolverType solver, int bricks, double share)
{
    Outcome outcome;
    Assembly<2> assembly;
    assembly.supports = {{"table", "blocks"}};
    assembly.blocks.push_back(rectangle(-3, -1, 3, 1));
    assembly.blocks.back().support = 0;
    double end = 0;
    for (int brick = 0; brick < bricks; ++brick)
    {
        end += share * 0.5 / (bricks - brick);
        assembly.blocks.push_back(rectangle(end - 1, 0.2 * brick, 1, 0.2));
    }
    const DynamicCase<2> scene = sceneFor(solver, std::move(assembly));
    Watched run(scene, outcome);
    if (solver == SolverType::interiorPoint)
    {
        // The weights do next to no work (they move by less than 1e-9 m): balance to 1e-10 leaves some 1e-7
        // to 1.1e-6 of it out of the ledger, by how the compiled program rounds.
        run.largestImbalance = 3e-6;
    }
    run.until(0.5, 2e-3);
    standsOrMoves(run, outcome, share, 1e-7);
    return outcome;
}

Assembly<2> turnedOver(Assembly<2> assembly)
{
    for (Block<2>& block : assembly.blocks)
    {
        for (Vector<2>& vertex : block.outline)
        {
            vertex.x() *= -1;
        }
        std::reverse(block.outline.begin(), block.outline.end());
    }
    return assembly;
}

/// A semicircular arch of 27 voussoirs that is a thousandth thicker than 0.106721 R, the least that stands,
/// and one that is as much thinner: as built, disturbed and mirrored.
Outcome criticalArchInMotion(SolverType solver)
{
    Outcome outcome;
    double fallen = 0;
    for (const double share : {1.001, 0.999})
    {
        Arch arch;
        arch.thickness = share * 0.106721;
        const Assembly<2> built = makeAssembly(arch);
        for (const Assembly<2>& assembly : {built, disturbed(built, 1e-15), turnedOver(built)})
        {
            const DynamicCase<2> scene = sceneFor(solver, assembly, {.mu = 3});
            Watched run(scene, outcome);
            run.until(share > 1 ? 0.1 : 0.4, 2e-3);
            const double moved = run.largestDisplacement();
            if (share > 1)
            {
                worsen(outcome, moved);
            }
            else if (run.holds && !(moved > 1e-5))
            {
                run.fails("the thinner arch stands");
            }
            else if (run.holds && !(fallen == 0 || std::abs(moved / fallen - 1) < 0.5))
            {
                run.fails("noise or mirroring changes how it falls");
            }
            fallen = share < 1 && fallen == 0 ? moved : fallen;
        }
    }
    outcome.note = fmt::format("the thinner one has moved by {:.1e} m in 0.4 s", fallen);
    return outcome;
}

/// A block on ground that vibrates: at 0.2 g it stands (it tips from 0.25 g on), at 0.3 g it moves by no more
/// than the ground does.
Outcome vibration(SolverType solver, double frequency)
{
    Outcome outcome;
    for (const double amplitude : {0.2, 0.3})
    {
        for (const double timeStep : {0.05 / frequency, 0.7 / frequency})
        {
            DynamicCase<2> scene = sceneFor(solver, rockingBlock(), {.mu = 1});
            scenes::shake(scene,
                          std::make_shared<SinePulse>(PulseShape{amplitude * g, 20 / frequency, 0}, 40.0));
            Watched run(scene, outcome);
            run.until(20 / frequency, timeStep);
            const double ground = amplitude * g / std::pow(2 * std::numbers::pi * frequency, 2);
            worsen(outcome, amplitude < 0.25 ? run.largestDisplacement() / ground
                                             : 0.05 * run.largestDisplacement() / ground);
        }
    }
    return outcome;
}

/// A wedge between two inclined fixed faces, mu > tan b: statics alone calls it stable however it is lifted.
Outcome wedge(SolverType solver)
{
    Outcome outcome;
    const double tangent = 0.2;
    Assembly<2> assembly;
    assembly.supports = {{"springers", "blocks"}};
    assembly.blocks.push_back({{{0.5, 0}, {3, 0}, {3, 1}, {0.5 + tangent, 1}}, 1, 0});
    assembly.blocks.push_back({{{-3, 0}, {-0.5, 0}, {-0.5 - tangent, 1}, {-3, 1}}, 1, 0});
    assembly.blocks.push_back({{{-0.5, 0}, {0.5, 0}, {0.5 + tangent, 1}, {-0.5 - tangent, 1}}, 1, -1});
    for (const FlowRule flowRule : bothRules)
    {
        const DynamicCase<2> scene = sceneFor(solver, assembly, {.mu = 0.3, .flowRule = flowRule});
        Watched run(scene, outcome);
        run.until(0.1, 1e-3);
        worsen(outcome, run.largestDisplacement());
    }
    return outcome;
}

/// Two L-shaped blocks that hold each other; nothing holds both. Statics alone calls them stable in an
/// exact-fit frame.
Outcome interlocking(SolverType solver)
{
    Outcome outcome;
    Assembly<2> assembly;
    assembly.supports = {{"frame", "blocks"}};
    assembly.blocks = {rectangle(-1, -1, 1, 4), rectangle(2, -1, 1, 4)};
    assembly.blocks[0].support = assembly.blocks[1].support = 0;
    assembly.blocks.push_back({{{0, 0}, {2, 0}, {2, 0.5}, {1, 0.5}, {1, 1}, {0, 1}}, 1, -1});
    assembly.blocks.push_back({{{1, 0.5}, {2, 0.5}, {2, 1.5}, {0, 1.5}, {0, 1}, {1, 1}}, 1, -1});
    for (const FlowRule flowRule : bothRules)
    {
        const DynamicCase<2> scene = sceneFor(solver, assembly, {.mu = 0.5, .flowRule = flowRule});
        Watched run(scene, outcome);
        run.until(0.05, 1e-3);
        const double fallen = -run.motion.state.placements[2].translation.y();
        outcome.note +=
            fmt::format("{}{} falls {:.4f} m", outcome.note.empty() ? "" : "; ",
                        flowRule == FlowRule::associative ? "associative" : "nonAssociative", fallen);
        worsen(outcome, std::max({0.0, -fallen, fallen - 0.5 * g * 0.05 * 0.0511}));
    }
    return outcome;
}

} // namespace

std::vector<StabilityCase> motionCases()
{
    std::vector<StabilityCase> cases;
    const auto add = [&cases](std::string name, std::string hard, std::string measure, double limit,
                              double looseLimit, std::function<Outcome(SolverType)> run)
    {
        cases.push_back({std::move(name), std::move(hard), std::move(measure), limit, looseLimit,
                         motionSolvers(), std::move(run)});
    };
    add("slide_impulsive", "friction acts by an impulse at the first instant, and must not lift the block",
        "relative error of the distance in which a block stops, Coulomb's law", 5e-3, 5e-2, impulsiveSlide);
    add("slide_impulsive_associative", "the associative law takes mu2/(1 + mu2) of the energy, for any step",
        "error of the energy that is left, relative", 1e-3, 1e-2, impulsiveSlideAssociative);
    add("slide_steady_associative", "the block hovers at mu dt |v|: what this law does, no more and no less",
        "relative error of the hover", 1e-6, 1e-1, steadySlide);
    add("slot_exactFit", "Coulomb's law has many solutions: any pressure of the walls is as good as none",
        "by how much it leaves the slot or what gravity allows [m]", 1e-9, 1e-4, exactFitSlot);
    add("slot_exactFit_associative", "sliding would open both joints at once", "displacement [m]", 1e-9, 1e-4,
        exactFitSlotAssociative);
    for (const auto& [mu, text] : {std::pair(0.0, "0"), {1e-12, "1em12"}, {1.5, "1p5"}, {3.0, "3"}})
    {
        add(fmt::format("motion_mu_{}", text), "cones degenerate to rays, or are wider than a right angle",
            "error of the displacement after 0.1 s [m]", 1e-9, 1e-3,
            [mu = mu](SolverType solver) { return frictionInMotion(solver, mu); });
    }
    add("impact_everyPhase_theta1", "an impact somewhere within a step, 20 phases, both sides and flow rules",
        "error of Housner's velocity ratio", 1e-3, 1e-2,
        [](SolverType solver) { return impactAtEveryPhase(solver, 1); });
    add("impact_everyPhase_theta0p5", "the trapezoidal rule would rebound by how the step falls",
        "error of Housner's velocity ratio", 1e-3, 1e-2,
        [](SolverType solver) { return impactAtEveryPhase(solver, 0.5); });
    add("cornerOnCorner", "two corners meet exactly: the normal may be that of any of four edges",
        "gain of energy in a step, over a fall of 1 m", 1e-9, 1e-3,
        [](SolverType solver) { return cornerOnCorner(solver, 0, std::span(bothRules).first<1>()); });
    add("cornerOnCorner_Coulomb", "the same: friction stops the corner exactly on the other one",
        "gain of energy in a step, over a fall of 1 m", 1e-9, 1e-3,
        [](SolverType solver) { return cornerOnCorner(solver, 0, std::span(bothRules).last<1>()); });
    add("cornerOnCorner_aside", "the same, and a millionth aside",
        "gain of energy in a step, over a fall of 1 m", 1e-9, 1e-3,
        [](SolverType solver) { return cornerOnCorner(solver, 1e-6, bothRules); });
    add("painleve", "no finite force keeps the rod out of the ground: only an impulse does",
        "error of the impulse over m v", 1e-4, 1e-2, painleve);
    add("zenoBounce", "infinitely many impacts in finite time", "relative error of the time to rest", 1e-2,
        1e-1, zenoBounce);
    add("safeIsland", "a block stands between 1.54692 and 1.67415 g of one sine, and falls below and above",
        "wrong verdicts of twelve", 0, 0, safeIsland);
    add("step_0", "Mbar = M/dt2 is infinite", "change of the state", 0, 0, noStep);
    for (const auto& [timeStep, text] : {std::pair(1e-12, "1em12"), {1.0, "1"}})
    {
        add(fmt::format("step_{}s", text), "loads vanish beside momenta, or the other way round",
            "error of the place, at rest and in free fall, over g dt2", 1e-6, 1e-3,
            [timeStep = timeStep](SolverType solver) { return stepOf(solver, timeStep); });
    }
    add("rest_1e3", "errors of a step at rest add up", "displacement of a leaning tower [m]", 1e-9, 1e-4,
        [](SolverType solver) { return rest(solver, 1000); });
    add("rest_1e6", "errors of a step at rest add up", "displacement of a leaning tower [m]", 1e-9, 1e-4,
        [](SolverType solver) { return rest(solver, 1000000); });
    cases.back().length = Length::nightly;
    for (const auto& [scale, text] : {std::pair(1e-6, "1em6"), {1e-3, "1em3"}, {1e3, "1e3"}, {1e6, "1e6"}})
    {
        add(fmt::format("fall_lengths_{}", text), "an absolute tolerance anywhere shows; so does chaos",
            "change of a falling tower's path, over its lengths", 1e-6, 1e-1,
            [scale = scale](SolverType solver) { return scaledFall(solver, scale, 1); });
        add(fmt::format("fall_loads_{}", text), "an absolute tolerance anywhere shows; so does chaos",
            "change of a falling tower's path, over its lengths", 1e-6, 1e-1,
            [scale = scale](SolverType solver) { return scaledFall(solver, 1, scale); });
    }
    for (const auto& [theta, text] : {std::pair(1.0, "1"), {0.5, "0p5"}})
    {
        add(fmt::format("fall_theta_{}", text), "blocks roll, slide and meet; theta 1/2 damps nothing",
            "0 when the tower falls with all that must hold", 0, 0,
            [theta = theta](SolverType solver) { return fallWithTheta(solver, theta); });
    }
    for (const auto& [gap, text] : {std::pair(1e-12, "1em12"), {-1e-12, "m1em12"}})
    {
        add(fmt::format("gap_{}", text), "whether it touches is a matter of rounding", "displacement [m]",
            1e-9, 1e-4, [gap = gap](SolverType solver) { return nearlyTouching(solver, gap); });
    }
    for (const auto& [angle, text] : anglesOutOfParallel)
    {
        add(fmt::format("outOfParallel_{}", text),
            "one corner touches, or two: the normal must not depend on it",
            "displacement over (angle + 1e-9), and velocity after settling", 1.1, 2,
            [angle = angle](SolverType solver) { return outOfParallel(solver, angle); });
    }
    add("slivers", "blocks of 1e-4, upright and flat, among full ones", "displacement at rest [m]", 1e-9,
        1e-4, slivers);
    add("removedSupport", "nothing holds the tower: all joints are closed and none carries a force",
        "error of the free fall of 0.2 s [m, rad]", 1e-7, 1e-3, towerWithoutSupport);
    for (const auto& [timeStep, text] : {std::pair(1e-3, "1em3"), {1e-4, "1em4"}})
    {
        add(fmt::format("initialOverlap_1mm_step_{}", text),
            "closed at once the overlap would throw the block up, the faster the shorter the step",
            "height above the ground over g dt2", 1, 10,
            [timeStep = timeStep](SolverType solver) { return initialOverlap(solver, timeStep); });
    }
    for (const auto& [ratio, text] : {std::pair(1e4, "1e4"), {1e8, "1e8"}, {1e-8, "1em8"}})
    {
        add(fmt::format("motion_massRatio_{}", text), "heavy on light: the light block's weight is rounding",
            "displacement at rest [m]", 1e-9, 1e-4,
            [ratio = ratio](SolverType solver) { return massRatio(solver, ratio); });
    }
    for (const int blocks : {20, 200})
    {
        add(fmt::format("motion_tower_{}", blocks), "forces pass through all blocks within one step",
            "displacement under 0.8 of the multiplier [m]", 1e-9, 1e-4,
            [blocks](SolverType solver) { return tallTower(solver, blocks); });
    }
    for (const int slenderness : {1, 10, 100})
    {
        add(fmt::format("motion_slenderness_{}", slenderness),
            "a slender block has moments that dwarf its forces, and tips under next to nothing",
            "displacement under 0.8 of what tips it [m, rad]", 1e-9, 1e-4,
            [slenderness](SolverType solver) { return slenderBlock(solver, slenderness); });
    }
    for (const int copies : {2, 8})
    {
        add(fmt::format("motion_twins_{}", copies),
            "what one tower does must not depend on others, which share tolerances and iterations",
            "difference from the path of one falling alone [m, rad]", 1e-7, 1e-3,
            [copies](SolverType solver) { return twinTowers(solver, copies); });
    }
    for (const int bricks : {4, 20})
    {
        add(fmt::format("motion_overhang_{}_inside", bricks), "stands by a millionth of the overhang",
            "displacement, of what falls in as long 1e-7 [m, rad]", 1e-8, 1e-4,
            [bricks](SolverType solver) { return overhangingBricks(solver, bricks, 1 - 1e-6); });
        add(fmt::format("motion_overhang_{}_outside", bricks),
            "falls by a millionth of the overhang, at first as slowly", "0 when it falls", 0, 0,
            [bricks](SolverType solver) { return overhangingBricks(solver, bricks, 1 + 1e-6); });
    }
    add("motion_criticalArch", "a single thrust line fits, touching both faces in turn; thinner, none does",
        "displacement of the arch that stands by a thousandth of its thickness [m, rad]", 1e-9, 1e-4,
        criticalArchInMotion);
    for (const int frequency : {50, 500})
    {
        add(fmt::format("vibration_{}Hz", frequency),
            "faster than the steps: impulses, not samples, must count",
            "displacement over that of the ground (a twentieth of it above 0.25 g)", 1e-2, 1e-1,
            [frequency](SolverType solver) { return vibration(solver, frequency); });
    }
    add("wedge", "self-locked: forces of any size are in balance", "displacement [m]", 1e-9, 1e-4, wedge);
    add("interlocking", "statics alone calls it stable: friction on walls that nothing presses",
        "by how much it leaves what gravity allows [m]", 1e-9, 1e-4, interlocking);
    return cases;
}

} // namespace drystone
