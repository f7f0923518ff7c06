// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Limit analysis in space: the paper's walls extruded, bonds that are hard to solve, a wall of 10,010 blocks
/// in two leaves, a solid pier of 21 x 21 x 21 blocks, and solvers of others on the same programs as far as
/// they are installed. Times are CPU times of the solvers alone; the certificate is ours for all. A program
/// that a solver does not finish in 300 s has NaN for a certificate.
///
///     build/test/SpaceBenchmark --benchmark_out=space.csv --benchmark_out_format=csv
#include "../MadeStructure.h"
#include "Context.h"
#include "Peers.h"

#include "assembly/Loads.h"
#include "conic/InteriorPoint.h"
#include "dictionary/Dictionary.h"
#include "statics/LimitAnalysis.h"

#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <cmath>
#include <functional>

namespace drystone
{
namespace
{

Assembly<3> structure(const std::string& texture)
{
    return madeStructure<3>(Dictionary::readString("dimensions 3; texture { " + texture
                                                       + " } supports { ground { type ground; } }",
                                                   "blockTextureDict"));
}

Assembly<3> extrudedWall(int number)
{
    const Dictionary dictionary = Dictionary::readFile(fmt::format(
        DRYSTONE_TUTORIALS "/limitAnalysis/masonryPanels/wall{}/system/blockTextureDict", number));
    return structure("type extrusion; of { " + toText(dictionary.subDict("texture")) + " } thickness 0.3;");
}

Assembly<3> bondedWall(const char* bond, int length, int courses)
{
    return structure(fmt::format("type walls; unit (0.24 0.12 0.08); bond {}; courses {}; "
                                 "walls {{ wall {{ from (0 0); length {}; }} }}",
                                 bond, courses, length));
}

/// With a course of headers through both leaves every so many courses, 0: none.
Assembly<3> twoLeafWall(int length, int courses, int headersEvery)
{
    return structure(fmt::format("type walls; unit (0.4 0.2 0.15); bond running; leaves 2; headersEvery {}; "
                                 "courses {}; walls {{ wall {{ from (0 0); length {}; }} }}",
                                 headersEvery, courses, length));
}

/// Cubes on cubes, all joints through.
Assembly<3> pier(int side)
{
    Assembly<3> assembly;
    for (int z = 0; z < side; ++z)
    {
        for (int y = 0; y < side; ++y)
        {
            for (int x = 0; x < side; ++x)
            {
                const Vector<3> corner(x, y, z);
                assembly.blocks.push_back({makeBox(corner, corner + Vector<3>(1, 1, 1)), -1});
            }
        }
    }
    const double s = side;
    assembly.blocks.push_back({makeBox({-s, -s, -1}, {2 * s, 2 * s, 0}), 0});
    assembly.supports = {{"ground", "ground"}};
    return assembly;
}

/// Each block's own weight, and alpha times it in the direction at an angle to x.
SpaceConeProgram pushed(const Assembly<3>& assembly, double mu, double angle)
{
    std::vector<double> masses;
    for (const BlockMass<3>& block : blockMasses(assembly))
    {
        masses.push_back(block.volume);
    }
    const Vector<3> gravity(0, 0, -1);
    const LoadVectors loads{gravityLoad(assembly, masses, gravity),
                            inertialLoad(assembly, masses, gravity, {std::cos(angle), std::sin(angle), 0})};
    const std::vector<ContactPoint<3>> points = findContactPoints(assembly);
    return limitAnalysisProgram(static_cast<int>(loads.dead.size()) / 6,
                                equilibriumColumns(assembly, blockMasses(assembly), points),
                                std::vector<double>(points.size(), mu), loads);
}

void analyse(benchmark::State& state, const SpaceConeProgram& program, double tolerance)
{
    LimitAnalysis result;
    double used = 0;
    for (auto _ : state)
    {
        const double start = cpuSeconds();
        result = solveLimitAnalysis(program, {.tolerance = tolerance});
        used = cpuSeconds() - start;
        state.SetIterationTime(used);
    }
    state.counters["blocks"] = program.bodies;
    state.counters["points"] = program.points();
    state.counters["alpha"] = result.alpha;
    state.counters["iterations"] = result.iterations;
    state.counters["factorisations"] = result.factorisations;
    state.counters["certificate"] = result.certificate.worst();
    state.counters["solve[s]"] = used;
    state.counters["memory[GB]"] = peakMemory();
    if (result.status != CollapseStatus::optimal)
    {
        state.SkipWithError("not solved");
    }
}

void extruded(benchmark::State& state)
{
    analyse(state, pushed(extrudedWall(static_cast<int>(state.range(0))), 0.65, 0), 1e-9);
}
BENCHMARK(extruded)->DenseRange(1, 6)->UseManualTime()->Unit(benchmark::kMillisecond);

/// In the direction of so many eighths of a turn.
void flemish(benchmark::State& state)
{
    analyse(state,
            pushed(bondedWall("flemish", static_cast<int>(state.range(0)), static_cast<int>(state.range(1))),
                   0.6, static_cast<double>(state.range(2)) * std::atan(1.0)),
            1e-9);
}
BENCHMARK(flemish)
    ->ArgNames({"length", "courses", "direction"})
    ->ArgsProduct({{6}, {10}, {0, 1, 2}})
    ->ArgsProduct({{5}, {14}, {0, 1, 2}})
    ->UseManualTime()
    ->Iterations(1)
    ->Unit(benchmark::kMillisecond);

void twoLeaves(benchmark::State& state)
{
    analyse(state, pushed(twoLeafWall(70, 71, static_cast<int>(state.range(0))), 0.6, 2 * std::atan(1.0)),
            1e-8);
}
BENCHMARK(twoLeaves)
    ->ArgName("headersEvery")
    ->Arg(0)
    ->Arg(3)
    ->UseManualTime()
    ->Iterations(1)
    ->Unit(benchmark::kMillisecond);

void solidPier(benchmark::State& state)
{
    analyse(state, pushed(pier(static_cast<int>(state.range(0))), 0.6, 0), 1e-8);
}
BENCHMARK(solidPier)->Arg(5)->Arg(11)->Arg(15)->Arg(21)->UseManualTime()->Iterations(1)->Unit(
    benchmark::kMillisecond);

struct Problem
{
    std::string name;
    std::function<SpaceConeProgram()> make;
};

const std::vector<Problem>& problems()
{
    static const std::vector<Problem> all{
        {"wall 1 extruded", [] { return pushed(extrudedWall(1), 0.65, 0); }},
        {"wall 6 extruded", [] { return pushed(extrudedWall(6), 0.65, 0); }},
        {"flemish 6 x 10", [] { return pushed(bondedWall("flemish", 6, 10), 0.6, std::atan(1.0)); }},
        {"flemish 5 x 14", [] { return pushed(bondedWall("flemish", 5, 14), 0.6, std::atan(1.0)); }},
        {"two leaves 16 x 18", [] { return pushed(twoLeafWall(16, 18, 3), 0.6, 2 * std::atan(1.0)); }},
        {"pier 7", [] { return pushed(pier(7), 0.6, 0); }}};
    return all;
}

std::vector<Peer> contestants()
{
    std::vector<Peer> all{
        {"interiorPoint", ContactLaw::associative,
         [](const AnyConeProgram& any, double tolerance) -> std::optional<PeerAnswer>
         {
             const double start = cpuSeconds();
             PeerAnswer answer{solveInteriorPoint(std::get<SpaceConeProgram>(any), {.tolerance = tolerance}),
                               0};
             answer.seconds = cpuSeconds() - start;
             return answer;
         }}};
    for (const std::optional<Peer>& peer : {cvxopt(), ecos(), qoco()})
    {
        if (peer)
        {
            all.push_back(*peer);
        }
    }
    return all;
}

void peers(benchmark::State& state)
{
    const Problem& problem = problems()[static_cast<std::size_t>(state.range(0))];
    const Peer peer = contestants()[static_cast<std::size_t>(state.range(1))];
    state.SetLabel(problem.name + ": " + peer.name);
    const SpaceConeProgram program = problem.make();
    std::optional<PeerAnswer> answer;
    for (auto _ : state)
    {
        answer = peer.solve(program, 1e-8);
        state.SetIterationTime(answer ? answer->seconds : 0);
    }
    if (!answer)
    {
        state.SkipWithError("not a problem of its kind");
        return;
    }
    state.counters["blocks"] = program.bodies;
    state.counters["points"] = program.points();
    state.counters["alpha"] = answer->solution.multiplier;
    state.counters["iterations"] = answer->solution.iterations;
    state.counters["factorisations"] = answer->solution.factorisations; // 0: not reported
    state.counters["memory[GB]"] = peakMemory();
    state.counters["certificate"] = certifyOptimal(program, answer->solution).worst();
    state.counters["solve[s]"] = answer->seconds;
}

void allPairs(benchmark::internal::Benchmark* benchmark)
{
    benchmark->ArgNames({"problem", "solver"})->UseManualTime()->Unit(benchmark::kMillisecond)->Iterations(1);
    for (std::size_t problem = 0; problem < problems().size(); ++problem)
    {
        for (std::size_t solver = 0; solver < contestants().size(); ++solver)
        {
            benchmark->Args({static_cast<long>(problem), static_cast<long>(solver)});
        }
    }
}
BENCHMARK(peers)->Apply(allPairs);

} // namespace
} // namespace drystone
