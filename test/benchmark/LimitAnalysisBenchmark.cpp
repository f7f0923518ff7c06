// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Limit analysis in units of its own work: F is the time of one assembly, factorisation and solve of the
/// same Schur matrix, taken in the same run. Both are minima over the repetitions: a loaded machine makes
/// every figure larger, never smaller.
///
///     build/test/LimitAnalysisBenchmark --benchmark_out=results.csv --benchmark_out_format=csv
#include "assembly/Loads.h"
#include "assembly/Materials.h"
#include "conic/UnitOfWork.h"
#include "statics/LimitAnalysis.h"
#include "texture/Texture.h"

#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <chrono>
#include <ctime>
#include <fstream>
#include <limits>
#include <string>

namespace drystone
{
namespace
{

double cpuSeconds()
{
    timespec now{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// Largest resident memory so far [GB].
double peakMemory()
{
    std::ifstream status("/proc/self/status");
    std::string word;
    double kilobytes = 0;
    while (status >> word)
    {
        if (word == "VmHWM:")
        {
            status >> kilobytes;
        }
    }
    return kilobytes / 1e6;
}

/// Dead and horizontal live load on the blocks of a texture dictionary, mu = 0.65.
PlaneConeProgram programOf(const Dictionary& dictionary)
{
    const Assembly<2> assembly = makeStructure(dictionary);
    const std::vector<BlockMass<2>> blocks = blockMasses(assembly);
    const std::vector<double> masses = massesOf(blocks, std::vector<double>(blocks.size(), 1000 / 9.81));
    const std::vector<ContactPoint<2>> points = findContactPoints(assembly);
    const Vector<2> gravity(0, -9.81);
    const LoadVectors loads{gravityLoad(assembly, masses, gravity),
                            inertialLoad(assembly, masses, gravity, {1, 0})};
    return limitAnalysisProgram(static_cast<int>(loads.dead.size()) / 3,
                                equilibriumColumns(assembly, blocks, points),
                                std::vector<double>(points.size(), 0.65), loads);
}

void solve(benchmark::State& state, const Dictionary& dictionary, double tolerance)
{
    const PlaneConeProgram program = programOf(dictionary);
    double unit = std::numeric_limits<double>::max();
    double whole = std::numeric_limits<double>::max();
    LimitAnalysis result;
    for (auto _ : state)
    {
        unit = std::min(unit, unitOfWork(program));
        const double start = cpuSeconds();
        result = solveLimitAnalysis(program, {.tolerance = tolerance});
        const double used = cpuSeconds() - start;
        whole = std::min(whole, used);
        state.SetIterationTime(used);
    }
    state.counters["blocks"] = program.bodies;
    state.counters["alpha"] = result.alpha;
    state.counters["iterations"] = result.iterations;
    state.counters["factorisations"] = result.factorisations;
    state.counters["solves"] = result.solves;
    state.counters["certificate"] = result.certificate.worst();
    state.counters["F[ms]"] = 1e3 * unit;
    state.counters["solve[ms]"] = 1e3 * whole;
    state.counters["solve[F]"] = whole / unit;
    state.counters["memory[GB]"] = peakMemory();
    if (result.status != CollapseStatus::optimal)
    {
        state.SkipWithError("not solved");
    }
}

void paperWall(benchmark::State& state)
{
    const auto file = fmt::format(
        DRYSTONE_TUTORIALS "/limitAnalysis/masonryPanels/wall{}/system/blockTextureDict", state.range(0));
    solve(state, Dictionary::readFile(file), 1e-9);
}
BENCHMARK(paperWall)->DenseRange(1, 6)->UseManualTime()->Unit(benchmark::kMillisecond)->MinTime(1);

/// A square running-bond wall: as many courses as the wall is units long.
void squareWall(benchmark::State& state)
{
    solve(state,
          Dictionary::readString(fmt::format(
              "texture {{ type runningBond; unit (0.4 0.175); length {0}; courses {0}; firstCourse full; }}\n"
              "supports {{ ground {{ type ground; segment 0.5; }} }}\n",
              state.range(0))),
          1e-8);
}
BENCHMARK(squareWall)
    ->Arg(20)
    ->Arg(40)
    ->Arg(80)
    ->Arg(160)
    ->UseManualTime()
    ->Unit(benchmark::kMillisecond)
    ->MinTime(0.1);

} // namespace
} // namespace drystone
