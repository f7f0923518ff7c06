// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// What `selection automatic` saves in limit analysis: one structure under many live loads in turn, each on
/// one block, solved with all blocks and with the part that the load reaches (all blocks where no part stands
/// for them), one after the other in one run.
///
/// Columns: loads; milliseconds of the processor a load of both, the dead load that is carried once included;
/// their ratio; loads answered by a part; blocks, and those of the parts, mean; largest relative difference
/// of the multipliers.
///
///     build/test/ReachedPartBenchmark --benchmark_out=reachedPart.csv --benchmark_out_format=csv
#include "statics/ReachedPart.h"

#include "../statics/LocalLoads.h"
#include "conic/form/Form.h"
#include "core/Log.h"

#include <benchmark/benchmark.h>

namespace drystone
{
namespace
{

template<int Dim>
using Programs = std::vector<StaticProgram<Dim>>;

/// Loads of 1 kN on blocks evenly from one to another, the last included.
template<int Dim>
Programs<Dim> forcesOn(const Assembly<Dim>& assembly, double mu, int from, int to, int count,
                       const std::type_identity_t<Vector<Dim>>& direction)
{
    Programs<Dim> programs;
    for (int i = 0; i < count; ++i)
    {
        programs.push_back(
            underForce<Dim>(assembly, mu, from + (to - from) * i / std::max(1, count - 1), direction));
    }
    return programs;
}

template<int Dim>
void compare(benchmark::State& state, const Programs<Dim>& programs)
{
    constexpr double tolerance = 1e-9;
    for (auto _ : state)
    {
        std::vector<double> multipliers;
        SymbolicAnalysis symbolic;
        double start = cpuTime();
        for (const StaticProgram<Dim>& program : programs)
        {
            multipliers.push_back(solveLimitAnalysis(program, {.tolerance = tolerance}, &symbolic).alpha);
        }
        const double all = cpuTime() - start;
        SymbolicAnalysis kept;
        CarriedDeadLoad<freedomCount<Dim>, Dim> carried;
        int answered = 0;
        double blocks = 0;
        double difference = 0;
        start = cpuTime();
        for (std::size_t i = 0; i < programs.size(); ++i)
        {
            std::optional<LimitAnalysis> answer =
                analyseReachedPart(programs[i], {.tolerance = tolerance}, carried, kept);
            if (answer)
            {
                ++answered;
                blocks += simulatedBlocks(*answer);
            }
            else
            {
                answer = solveLimitAnalysis(programs[i], {.tolerance = tolerance}, &kept);
            }
            difference = std::max(difference, std::abs(answer->alpha - multipliers[i])
                                                  / std::max(1e-300, std::abs(multipliers[i])));
        }
        const double parts = cpuTime() - start;
        const auto loads = static_cast<double>(programs.size());
        state.counters["loads"] = loads;
        state.counters["blocks"] = programs.front().bodies;
        state.counters["all[ms]"] = 1000 * all / loads;
        state.counters["automatic[ms]"] = 1000 * parts / loads;
        state.counters["ratio"] = all / parts;
        state.counters["answered"] = answered;
        state.counters["part[blocks]"] = blocks / std::max(1, answered);
        state.counters["difference"] = difference;
    }
}

/// A load on each second voussoir of a span in the middle. \param spans
void viaductUnderALoad(benchmark::State& state)
{
    const auto spans = static_cast<int>(state.range(0));
    const int first = spans / 2 * voussoirsOfSpan;
    compare<2>(state, forcesOn<2>(viaduct(spans), 0.7, first + 3, first + 21, 10, {0, -1}));
}
BENCHMARK(viaductUnderALoad)->Arg(10)->Arg(40)->Arg(160)->Iterations(1)->Unit(benchmark::kMillisecond);

/// A stone of the top course pulled along and up, one after another. \param units and courses
void stonesOfAWall(benchmark::State& state)
{
    const Assembly<2> assembly = squareWall(static_cast<int>(state.range(0)));
    const int last = freeBlocksOf(assembly) - 1;
    compare<2>(state, forcesOn<2>(assembly, 0.65, last - 9, last, 10, {1, 0.2}));
}
BENCHMARK(stonesOfAWall)->Arg(20)->Arg(40)->Arg(100)->Iterations(1)->Unit(benchmark::kMillisecond);

/// A load that pushes a stone in the middle of the height of a wall along, which no part stands for.
void stonesWithinAWall(benchmark::State& state)
{
    const Assembly<2> assembly = squareWall(static_cast<int>(state.range(0)));
    const int middle = freeBlocksOf(assembly) / 2;
    compare<2>(state, forcesOn<2>(assembly, 0.65, middle, middle + 4, 5, {1, 0}));
}
BENCHMARK(stonesWithinAWall)->Arg(40)->Iterations(1)->Unit(benchmark::kMillisecond);

/// In space stones on top of two walls, pushed out.
void stonesOfAHouse(benchmark::State& state)
{
    const Assembly<3> assembly = cornerOfHouse();
    const int last = freeBlocksOf(assembly) - 1;
    compare<3>(state, forcesOn<3>(assembly, 0.6, last - 9, last, 10, {0.3, 1, 0.2}));
}
BENCHMARK(stonesOfAHouse)->Iterations(1)->Unit(benchmark::kMillisecond);

} // namespace
} // namespace drystone
