// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Time to find the contact points of a wall in motion, per step: with a kept neighbour list, and with a new
/// one.
#include "contact/MovingContacts.h"
#include "texture/RunningBond.h"
#include "texture/Supports.h"

#include <benchmark/benchmark.h>

#include <cmath>

using namespace drystone;

namespace
{

Assembly<2> onGround(const RunningBond& bond)
{
    Assembly<2> wall = makeAssembly(bond);
    Ground ground;
    ground.segment = bond.unit.x() / 2;
    addGround(wall, "ground", ground);
    return wall;
}

/// Wall 6 of table 1 of Portioli, Cascini & Landolfo (2017): 146 blocks.
Assembly<2> wallSix()
{
    RunningBond bond;
    bond.length = 7;
    bond.courses = 21;
    bond.openings = {
        {{1.5, 4}, {2.5, 9}}, {{4.5, 4}, {5.5, 9}}, {{1.5, 12}, {2.5, 17}}, {{4.5, 12}, {5.5, 17}}};
    return onGround(bond);
}

/// A square wall of n units by n courses: 25,680 blocks for n = 160.
Assembly<2> squareWall(int n)
{
    RunningBond bond;
    bond.length = n;
    bond.courses = n;
    bond.firstCourse = FirstCourse::full;
    return onGround(bond);
}

Assembly<2> wall(std::int64_t size)
{
    return size == 6 ? wallSix() : squareWall(static_cast<int>(size));
}

/// Free blocks displaced and rotated at random by up to `size` [m, rad].
std::vector<Placement<2>> shaken(const Assembly<2>& assembly, double size)
{
    std::vector<Placement<2>> placements(assembly.blocks.size());
    for (std::size_t b = 0; b < placements.size(); ++b)
    {
        if (assembly.blocks[b].support < 0)
        {
            const double phase = 1.7 * static_cast<double>(b);
            placements[b] = {{size * std::sin(phase), size * std::cos(3 * phase)},
                             size * std::sin(5 * phase)};
        }
    }
    return placements;
}

constexpr double margin = 1e-3;

void report(benchmark::State& state, std::size_t points)
{
    state.counters["points"] = static_cast<double>(points);
    state.counters["ns/point"] =
        benchmark::Counter(static_cast<double>(points) * 1e-9,
                           benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

void asBuilt(benchmark::State& state)
{
    const Assembly<2> assembly = wall(state.range(0));
    const auto placements = shaken(assembly, 0);
    MovingContacts<2> contacts(assembly);
    std::size_t points = 0;
    for (auto _ : state)
    {
        points = contacts.update(placements, margin).size();
    }
    report(state, points);
}

void heading(benchmark::State& state)
{
    const Assembly<2> assembly = wall(state.range(0));
    const auto now = shaken(assembly, 0);
    const auto ahead = shaken(assembly, 1e-5);
    MovingContacts<2> contacts(assembly);
    std::size_t points = 0;
    for (auto _ : state)
    {
        points = contacts.update(now, ahead, margin).size();
    }
    report(state, points);
}

void rebuilt(benchmark::State& state)
{
    const Assembly<2> assembly = wall(state.range(0));
    const auto placements = shaken(assembly, 0);
    const auto far = shaken(assembly, 0.2);
    MovingContacts<2> contacts(assembly);
    std::size_t points = 0;
    bool isFar = false;
    for (auto _ : state)
    {
        isFar = !isFar;
        points = contacts.update(isFar ? far : placements, margin).size();
    }
    report(state, points);
}

} // namespace

BENCHMARK(asBuilt)->Arg(6)->Arg(160)->Unit(benchmark::kMicrosecond);
BENCHMARK(heading)->Arg(6)->Arg(160)->Unit(benchmark::kMicrosecond);
BENCHMARK(rebuilt)->Arg(6)->Arg(160)->Unit(benchmark::kMicrosecond);
