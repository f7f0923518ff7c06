// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The cost of each effect: CPU time of 0.2 s of motion of the paper's wall 1, in steps of 0.002 s, under
/// gravity and a load of 1.1 times its multiplier only (`none`: frictionless, rigid, undamped, the load as a
/// force), then with each effect in addition to friction, and with all that can be combined. The cost of an
/// effect where it is absent is in results/README.md, because it requires a second build.
///
///     build/test/EffectsBenchmark --benchmark_out=effects.csv --benchmark_out_format=csv
#include "../MadeStructure.h"
#include "Peers.h"

#include "dynamics/Advance.h"
#include "effects/Deletion.h"
#include "effects/GroundMotion.h"
#include "effects/JointBonds.h"
#include "effects/JointElasticity.h"
#include "effects/MassDamping.h"
#include "effects/SupportMotion.h"

#include <benchmark/benchmark.h>

namespace drystone
{
namespace
{

constexpr double weight = 9.81;
constexpr double multiplier = 0.642859;
constexpr double timeStep = 0.002;
constexpr int steps = 100;

/// The wall under its weight and a load to the left, without any effect.
DynamicCase<2> wall()
{
    DynamicCase<2> scene;
    Assembly<2> assembly = madeStructure(Dictionary::readFile(
        DRYSTONE_TUTORIALS "/contactDynamics/masonryPanels/wall1/system/blockTextureDict"));
    const std::vector<double> densities(assembly.blocks.size(), 1000 / weight);
    setStructure(scene, std::move(assembly), densities);
    scene.gravity = {0, -weight};
    scene.deadLoad.rows = Eigen::VectorXd::Zero(scene.mass.size());
    for (Eigen::Index row = 0; row < scene.mass.size(); row += 3)
    {
        scene.deadLoad.rows.segment<2>(row) = scene.mass[row] * weight * Vector<2>(-1.1 * multiplier, -1);
    }
    return scene;
}

void friction(DynamicCase<2>& scene)
{
    scene.contact.friction = CoulombFriction{0.65, FlowRule::associative};
}

void coulomb(DynamicCase<2>& scene)
{
    scene.contact.friction = CoulombFriction{0.65, FlowRule::nonAssociative};
}

void restitution(DynamicCase<2>& scene)
{
    friction(scene);
    scene.contact.restitution = Restitution{0.3};
}

/// Weaker than the load requires: some bonds break immediately.
void cohesion(DynamicCase<2>& scene)
{
    friction(scene);
    scene.contact.cohesion = JointStrength{20};
    scene.contact.tension = JointStrength{10};
    scene.effects.push_back(std::make_shared<JointBonds<2>>(jointBonds(scene.contact, scene.assembly)));
}

void elasticity(DynamicCase<2>& scene)
{
    friction(scene);
    scene.effects.push_back(std::make_shared<JointElasticity<2>>(Elasticity{1e8, 5e7}));
}

void damping(DynamicCase<2>& scene)
{
    friction(scene);
    scene.effects.push_back(std::make_shared<MassDamping<2>>(Damping{0.5}));
}

void deletion(DynamicCase<2>& scene)
{
    friction(scene);
    scene.effects.push_back(std::make_shared<BlockDeletion<2>>(Deletion<2>{{{-10, -10}, {10, 10}}}));
}

void groundMotion(DynamicCase<2>& scene)
{
    friction(scene);
    for (const Eigen::Vector3d direction : {Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitY()})
    {
        GroundMotion::Component component;
        component.direction = direction;
        component.acceleration = std::make_shared<SinePulse>(PulseShape{0.5, 0.2, 0}, 2);
        GroundMotion ground = groundMotionOf(scene.effects);
        ground.components.push_back(component);
        setGroundMotion(scene.effects, ground);
    }
}

void supportMotion(DynamicCase<2>& scene)
{
    friction(scene);
    scene.effects.push_back(std::make_shared<MovingSupports<2>>(std::vector<SupportMotion<2>>{
        {0, {1, 0}, tabulatedAcceleration({0, 1}, {0, 0.5}, Interpolation::linear, OutOfBounds::zero)}}));
}

/// Restitution and cohesion cannot be combined with elasticity.
void all(DynamicCase<2>& scene)
{
    groundMotion(scene);
    supportMotion(scene);
    elasticity(scene);
    damping(scene);
    deletion(scene);
}

void effects(benchmark::State& state, void (*choose)(DynamicCase<2>&))
{
    DynamicCase<2> scene = wall();
    if (choose)
    {
        choose(scene);
    }
    double least = 1e300;
    for (auto _ : state)
    {
        Motion<2> motion = startMotion(scene, stateAtRest(scene.assembly));
        const double start = cpuSeconds();
        for (int step = 0; step < steps; ++step)
        {
            if (!advance(scene, motion, timeStep))
            {
                state.SkipWithError("a step was not solved");
                return;
            }
        }
        const double used = cpuSeconds() - start;
        least = std::min(least, used);
        state.SetIterationTime(used);
    }
    state.counters["least[ms/step]"] = 1e3 * least / steps;
}

BENCHMARK_CAPTURE(effects, none, nullptr)->UseManualTime()->Unit(benchmark::kMillisecond)->Iterations(5);
BENCHMARK_CAPTURE(effects, friction, friction)->UseManualTime()->Unit(benchmark::kMillisecond)->Iterations(5);
BENCHMARK_CAPTURE(effects, nonAssociative, coulomb)
    ->UseManualTime()
    ->Unit(benchmark::kMillisecond)
    ->Iterations(5);
BENCHMARK_CAPTURE(effects, restitution, restitution)
    ->UseManualTime()
    ->Unit(benchmark::kMillisecond)
    ->Iterations(5);
BENCHMARK_CAPTURE(effects, cohesion, cohesion)->UseManualTime()->Unit(benchmark::kMillisecond)->Iterations(5);
BENCHMARK_CAPTURE(effects, elasticity, elasticity)
    ->UseManualTime()
    ->Unit(benchmark::kMillisecond)
    ->Iterations(5);
BENCHMARK_CAPTURE(effects, damping, damping)->UseManualTime()->Unit(benchmark::kMillisecond)->Iterations(5);
BENCHMARK_CAPTURE(effects, deletion, deletion)->UseManualTime()->Unit(benchmark::kMillisecond)->Iterations(5);
BENCHMARK_CAPTURE(effects, groundMotion, groundMotion)
    ->UseManualTime()
    ->Unit(benchmark::kMillisecond)
    ->Iterations(5);
BENCHMARK_CAPTURE(effects, supportMotion, supportMotion)
    ->UseManualTime()
    ->Unit(benchmark::kMillisecond)
    ->Iterations(5);
BENCHMARK_CAPTURE(effects, all, all)->UseManualTime()->Unit(benchmark::kMillisecond)->Iterations(5);

} // namespace
} // namespace drystone
