// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Limit analysis in units of its own work: F is the time of one assembly, factorisation and solution of the
/// same Schur matrix, measured in the same run, with our own factor and with that of CHOLMOD. All are minima
/// over the repetitions, since a loaded machine makes every figure larger, never smaller. Then the same for
/// walls under 1.5 times the feasible load: the proof that they are unstable.
///
///     build/test/LimitAnalysisBenchmark --benchmark_out=results.csv --benchmark_out_format=csv
#include "CholmodUnit.h"
#include "Context.h"
#include "Peers.h"
#include "Walls.h"

#include "conic/Certificate.h"
#include "conic/InteriorPoint.h"
#include "conic/UnitOfWork.h"

#include <benchmark/benchmark.h>

#include <chrono>
#include <limits>
#include <string>

namespace drystone
{
namespace
{

/// A solution and its cost.
struct Outcome
{
    double alpha = 0;
    int iterations = 0;
    int factorisations = 0;
    int solves = 0;
    double certificate = 0; ///< its worst figure
    bool isExpected = false;
};

template<class Solve>
void measure(benchmark::State& state, const PlaneConeProgram& program, const Solve& solve)
{
    double unit = std::numeric_limits<double>::max();
    double cholmodUnit = std::numeric_limits<double>::max();
    double whole = std::numeric_limits<double>::max();
    Outcome result;
    for (auto _ : state)
    {
        unit = std::min(unit, unitOfWork(program));
        cholmodUnit = std::min(cholmodUnit, cholmodUnitOfWork(program));
        const double start = cpuSeconds();
        result = solve();
        const double used = cpuSeconds() - start;
        whole = std::min(whole, used);
        state.SetIterationTime(used);
    }
    state.counters["blocks"] = program.bodies;
    state.counters["alpha"] = result.alpha;
    state.counters["iterations"] = result.iterations;
    state.counters["factorisations"] = result.factorisations;
    state.counters["solves"] = result.solves;
    state.counters["certificate"] = result.certificate;
    state.counters["F[ms]"] = 1e3 * unit;
    state.counters["solve[ms]"] = 1e3 * whole;
    state.counters["solve[F]"] = whole / unit;
    state.counters["CHOLMOD F[ms]"] = 1e3 * cholmodUnit;
    state.counters["solve[CHOLMOD F]"] = whole / cholmodUnit;
    state.counters["memory[GB]"] = peakMemory();
    if (!result.isExpected)
    {
        state.SkipWithError("not solved");
    }
}

void analyse(benchmark::State& state, const Assembly<2>& assembly, double tolerance)
{
    const PlaneConeProgram program = limitAnalysisOf(assembly);
    measure(state, program,
            [&]() -> Outcome
            {
                const LimitAnalysis found = solveLimitAnalysis(program, {.tolerance = tolerance});
                return {found.alpha,  found.iterations,          found.factorisations,
                        found.solves, found.certificate.worst(), found.status == CollapseStatus::optimal};
            });
}

void paperWall(benchmark::State& state)
{
    analyse(state, drystone::paperWall(static_cast<int>(state.range(0))), 1e-9);
}
BENCHMARK(paperWall)->DenseRange(1, 6)->UseManualTime()->Unit(benchmark::kMillisecond)->MinTime(1);

void squareWall(benchmark::State& state)
{
    analyse(state, drystone::squareWall(static_cast<int>(state.range(0))), 1e-8);
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

/// The limit analysis of a wall of the paper, 1 to 6, or of a square one.
PlaneConeProgram pushedWall(const benchmark::State& state)
{
    const auto number = static_cast<int>(state.range(0));
    return limitAnalysisOf(number <= 6 ? drystone::paperWall(number) : drystone::squareWall(number));
}

/// The proof that a program has no solution.
void prove(benchmark::State& state, const PlaneConeProgram& program, SolveStatus status)
{
    measure(state, program,
            [&]() -> Outcome
            {
                const ConeSolution found = solveInteriorPoint(program, {.tolerance = 1e-8});
                return {0,
                        found.iterations,
                        found.factorisations,
                        found.solves,
                        certify(program, found).worst(),
                        found.status == status};
            });
}

/// Loaded by 1.5 times the feasible load.
void wallThatFalls(benchmark::State& state)
{
    PlaneConeProgram program = pushedWall(state);
    program.load += 1.5 * solveLimitAnalysis(program, {}).alpha * program.liveLoad;
    program.liveLoad.resize(0);
    prove(state, program, SolveStatus::infeasible);
}

/// Loaded downwards, with a tenth of that from the side.
void wallWithoutLimit(benchmark::State& state)
{
    PlaneConeProgram program = pushedWall(state);
    program.liveLoad = program.load + 0.1 * program.liveLoad;
    prove(state, program, SolveStatus::unbounded);
}

void walls(benchmark::internal::Benchmark* benchmark)
{
    benchmark->DenseRange(1, 6)->Arg(20)->Arg(40)->Arg(80)->UseManualTime()->Unit(benchmark::kMillisecond);
    benchmark->MinTime(1);
}
BENCHMARK(wallThatFalls)->Apply(walls);
BENCHMARK(wallWithoutLimit)->Apply(walls);

} // namespace
} // namespace drystone
