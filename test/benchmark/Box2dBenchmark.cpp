// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Box2D, a game engine, on walls of the paper: one second in steps of 0.002 s, loaded by a fraction of the
/// collapse multiplier. At 0.8 alpha a wall stands: the displacement of its blocks, `moved[mm]`, is the error
/// of the engine. The corresponding figures of Drystone are those of MotionBenchmark.
///
///     build/test/Box2dBenchmark --benchmark_out=box2d.csv --benchmark_out_format=csv
#include "Peers.h"
#include "Walls.h"

#include <benchmark/benchmark.h>

#include <box2d/box2d.h>

namespace drystone
{
namespace
{

/// \param state wall, percent of alpha, iterations of velocity (position: three eighths of them, as its
/// defaults)
void box2d(benchmark::State& state)
{
    const Assembly<2> assembly = paperWall(static_cast<int>(state.range(0)));
    const double alpha = 0.01 * static_cast<double>(state.range(1)) * paperMultipliers[state.range(0) - 1];
    const auto velocityIterations = static_cast<int>(state.range(2));
    double used = 0;
    double moved = 0;
    for (auto _ : state)
    {
        b2World world({static_cast<float>(9.81 * alpha), -9.81F});
        world.SetAllowSleeping(false);
        std::vector<std::pair<b2Body*, b2Vec2>> blocks;
        for (const Block<2>& block : assembly.blocks)
        {
            std::vector<b2Vec2> corners;
            for (const Vector<2>& corner : block.outline)
            {
                corners.emplace_back(static_cast<float>(corner.x()), static_cast<float>(corner.y()));
            }
            b2PolygonShape shape;
            shape.Set(corners.data(), static_cast<int>(corners.size()));
            shape.m_radius = 0; // its skin of 1 cm would keep the blocks apart
            b2BodyDef definition;
            definition.type = block.support < 0 ? b2_dynamicBody : b2_staticBody;
            b2Body* body = world.CreateBody(&definition);
            b2FixtureDef fixture;
            fixture.shape = &shape;
            fixture.density = static_cast<float>(1000 / 9.81);
            fixture.friction = 0.65F; // mixed as the geometric mean: 0.65 again
            body->CreateFixture(&fixture);
            if (block.support < 0)
            {
                blocks.emplace_back(body, body->GetWorldCenter());
            }
        }
        const double start = cpuSeconds();
        for (int step = 0; step < 500; ++step)
        {
            world.Step(0.002F, velocityIterations, std::max(1, 3 * velocityIterations / 8));
        }
        used = cpuSeconds() - start;
        state.SetIterationTime(used);
        moved = 0;
        for (const auto& [body, place] : blocks)
        {
            moved = std::max(moved, static_cast<double>((body->GetWorldCenter() - place).Length()));
        }
    }
    state.counters["CPU[s/s]"] = used;
    state.counters["step[ms]"] = 1e3 * used / 500;
    state.counters["moved[mm]"] = 1e3 * moved;
}
BENCHMARK(box2d)
    ->ArgNames({"wall", "percent", "iterations"})
    ->ArgsProduct({{1, 6}, {0, 80, 110}, {8, 200}})
    ->UseManualTime()
    ->Unit(benchmark::kSecond)
    ->Iterations(1);

} // namespace
} // namespace drystone
