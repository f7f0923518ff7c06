// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// What `selection automatic` of system/schemes/effects saves: the same motions with everything on and with
/// the effects that each step calls for, one after the other in one run. Walls and a house of space that
/// stand under a ground that shakes below their multiplier, a wall of 100 x 100 units of which stones on top
/// fall, more and more of them, a column that rocks, and the paper's wall 6 as it collapses by Coulomb's law.
///
/// Columns: milliseconds of the processor a step of both, their ratio, the largest distance between the two
/// motions at the end [m], the share of the blocks that a step simulated.
///
///     build/test/ChosenEffectsBenchmark --benchmark_out=chosenEffects.csv --benchmark_out_format=csv
#include "../dynamics/SceneGravity.h"
#include "core/Log.h"
#include "dynamics/Advance.h"
#include "dynamics/VerifiedStep.h"
#include "effects/GroundMotion.h"
#include "texture/Texture.h"
#include "timeSeries/GroundAcceleration.h"

#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <stdexcept>

namespace drystone
{
namespace
{

constexpr double weight = 9.81;

template<int Dim>
DynamicCase<Dim> sceneOf(Assembly<Dim> assembly, double mu, FlowRule flowRule)
{
    DynamicCase<Dim> scene;
    const std::vector<double> densities(assembly.blocks.size(), 2000);
    setStructure(scene, std::move(assembly), densities);
    setGravity(scene, -weight * Vector<Dim>::Unit(Dim - 1));
    scene.contact.friction = CoulombFriction{mu, flowRule};
    return scene;
}

template<int Dim>
void shake(DynamicCase<Dim>& scene, double amplitude)
{
    GroundMotion::Component component;
    component.acceleration = std::make_shared<SinePulse>(PulseShape{amplitude, 2, 0}, 8);
    setGroundMotion<Dim>(scene.effects, {{component}});
}

/// Takes the same steps both ways.
template<int Dim>
void compare(benchmark::State& state, DynamicCase<Dim> scene, double timeStep, int steps)
{
    for (auto _ : state)
    {
        std::vector<Motion<Dim>> ends;
        std::vector<double> seconds;
        for (const EffectSelection selection : {EffectSelection::asGiven, EffectSelection::automatic})
        {
            scene.schemes.effects.selection = selection;
            Motion<Dim> motion = startMotion(scene, stateAtRest(scene.assembly));
            double awake = 0;
            const double start = cpuTime();
            for (int step = 0; step < steps; ++step)
            {
                if (!advance(scene, motion, timeStep))
                {
                    throw std::runtime_error("a step was not solved");
                }
                awake +=
                    motion.isAwake.empty()
                        ? 1
                        : static_cast<double>(std::count(motion.isAwake.begin(), motion.isAwake.end(), true))
                              * freedomCount<Dim> / static_cast<double>(scene.mass.size());
            }
            seconds.push_back(cpuTime() - start);
            state.counters["awake[%]"] = 100 * awake / steps;
            ends.push_back(std::move(motion));
        }
        state.counters["blocks"] = static_cast<double>(scene.mass.size()) / freedomCount<Dim>;
        state.counters["steps"] = steps;
        state.counters["everything[ms]"] = 1000 * seconds[0] / steps;
        state.counters["automatic[ms]"] = 1000 * seconds[1] / steps;
        state.counters["ratio"] = seconds[0] / seconds[1];
        state.counters["difference[m]"] = differenceOf(scene, ends[0].state, ends[1].state);
    }
}

Assembly<2> paperWall(int number)
{
    return makeStructure(Dictionary::readFile(fmt::format(
        DRYSTONE_TUTORIALS "/limitAnalysis/masonryPanels/wall{}/system/blockTextureDict", number)));
}

Assembly<2> squareWall(int size)
{
    return makeStructure(Dictionary::readString(fmt::format(
        "texture {{ type runningBond; unit (0.4 0.175); length {0}; courses {0}; firstCourse full; }}\n"
        "supports {{ ground {{ type ground; segment 0.5; }} }}\n",
        size)));
}

void standingWall(benchmark::State& state)
{
    constexpr std::array<double, 6> multipliers{0.642859, 0.579999, 0.403694, 0.331948, 0.239643, 0.347825};
    const auto number = static_cast<int>(state.range(0));
    auto scene = sceneOf<2>(paperWall(number), 0.65, FlowRule::associative);
    shake(scene, 0.9 * multipliers[static_cast<std::size_t>(number - 1)] * weight);
    compare(state, std::move(scene), 0.002, 500);
}
BENCHMARK(standingWall)->DenseRange(1, 6)->Iterations(1)->Unit(benchmark::kMillisecond);

void standingSquareWall(benchmark::State& state)
{
    auto scene = sceneOf<2>(squareWall(static_cast<int>(state.range(0))), 0.65, FlowRule::associative);
    shake(scene, 0.3 * weight);
    compare(state, std::move(scene), 0.01, 100);
}
BENCHMARK(standingSquareWall)->Arg(20)->Arg(40)->Iterations(1)->Unit(benchmark::kMillisecond);

/// Four walls toothed into each other, with a door, in space.
void standingHouse(benchmark::State& state)
{
    auto scene =
        sceneOf<3>(makeStructure<3>(Dictionary::readString(
                       "dimensions 3;\n"
                       "texture { type walls; unit (0.5 0.25 0.25); bond running; courses 10; walls {\n"
                       "front { from (0 0); direction (1 0); length 8; thickness left; }\n"
                       "side { from (0 0); direction (0 1); length 6; thickness right; } } }\n"
                       "supports { ground { type ground; } }\n")),
                   0.6, FlowRule::associative);
    shake(scene, 0.05 * weight);
    compare(state, std::move(scene), 0.01, 100);
}
BENCHMARK(standingHouse)->Iterations(1)->Unit(benchmark::kMillisecond);

/// Stones on top of a wall that overhang by more than half of themselves. \param range of stones; units of
/// the wall
void fallingStones(benchmark::State& state)
{
    const auto size = static_cast<int>(state.range(1));
    Assembly<2> assembly = squareWall(size);
    const double top = 0.175 * size;
    const auto count = state.range(0);
    for (long stone = 0; stone < count; ++stone)
    {
        const double left = 0.4 * size * (static_cast<double>(stone) + 0.5) / static_cast<double>(count);
        for (const auto& [from, to, height] :
             {std::array{left, left + 0.3, 0.0}, {left + 0.17, left + 0.47, 0.2}})
        {
            Block<2> block;
            block.outline = {{from, top + height},
                             {to, top + height},
                             {to, top + height + 0.2},
                             {from, top + height + 0.2}};
            block.thickness = 1;
            block.support = -1;
            assembly.blocks.push_back(block);
        }
    }
    compare(state, sceneOf<2>(std::move(assembly), 0.65, FlowRule::associative), 0.01, 12);
}
BENCHMARK(fallingStones)
    ->ArgsProduct({{1, 10, 50}, {100}})
    ->Args({1, 40})
    ->Iterations(1)
    ->Unit(benchmark::kMillisecond);

/// Twelve drums on top of each other, pushed by a pulse from which they rock.
void rockingColumn(benchmark::State& state)
{
    Assembly<2> assembly;
    assembly.supports.push_back({"ground", "ground"});
    for (int drum = -1; drum < 12; ++drum)
    {
        const double half = drum < 0 ? 5 : 0.4;
        Block<2> block;
        block.outline = {
            {-half, 0.5 * drum}, {half, 0.5 * drum}, {half, 0.5 * drum + 0.5}, {-half, 0.5 * drum + 0.5}};
        block.thickness = 1;
        block.support = drum < 0 ? 0 : -1;
        assembly.blocks.push_back(block);
    }
    auto scene = sceneOf<2>(std::move(assembly), 0.7, FlowRule::associative);
    GroundMotion::Component component;
    component.acceleration = std::make_shared<SinePulse>(PulseShape{0.25 * weight, 0.6, 0.2}, 1);
    setGroundMotion<2>(scene.effects, {{component}});
    compare(state, std::move(scene), 0.002, 2000);
}
BENCHMARK(rockingColumn)->Iterations(1)->Unit(benchmark::kMillisecond);

void collapseByCoulombsLaw(benchmark::State& state)
{
    auto scene = sceneOf<2>(paperWall(6), 0.65, FlowRule::nonAssociative);
    GroundMotion::Component component;
    component.acceleration = std::make_shared<ConstantAcceleration>(-1.1 * 0.347825 * weight);
    setGroundMotion<2>(scene.effects, {{component}});
    compare(state, std::move(scene), 0.002, 100);
}
BENCHMARK(collapseByCoulombsLaw)->Iterations(1)->Unit(benchmark::kMillisecond);

} // namespace
} // namespace drystone
