// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// What Coulomb's law costs in limit analysis, over the associative law: 500 random walls with a window, the
/// six walls of the paper with more and more paths, a house and a dome that are pushed in five directions.
///
///     build/test/NonAssociativeBenchmark --benchmark_out=nonAssociative.csv --benchmark_out_format=csv
#include "../MadeStructure.h"
#include "coulombWalls/RandomWalls.h"
#include "dictionary/Dictionary.h"
#include "space/SpaceStructures.h"
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

/// The same counters for all, as one table needs. \param ratios of times \param sums of multipliers
void report(benchmark::State& state, std::vector<double> ratios, int collapses, int unstable,
            const LimitAnalysis& sums)
{
    std::sort(ratios.begin(), ratios.end());
    state.counters["walls"] = static_cast<double>(ratios.size()) + unstable;
    state.counters["unstable"] = unstable;
    state.counters["collapses"] = collapses;
    state.counters["medianRatio"] = ratios[ratios.size() / 2];
    state.counters["ninetyPercent"] = ratios[ratios.size() * 9 / 10];
    state.counters["alpha"] = sums.alpha;
    state.counters["associative"] = sums.coulomb->associative;
}

void randomWalls(benchmark::State& state)
{
    for (auto _ : state)
    {
        std::vector<double> ratios;
        int collapses = 0;
        int unstable = 0;
        LimitAnalysis total;
        total.coulomb.emplace();
        for (unsigned number = 1; number <= 500; ++number)
        {
            const RandomWall wall = randomWall(number);
            const WeighedStructure structure = standing(wall.bond);
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
            total.alpha += result.alpha;
            total.coulomb->associative += associative.alpha;
        }
        report(state, std::move(ratios), collapses, unstable, total);
    }
}
BENCHMARK(randomWalls)->Arg(1)->Arg(2)->Unit(benchmark::kSecond)->Iterations(1);

void paperWall(benchmark::State& state)
{
    const Wall wall = paperWalls()[static_cast<std::size_t>(state.range(0)) - 1];
    const WeighedStructure structure = standing(wall.bond);
    const PlaneConeProgram program = structure.program(0.65, structure.weightLoads());
    for (auto _ : state)
    {
        const double start = processorTime();
        solveLimitAnalysis(program);
        const double middle = processorTime();
        const LimitAnalysis result =
            solveNonAssociative(program, {.starts = static_cast<int>(state.range(1))});
        report(state, {(processorTime() - middle) / (middle - start)}, result.coulomb->converged, 0, result);
    }
}
BENCHMARK(paperWall)
    ->ArgsProduct({{1, 2, 3, 4, 5, 6}, {1, 2, 8, 32}})
    ->Unit(benchmark::kMillisecond)
    ->Iterations(1);

void buildingInSpace(benchmark::State& state)
{
    const bool isHouse = state.range(0) == 0;
    state.SetLabel(isHouse ? "house with door" : "dome with oculus");
    const Dictionary dictionary = Dictionary::readFile(std::string(DRYSTONE_SPACE_REFERENCES) + "/"
                                                       + (isHouse ? "houseWithDoor" : "domeWithOculus"));
    const Assembly<3> assembly = madeStructure<3>(dictionary.subDict("blockTextureDict"));
    const auto points = findContactPoints(assembly);
    const double friction = 0.01 * static_cast<double>(state.range(1));
    for (auto _ : state)
    {
        std::vector<double> ratios;
        int collapses = 0;
        LimitAnalysis total;
        total.coulomb.emplace();
        for (const double angle : {0.0, 0.7, 1.5707963, 2.3, 3.9})
        {
            const auto program = test::programOf(
                assembly, points, friction, test::pushed(assembly, {std::cos(angle), std::sin(angle), 0}));
            const double start = processorTime();
            const LimitAnalysis associative = solveLimitAnalysis(program);
            const double middle = processorTime();
            const LimitAnalysis result = solveNonAssociative(program);
            ratios.push_back((processorTime() - middle) / (middle - start));
            collapses += result.coulomb->converged > 0;
            total.alpha += result.alpha;
            total.coulomb->associative += associative.alpha;
        }
        report(state, std::move(ratios), collapses, 0, total);
    }
}
BENCHMARK(buildingInSpace)->ArgsProduct({{0, 1}, {30, 50}})->Unit(benchmark::kSecond)->Iterations(1);

} // namespace
} // namespace drystone
