// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The limits of each solver: steps of towers with mass ratios of 1 to 1e8, frictions of 0 to 3, 5 to 200
/// blocks, faces with 2 to 300 points per side, in the plane and in space. The label of a row is the case and
/// whether the solver reached the tolerance (1e-8 for the two exact solvers, 1e-4 for Gauss-Seidel).
///
///     build/test/HardCasesBenchmark --benchmark_out=hardCases.csv --benchmark_out_format=csv
#include "HardCases.h"

#include "conic/AugmentedLagrangian.h"
#include "conic/Certificate.h"
#include "conic/GaussSeidel.h"
#include "conic/InteriorPoint.h"

#include <benchmark/benchmark.h>

namespace drystone
{
namespace
{

/// Sweeps times contact points available to Gauss-Seidel: about a second.
constexpr double mostPointVisits = 4e6;

const std::vector<HardCase>& cases()
{
    static const std::vector<HardCase> all = hardCases();
    return all;
}

template<class Program, class Solve>
void measure(benchmark::State& state, const Program& program, double tolerance, const Solve& solve)
{
    ConeSolution solution;
    for (auto _ : state)
    {
        solution = solve(program, tolerance);
    }
    const Certificate certificate = certifyOptimal(program, solution);
    state.counters["value"] = cases()[static_cast<std::size_t>(state.range(0))].value;
    state.counters["iterations"] = solution.iterations;
    state.counters["factorisations"] = solution.factorisations;
    state.counters["certificate"] = certificate.worst();
    state.counters["solved"] = certificate.worst() <= tolerance ? 1 : 0;
    state.SetLabel(cases()[static_cast<std::size_t>(state.range(0))].name
                   + (certificate.worst() <= tolerance ? " solved" : " NOT SOLVED"));
}

template<class Solve>
void inBothSpaces(benchmark::State& state, double tolerance, const Solve& solve)
{
    const HardCase& hard = cases()[static_cast<std::size_t>(state.range(0))];
    if (state.range(1) == 2)
    {
        measure(state, planeStep(hard.tower, hard.alpha), tolerance, solve);
    }
    else
    {
        measure(state, spaceStep(hard.tower, hard.alpha), tolerance, solve);
    }
}

void interiorPoint(benchmark::State& state)
{
    inBothSpaces(state, 1e-8,
                 [](const auto& program, double tolerance)
                 { return solveInteriorPoint(program, {.tolerance = tolerance}); });
}

void augmentedLagrangian(benchmark::State& state)
{
    inBothSpaces(state, 1e-8,
                 [](const auto& program, double tolerance) {
                     return solveAugmentedLagrangian(program, {},
                                                     {.tolerance = tolerance, .maximumIterations = 4000});
                 });
}

void gaussSeidel(benchmark::State& state)
{
    inBothSpaces(state, 1e-4,
                 [](const auto& program, double tolerance)
                 {
                     const int sweeps = static_cast<int>(mostPointVisits / program.points());
                     return solveGaussSeidel(program, {},
                                             {.tolerance = tolerance, .maximumIterations = sweeps});
                 });
}

void allCases(benchmark::internal::Benchmark* benchmark)
{
    benchmark->ArgNames({"case", "dimensions"})->Unit(benchmark::kMillisecond)->Iterations(1);
    for (std::size_t index = 0; index < cases().size(); ++index)
    {
        benchmark->Args({static_cast<long>(index), 2})->Args({static_cast<long>(index), 3});
    }
}
BENCHMARK(interiorPoint)->Apply(allCases);
BENCHMARK(augmentedLagrangian)->Apply(allCases);
BENCHMARK(gaussSeidel)->Apply(allCases);

} // namespace
} // namespace drystone
