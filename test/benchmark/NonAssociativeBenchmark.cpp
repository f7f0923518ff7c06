// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// What Coulomb's law costs in limit analysis, over the associative law: 500 random walls with a window, the
/// six walls of the paper with more and more paths.
///
///     build/test/NonAssociativeBenchmark --benchmark_out=nonAssociative.csv --benchmark_out_format=csv
#include "coulombWalls/RandomWalls.h"
#include "statics/NonAssociative.h"

#include <benchmark/benchmark.h>

#include <ctime>

namespace drystone
{
namespace
{

double processorTime()
{
    timespec time{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

void randomWalls(benchmark::State& state)
{
    for (auto _ : state)
    {
        std::vector<double> ratios;
        int collapses = 0;
        int unstable = 0;
        for (unsigned number = 1; number <= 500; ++number)
        {
            const RandomWall wall = randomWall(number);
            const Structure structure = standing(wall.bond);
            const PlaneConeProgram program = structure.program(wall.friction, structure.weightLoads());
            const double start = processorTime();
            const LimitAnalysis associative = solveLimitAnalysis(program);
            const double middle = processorTime();
            if (associative.status == CollapseStatus::unstable)
            {
                ++unstable;
                continue;
            }
            const LimitAnalysis result =
                solveNonAssociative(program, {.starts = static_cast<int>(state.range(0))});
            ratios.push_back((processorTime() - middle) / (middle - start));
            collapses += result.coulomb->converged > 0;
        }
        std::sort(ratios.begin(), ratios.end());
        state.counters["walls"] = 500;
        state.counters["unstable"] = unstable;
        state.counters["collapses"] = collapses;
        state.counters["medianRatio"] = ratios[ratios.size() / 2];
        state.counters["ninetyPercent"] = ratios[ratios.size() * 9 / 10];
    }
}
BENCHMARK(randomWalls)->Arg(1)->Arg(2)->Unit(benchmark::kSecond)->Iterations(1);

void paperWall(benchmark::State& state)
{
    const Wall wall = paperWalls()[static_cast<std::size_t>(state.range(0)) - 1];
    const Structure structure = standing(wall.bond);
    const PlaneConeProgram program = structure.program(0.65, structure.weightLoads());
    LimitAnalysis result;
    for (auto _ : state)
    {
        result = solveNonAssociative(program, {.starts = static_cast<int>(state.range(1))});
    }
    state.counters["alpha"] = result.alpha;
    state.counters["associative"] = result.coulomb->associative;
    state.counters["converged"] = result.coulomb->converged;
    state.counters["worst"] = result.certificate.worst();
}
BENCHMARK(paperWall)
    ->ArgsProduct({{1, 2, 3, 4, 5, 6}, {1, 2, 8, 32}})
    ->Unit(benchmark::kMillisecond)
    ->Iterations(1);

} // namespace
} // namespace drystone
