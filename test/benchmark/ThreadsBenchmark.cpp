// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Limit analysis of square walls by one thread and by several, and to a rough tolerance: clock and CPU time,
/// memory, and a number made of every bit of the solution, which is to be the same for any number of threads.
///
///     build/test/ThreadsBenchmark --benchmark_filter=-million --benchmark_out=threads.csv
///     --benchmark_out_format=csv build/test/ThreadsBenchmark --benchmark_filter=million   # a million
///     blocks: half an hour, 12 GB
#include "Context.h"
#include "Walls.h"

#include "conic/InteriorPoint.h"
#include "core/Log.h"
#include "core/Threads.h"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <limits>

namespace drystone
{
namespace
{

/// 32 bits of all numbers of a solution (FNV), which a table shows without rounding.
double bitsOf(const LimitAnalysis& found)
{
    std::uint32_t bits = 2166136261u;
    for (const Eigen::VectorXd* numbers : {&found.contactForce, &found.mechanism})
    {
        for (const double number : *numbers)
        {
            std::uint64_t of = 0;
            std::memcpy(&of, &number, sizeof of);
            bits = (bits ^ static_cast<std::uint32_t>(of ^ (of >> 32))) * 16777619u;
        }
    }
    return bits;
}

void solve(benchmark::State& state, int size, double friction, double tolerance, int count)
{
    PlaneConeProgram program = limitAnalysisOf(squareWall(size));
    program.friction.assign(program.friction.size(), friction);
    setThreads(count);
    double cpu = std::numeric_limits<double>::max();
    LimitAnalysis found;
    for (auto _ : state)
    {
        const double clockAtStart = clockTime();
        const double cpuAtStart = cpuTime();
        found = solveLimitAnalysis(program, {.tolerance = tolerance});
        cpu = std::min(cpu, cpuTime() - cpuAtStart);
        state.SetIterationTime(clockTime() - clockAtStart);
    }
    setThreads(1);
    state.counters["blocks"] = program.bodies;
    state.counters["alpha"] = found.alpha;
    state.counters["factorisations"] = found.factorisations;
    state.counters["solves"] = found.solves;
    state.counters["certificate"] = found.certificate.worst();
    state.counters["cpu[s]"] = cpu;
    state.counters["memory[GB]"] = peakMemory();
    state.counters["bits"] = bitsOf(found);
    if (found.status != CollapseStatus::optimal)
    {
        state.SkipWithError("not solved");
    }
}

/// Size, threads.
void squareWallByThreads(benchmark::State& state)
{
    solve(state, static_cast<int>(state.range(0)), 0.65, 1e-8, static_cast<int>(state.range(1)));
}
BENCHMARK(squareWallByThreads)
    ->ArgsProduct({{40, 80, 160, 320}, {1, 2}})
    ->UseManualTime()
    ->Unit(benchmark::kMillisecond)
    ->MinTime(4);

/// Size, hundredths of the friction; one thread.
void friction(benchmark::State& state)
{
    solve(state, static_cast<int>(state.range(0)), 0.01 * static_cast<double>(state.range(1)), 1e-8, 1);
}
BENCHMARK(friction)
    ->ArgsProduct({{20, 40, 80, 160, 320}, {20, 30, 50, 80, 100}})
    ->UseManualTime()
    ->Unit(benchmark::kMillisecond);

/// Size; the tolerance 1e-4, one thread.
void rough(benchmark::State& state)
{
    solve(state, static_cast<int>(state.range(0)), 0.65, 1e-4, 1);
}
BENCHMARK(rough)->Arg(40)->Arg(80)->Arg(160)->UseManualTime()->Unit(benchmark::kMillisecond)->MinTime(4);

/// Size; to 1e-6, two threads.
void million(benchmark::State& state)
{
    solve(state, static_cast<int>(state.range(0)), 0.65, 1e-6, 2);
}
BENCHMARK(million)->Arg(1000)->UseManualTime()->Unit(benchmark::kSecond)->Iterations(1);

} // namespace
} // namespace drystone
