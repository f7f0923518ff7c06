// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The work before any solution: dictionaries, blocks, contact points.
#include "../MadeStructure.h"
#include "assembly/AssemblyFile.h"
#include "contact/ContactPoint.h"

#include <benchmark/benchmark.h>
#include <fmt/format.h>

namespace drystone
{

namespace
{

/// A square running-bond wall: as many courses as the wall is units long.
Dictionary squareWall(long courses)
{
    return Dictionary::readString(fmt::format(
        "texture {{ type runningBond; unit (0.4 0.175); length {0}; courses {0}; firstCourse full; }}\n"
        "supports {{ ground {{ type ground; segment 0.5; }} }}\n",
        courses));
}

void makeBlocks(benchmark::State& state)
{
    const Dictionary dictionary = squareWall(state.range(0));
    std::size_t blocks = 0;
    for (auto _ : state)
    {
        benchmark::DoNotOptimize(blocks = madeStructure(dictionary).blocks.size());
    }
    state.counters["blocks"] = static_cast<double>(blocks);
}
BENCHMARK(makeBlocks)->Arg(20)->Arg(80)->Arg(320)->Unit(benchmark::kMillisecond);

void findContacts(benchmark::State& state)
{
    const Assembly<2> assembly = madeStructure(squareWall(state.range(0)));
    std::size_t points = 0;
    for (auto _ : state)
    {
        benchmark::DoNotOptimize(points = findContactPoints(assembly).size());
    }
    state.counters["points"] = static_cast<double>(points);
}
BENCHMARK(findContacts)->Arg(20)->Arg(80)->Arg(320)->Unit(benchmark::kMillisecond);

/// Bricks of a wall in space, one leaf: as many courses as the wall is bricks long.
void findContactsInSpace(benchmark::State& state)
{
    const Assembly<3> assembly = madeStructure<3>(Dictionary::readString(
        fmt::format("dimensions 3; texture {{ type walls; unit (0.25 0.125 0.065); bond running; courses "
                    "{0}; walls {{ front {{ "
                    "from (0 0); length {0}; }} }} }} supports {{ ground {{ type ground; }} }}",
                    state.range(0))));
    std::size_t points = 0;
    for (auto _ : state)
    {
        benchmark::DoNotOptimize(points = findContactPoints(assembly).size());
    }
    state.counters["blocks"] = static_cast<double>(assembly.blocks.size());
    state.counters["points"] = static_cast<double>(points);
}
BENCHMARK(findContactsInSpace)->Arg(20)->Arg(80)->Arg(316)->Unit(benchmark::kMillisecond);

void readBlocks(benchmark::State& state)
{
    const std::string text = assemblyText(madeStructure(squareWall(state.range(0))));
    for (auto _ : state)
    {
        benchmark::DoNotOptimize(Dictionary::readString(text).entries().size());
    }
    state.SetBytesProcessed(state.iterations() * static_cast<long>(text.size()));
}
BENCHMARK(readBlocks)->Arg(20)->Arg(80)->Arg(320)->Unit(benchmark::kMillisecond);

} // namespace

} // namespace drystone
