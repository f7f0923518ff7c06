// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// What the third dimension costs: walls of the plane and the same walls lifted into space (each contact
/// point two, 0.1 m in front of the plane and behind it, round friction cones), without strengths and with.
/// Both in turn, the least CPU time of the repetitions of each; `ratio` is that of space to that of the
/// plane, and `difference` that of the multipliers.
///
///     build/test/LiftedWallsBenchmark --benchmark_out=liftedWalls.csv --benchmark_out_format=csv
#include "Peers.h"
#include "Walls.h"

#include "Lifted.h"
#include "conic/Certificate.h"
#include "conic/InteriorPoint.h"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace drystone
{
namespace
{

void compare(benchmark::State& state, PlaneConeProgram plane, double tolerance)
{
    if (state.range(1) != 0)
    {
        plane.strength.assign(static_cast<std::size_t>(plane.points()), {30, 10, 3000}); // [N]
    }
    const SpaceConeProgram space = lifted(plane);
    ConeSolution ofPlane;
    ConeSolution ofSpace;
    double inPlane = std::numeric_limits<double>::max();
    double inSpace = std::numeric_limits<double>::max();
    for (auto _ : state)
    {
        const double start = cpuSeconds();
        ofPlane = solveInteriorPoint(plane, {.tolerance = tolerance});
        const double middle = cpuSeconds();
        ofSpace = solveInteriorPoint(space, {.tolerance = tolerance});
        const double used = cpuSeconds() - middle;
        inPlane = std::min(inPlane, middle - start);
        inSpace = std::min(inSpace, used);
        state.SetIterationTime(used);
    }
    state.counters["blocks"] = plane.bodies;
    state.counters["plane alpha"] = ofPlane.multiplier;
    state.counters["difference"] = std::abs(ofSpace.multiplier - ofPlane.multiplier);
    state.counters["certificate"] = certifyOptimal(space, ofSpace).worst();
    state.counters["plane factorisations"] = ofPlane.factorisations;
    state.counters["space factorisations"] = ofSpace.factorisations;
    state.counters["plane[ms]"] = 1e3 * inPlane;
    state.counters["space[ms]"] = 1e3 * inSpace;
    state.counters["ratio"] = inSpace / inPlane;
    if (ofPlane.status != SolveStatus::optimal || ofSpace.status != SolveStatus::optimal)
    {
        state.SkipWithError("not solved");
    }
}

void liftedPaperWall(benchmark::State& state)
{
    compare(state, limitAnalysisOf(paperWall(static_cast<int>(state.range(0)))), 1e-9);
}
BENCHMARK(liftedPaperWall)
    ->ArgNames({"wall", "strengths"})
    ->ArgsProduct({{1, 2, 3, 4, 5, 6}, {0, 1}})
    ->UseManualTime()
    ->Unit(benchmark::kMillisecond);

void liftedSquareWall(benchmark::State& state)
{
    compare(state, limitAnalysisOf(squareWall(static_cast<int>(state.range(0)))), 1e-8);
}
BENCHMARK(liftedSquareWall)
    ->ArgNames({"units", "strengths"})
    ->ArgsProduct({{20, 40, 80}, {0, 1}})
    ->UseManualTime()
    ->Iterations(3)
    ->Unit(benchmark::kMillisecond);

} // namespace
} // namespace drystone
