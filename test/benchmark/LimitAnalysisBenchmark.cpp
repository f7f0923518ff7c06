// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Limit analysis in units of its own work: F is the time of one assembly, factorisation and solve of the
/// same Schur matrix, taken in the same run, with our own factor and with CHOLMOD's. All are minima over the
/// repetitions: a loaded machine makes every figure larger, never smaller.
///
///     build/test/LimitAnalysisBenchmark --benchmark_out=results.csv --benchmark_out_format=csv
#include "CholmodUnit.h"
#include "Peers.h"
#include "Walls.h"

#include "conic/UnitOfWork.h"

#include <benchmark/benchmark.h>

#include <chrono>
#include <fstream>
#include <limits>
#include <string>

namespace drystone
{
namespace
{

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

void solve(benchmark::State& state, const Assembly<2>& assembly, double tolerance)
{
    const PlaneConeProgram program = limitAnalysisOf(assembly);
    double unit = std::numeric_limits<double>::max();
    double cholmodUnit = std::numeric_limits<double>::max();
    double whole = std::numeric_limits<double>::max();
    LimitAnalysis result;
    for (auto _ : state)
    {
        unit = std::min(unit, unitOfWork(program));
        cholmodUnit = std::min(cholmodUnit, cholmodUnitOfWork(program));
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
    state.counters["CHOLMOD F[ms]"] = 1e3 * cholmodUnit;
    state.counters["solve[CHOLMOD F]"] = whole / cholmodUnit;
    state.counters["memory[GB]"] = peakMemory();
    if (result.status != CollapseStatus::optimal)
    {
        state.SkipWithError("not solved");
    }
}

void paperWall(benchmark::State& state)
{
    solve(state, drystone::paperWall(static_cast<int>(state.range(0))), 1e-9);
}
BENCHMARK(paperWall)->DenseRange(1, 6)->UseManualTime()->Unit(benchmark::kMillisecond)->MinTime(1);

void squareWall(benchmark::State& state)
{
    solve(state, drystone::squareWall(static_cast<int>(state.range(0))), 1e-8);
}
BENCHMARK(squareWall)
    ->Arg(20)
    ->Arg(40)
    ->Arg(80)
    ->Arg(160)
    ->Arg(320)
    ->UseManualTime()
    ->Unit(benchmark::kMillisecond)
    ->MinTime(4);

} // namespace
} // namespace drystone
