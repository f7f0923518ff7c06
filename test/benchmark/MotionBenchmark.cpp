// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// One simulated second of the paper's walls in steps of 0.002 s, on a ground that accelerates at 0.8 and 1.1
/// times the collapse multiplier: CPU time per simulated second (the paper: 80 to 214 s), factorisations and
/// cone programs per step, and the fraction of the run that writing adds every ten steps. Then the same with
/// small displacements and steps certified to 1e-6 (all six walls and one of 80 x 80 units, nothing written),
/// and Coulomb's law, restitution, walls of rubble, and walls that stand. The unit of work F is that of
/// LimitAnalysisBenchmark: the Schur system of a step has the pattern of that of limit analysis.
///
///     build/test/MotionBenchmark --benchmark_out=results.csv --benchmark_out_format=csv
#include "../MadeStructure.h"
#include "CholmodUnit.h"
#include "Peers.h"
#include "Walls.h"

#include "assembly/AssemblyFile.h"
#include "conic/UnitOfWork.h"
#include "core/WholeFile.h"
#include "dynamics/Advance.h"
#include "functionObjects/MotionResults.h"
#include "runControl/Application.h"
#include "runControl/CommandLine.h"

#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <limits>

namespace drystone
{
namespace
{

constexpr int largeWall = 80; // units; its multiplier:
constexpr double largeMultiplier = 0.43059535;
constexpr int mediumWall = 20; // likewise
constexpr double mediumMultiplier = 0.50720395;
constexpr int widerWall = 40; // likewise
constexpr double widerMultiplier = 0.45306787;

double multiplierOf(long wall)
{
    return wall <= 6            ? paperMultipliers[wall - 1]
           : wall == mediumWall ? mediumMultiplier
           : wall == widerWall  ? widerMultiplier
                                : largeMultiplier;
}

/// The case of a structure in a folder of its own, with the properties of one of the paper's walls.
/// \param acceleration of the ground [m/s2] \param endTime [s]
std::filesystem::path makeCase(const std::string& name, const Assembly<2>& assembly, int propertiesOf,
                               double acceleration, double endTime)
{
    const std::filesystem::path source =
        fmt::format(DRYSTONE_TUTORIALS "/contactDynamics/masonryPanels/wall{}", propertiesOf);
    const std::filesystem::path folder =
        std::filesystem::temp_directory_path() / ("drystoneMotionBenchmark" + name);
    std::filesystem::remove_all(folder);
    std::filesystem::create_directories(folder / "constant");
    for (const char* file : {"contactProperties", "g", "materialProperties"})
    {
        std::filesystem::copy(source / "constant" / file, folder / "constant" / file);
    }
    std::filesystem::create_directories(folder / "system");
    std::ofstream(folder / "system/controlDict") << fmt::format(
        "application contactDynamics; startFrom startTime; startTime 0; endTime {}; deltaT 0.002;\n"
        "writeControl timeStep; writeInterval 10; purgeWrite 1;\n",
        endTime);
    std::ofstream(folder / "constant/groundMotion")
        << fmt::format("direction (-1 0 0); acceleration {{ type constant; value {}; }}\n", acceleration);
    writeWholeFile(assemblyFile(folder), assemblyText(assembly));
    return folder;
}

/// A second of a wall, 1 to 6, `mediumWall` or `largeWall`, the ground at `share` of the collapse multiplier.
std::filesystem::path makeCase(long wall, double share)
{
    const auto number = static_cast<int>(wall);
    return makeCase(fmt::to_string(wall), wall <= 6 ? paperWall(number) : squareWall(number),
                    wall <= 6 ? number : 6, share * multiplierOf(wall) * 9.81, 1);
}

/// Runs a scene and reports the cost of a step. \param writes whether the application's results are written
void run(benchmark::State& state, const std::filesystem::path& folder, const DynamicCase<2>& scene,
         bool writes)
{
    keepFreedMemory(); // as applications do
    const PlaneConeProgram statics = limitAnalysisOf(scene.assembly);
    double factorisations = 0;
    double programs = 0;
    std::vector<int> ofSteps; // factorisations of each
    long steps = 0;
    double used = 0;
    double simulated = 0;
    double least = std::numeric_limits<double>::max();
    double unit = std::numeric_limits<double>::max();
    double cholmodUnit = std::numeric_limits<double>::max();
    for (auto _ : state)
    {
        unit = std::min(unit, unitOfWork(statics));
        cholmodUnit = std::min(cholmodUnit, cholmodUnitOfWork(statics));
        Time time(folder, ControlDict::required);
        Motion<2> motion = startMotion(scene, stateAtRest(scene.assembly));
        MotionResults results(folder, scene, motion, time, FunctionObjects::none);
        const double start = cpuSeconds();
        while (time.loop())
        {
            if (!advance(scene, motion, time))
            {
                state.SkipWithError("a step was not solved");
                return;
            }
            if (writes)
            {
                results.write();
            }
            factorisations += motion.residuals.factorisations;
            ofSteps.push_back(motion.residuals.factorisations);
            programs += motion.residuals.programs;
            ++steps;
        }
        used = cpuSeconds() - start;
        simulated = time.value();
        least = std::min(least, used);
        state.SetIterationTime(used);
    }
    const double stepsOfRun = static_cast<double>(steps) / static_cast<double>(state.iterations());
    state.counters["CPU[s/s]"] = least / simulated;
    state.counters["F[ms]"] = 1e3 * unit;
    state.counters["step[ms]"] = 1e3 * least / stepsOfRun;
    state.counters["step[F]"] = least / stepsOfRun / unit;
    state.counters["CHOLMOD F[ms]"] = 1e3 * cholmodUnit;
    state.counters["step[CHOLMOD F]"] = least / stepsOfRun / cholmodUnit;
    state.counters["factorisations/step"] = factorisations / static_cast<double>(steps);
    std::nth_element(ofSteps.begin(), ofSteps.begin() + steps / 2, ofSteps.end());
    state.counters["median factorisations"] = ofSteps[static_cast<std::size_t>(steps / 2)];
    state.counters["programs/step"] = programs / static_cast<double>(steps);
    std::filesystem::remove_all(folder);
}

void simulate(benchmark::State& state)
{
    const std::filesystem::path folder = makeCase(state.range(0), 0.01 * static_cast<double>(state.range(1)));
    run(state, folder, readDynamicCase<2>(folder), state.range(2) > 0);
}
BENCHMARK(simulate)
    ->ArgNames({"wall", "percent", "writes"})
    ->ArgsProduct({{1, 6}, {80, 110}, {0, 1}})
    ->UseManualTime()
    ->Unit(benchmark::kSecond);

void smallDisplacementsTo1em6(benchmark::State& state)
{
    const std::filesystem::path folder = makeCase(state.range(0), 0.01 * static_cast<double>(state.range(1)));
    DynamicCase<2> scene = readDynamicCase<2>(folder);
    scene.schemes.smallDisplacements = true;
    scene.solution.tolerance = 1e-6;
    run(state, folder, scene, false);
}
BENCHMARK(smallDisplacementsTo1em6)
    ->ArgNames({"wall", "percent"})
    ->ArgsProduct({{1, 2, 3, 4, 5, 6, largeWall}, {80, 110}})
    ->UseManualTime()
    ->Unit(benchmark::kSecond);

/// The same collapse by either flow rule, so that their costs can be compared in one run.
void flowRules(benchmark::State& state)
{
    const std::filesystem::path folder = makeCase(state.range(0), 1.1);
    DynamicCase<2> scene = readDynamicCase<2>(folder);
    scene.contact.friction->flowRule = state.range(1) > 0 ? FlowRule::nonAssociative : FlowRule::associative;
    run(state, folder, scene, false);
}
BENCHMARK(flowRules)
    ->ArgNames({"wall", "coulomb"})
    ->ArgsProduct({{1, 2, 3, 4, 5, 6, mediumWall}, {0, 1}})
    ->Args({widerWall, 0})
    ->Iterations(1)
    ->UseManualTime()
    ->Unit(benchmark::kSecond);

/// The same collapse with restitution in hundredths, whose impacts cost in addition to friction.
void restitution(benchmark::State& state)
{
    const std::filesystem::path folder = makeCase(state.range(0), 1.1);
    DynamicCase<2> scene = readDynamicCase<2>(folder);
    scene.contact.friction->flowRule = state.range(1) > 0 ? FlowRule::nonAssociative : FlowRule::associative;
    if (state.range(2) > 0)
    {
        scene.contact.restitution = Restitution{0.01 * static_cast<double>(state.range(2))};
    }
    run(state, folder, scene, false);
}
BENCHMARK(restitution)
    ->ArgNames({"wall", "coulomb", "percent"})
    ->ArgsProduct({{1, 2, 3, 4, 5, 6}, {0, 1}, {0, 30}})
    ->Iterations(1)
    ->UseManualTime()
    ->Unit(benchmark::kSecond);

/// Of walls of rubble, 5 m by 3 m, which many ways through a step do not arrive in: the seed, and friction
/// and ground that tests of the same seeds have met lost steps with.
struct RubbleWall
{
    int seed;
    int stones;
    double mu;
    double acceleration; ///< [m/s2]
};
constexpr std::array<RubbleWall, 4> rubbleWalls{
    {{7, 100, 0.7, 3}, {11, 150, 0.8, 1.5}, {5, 200, 0.5, 2}, {9, 300, 0.4, 1}}};

/// The first 50 steps in which rubble moves, by either flow rule.
void rubble(benchmark::State& state)
{
    const auto& wall = *std::find_if(rubbleWalls.begin(), rubbleWalls.end(),
                                     [&](const RubbleWall& own) { return own.stones == state.range(0); });
    const Assembly<2> assembly = madeStructure(Dictionary::readString(
        fmt::format("texture {{ type rubble; size (5 3); thickness 0.5; stones {}; seed {}; }} "
                    "supports {{ ground {{ type ground; }} }}",
                    wall.stones, wall.seed)));
    const std::filesystem::path folder = makeCase("Rubble", assembly, 6, wall.acceleration, 0.1);
    DynamicCase<2> scene = readDynamicCase<2>(folder);
    scene.contact.friction =
        CoulombFriction{wall.mu, state.range(1) > 0 ? FlowRule::nonAssociative : FlowRule::associative};
    run(state, folder, scene, false);
}
BENCHMARK(rubble)
    ->ArgNames({"stones", "coulomb"})
    ->ArgsProduct({{100, 150, 200, 300}, {0, 1}})
    ->Iterations(1)
    ->UseManualTime()
    ->Unit(benchmark::kSecond);

/// Walls that stand, by Coulomb's law, under a share of their multiplier.
void standing(benchmark::State& state)
{
    const std::filesystem::path folder = makeCase(state.range(0), 0.01 * static_cast<double>(state.range(1)));
    DynamicCase<2> scene = readDynamicCase<2>(folder);
    scene.contact.friction->flowRule = FlowRule::nonAssociative;
    run(state, folder, scene, false);
}
BENCHMARK(standing)
    ->ArgNames({"wall", "percent"})
    ->ArgsProduct({{1, 2, 3, 4, 5, 6, mediumWall}, {80, 98}})
    ->Iterations(1)
    ->UseManualTime()
    ->Unit(benchmark::kSecond);

} // namespace
} // namespace drystone
