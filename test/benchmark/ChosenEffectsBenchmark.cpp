// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// What `selection automatic` of system/schemes/effects saves: the same motions with everything on and with
/// the effects that each step calls for, one after the other in one run. Walls and a house of space that
/// stand under a ground that shakes below their multiplier, the house also under records; a wall of 100 x 100
/// units of which stones on top fall, more and more of them, or a corner, larger and larger; columns of the
/// plane and of space that rock; and the paper's wall 6 as it collapses by Coulomb's law, compared with sets
/// of effects chosen by hand.
///
/// Columns: milliseconds of the processor a step of both, their ratio, the largest distance between the two
/// motions at the end [m], the shares of the blocks that a step simulated and of the bodies that these were.
///
///     build/test/ChosenEffectsBenchmark --benchmark_out=chosenEffects.csv --benchmark_out_format=csv
#include "../MadeStructure.h"
#include "../dynamics/SceneGravity.h"
#include "../statics/LocalLoads.h"
#include "contact/Equilibrium.h"
#include "core/Log.h"
#include "dynamics/Advance.h"
#include "dynamics/VerifiedStep.h"
#include "effects/GroundMotion.h"
#include "effects/MassDamping.h"
#include "runControl/Application.h"
#include "statics/LimitAnalysis.h"
#include "timeSeries/GroundAcceleration.h"
#include "timeSeries/Record.h"

#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <numbers>
#include <random>
#include <stdexcept>

namespace drystone
{
namespace
{

constexpr double weight = 9.81;

template<int Dim>
DynamicCase<Dim> sceneOf(Assembly<Dim> assembly, double mu, FlowRule flowRule)
{
    DynamicCase<Dim> scene;
    const std::vector<double> densities(assembly.blocks.size(), 2000);
    setStructure(scene, std::move(assembly), densities);
    setGravity(scene, -weight * Vector<Dim>::Unit(Dim - 1));
    scene.contact.friction = CoulombFriction{mu, flowRule};
    return scene;
}

template<int Dim>
void shake(DynamicCase<Dim>& scene, std::shared_ptr<const GroundAcceleration> acceleration)
{
    GroundMotion::Component component;
    component.acceleration = std::move(acceleration);
    setGroundMotion<Dim>(scene.effects, {{component}});
}

template<int Dim>
void shake(DynamicCase<Dim>& scene, double amplitude)
{
    shake(scene, std::make_shared<SinePulse>(PulseShape{amplitude, 2, 0}, 8));
}

/// A motion and what it has taken.
template<int Dim>
struct Run
{
    Motion<Dim> motion;
    double seconds = 0;
    double awake = 0;  ///< share of the blocks, summed over the steps
    double bodies = 0; ///< likewise
};

template<int Dim>
Run<Dim> run(const DynamicCase<Dim>& scene, double timeStep, int steps)
{
    Run<Dim> taken{startMotion(scene, stateAtRest(scene.assembly))};
    const double share = freedomCount<Dim> / static_cast<double>(scene.mass.size());
    const double start = cpuTime();
    for (int step = 0; step < steps; ++step)
    {
        if (!advance(scene, taken.motion, timeStep))
        {
            throw std::runtime_error("a step was not solved");
        }
        taken.awake += share * static_cast<double>(awakeBlocks(taken.motion));
        taken.bodies += share * static_cast<double>(simulatedBodies(taken.motion));
    }
    taken.seconds = cpuTime() - start;
    return taken;
}

/// Takes the same steps both ways, in turn. \param turns of which the least time counts
template<int Dim>
void compare(benchmark::State& state, DynamicCase<Dim> scene, double timeStep, int steps, int turns = 1)
{
    keepFreedMemory(); // as applications do
    for (auto _ : state)
    {
        std::array<Run<Dim>, 2> runs;
        for (int turn = 0; turn < turns; ++turn)
        {
            for (const EffectSelection selection : {EffectSelection::asGiven, EffectSelection::automatic})
            {
                scene.schemes.effects.selection = selection;
                Run<Dim> taken = run(scene, timeStep, steps);
                Run<Dim>& least = runs[selection == EffectSelection::automatic];
                if (turn == 0 || taken.seconds < least.seconds)
                {
                    least = std::move(taken);
                }
            }
        }
        const auto& [everything, automatic] = runs;
        state.counters["blocks"] = static_cast<double>(scene.mass.size()) / freedomCount<Dim>;
        state.counters["steps"] = steps;
        state.counters["awake[%]"] = 100 * automatic.awake / steps;
        state.counters["bodies[%]"] = 100 * automatic.bodies / steps;
        state.counters["everything[ms]"] = 1000 * everything.seconds / steps;
        state.counters["automatic[ms]"] = 1000 * automatic.seconds / steps;
        state.counters["ratio"] = everything.seconds / automatic.seconds;
        state.counters["difference[m]"] =
            differenceOf(scene, everything.motion.state, automatic.motion.state);
    }
}

Assembly<2> paperWall(int number)
{
    return madeStructure(Dictionary::readFile(fmt::format(
        DRYSTONE_TUTORIALS "/limitAnalysis/masonryPanels/wall{}/system/blockTextureDict", number)));
}

void standingWall(benchmark::State& state)
{
    constexpr std::array<double, 6> multipliers{0.642859, 0.579999, 0.403694, 0.331948, 0.239643, 0.347825};
    const auto number = static_cast<int>(state.range(0));
    auto scene = sceneOf<2>(paperWall(number), 0.65, FlowRule::associative);
    shake(scene, 0.9 * multipliers[static_cast<std::size_t>(number - 1)] * weight);
    compare(state, std::move(scene), 0.002, 500);
}
BENCHMARK(standingWall)->DenseRange(1, 6)->Iterations(1)->Unit(benchmark::kMillisecond);

void standingSquareWall(benchmark::State& state)
{
    auto scene = sceneOf<2>(squareWall(static_cast<int>(state.range(0))), 0.65, FlowRule::associative);
    shake(scene, 0.3 * weight);
    compare(state, std::move(scene), 0.01, 500);
}
BENCHMARK(standingSquareWall)->Arg(20)->Arg(40)->Iterations(1)->Unit(benchmark::kMillisecond);

/// Two walls toothed into each other, in space.
DynamicCase<3> house()
{
    return sceneOf<3>(cornerOfHouse(), 0.6, FlowRule::associative);
}

void standingHouse(benchmark::State& state)
{
    auto scene = house();
    shake(scene, 0.05 * weight);
    compare(state, std::move(scene), 0.01, 500);
}
BENCHMARK(standingHouse)->Iterations(1)->Unit(benchmark::kMillisecond);

/// The acceleration along x at which a structure begins to move, the smaller of both senses [m/s2].
template<int Dim>
double leastAcceleration(const DynamicCase<Dim>& scene)
{
    const std::vector<ContactPoint<Dim>> points = findContactPoints(scene.assembly);
    double least = std::numeric_limits<double>::infinity();
    for (const double sense : {-1.0, 1.0})
    {
        Eigen::VectorXd live = Eigen::VectorXd::Zero(scene.mass.size());
        for (Eigen::Index row = 0; row < live.size(); row += freedomCount<Dim>)
        {
            live[row] = sense * scene.mass[row];
        }
        const auto program =
            limitAnalysisProgram<Dim>(static_cast<int>(scene.mass.size()) / freedomCount<Dim>,
                                      equilibriumColumns(scene.assembly, scene.blocks, points),
                                      frictionAt(scene, points), LoadVectors{scene.deadLoad.rows, live});
        const LimitAnalysis analysis = solveLimitAnalysis(program, InteriorPointSettings{});
        if (analysis.status != CollapseStatus::optimal)
        {
            throw std::runtime_error("the structure has no multiplier");
        }
        least = std::min(least, analysis.alpha);
    }
    return least;
}

/// Like a record of an earthquake: sines of 0.5 to 12 Hz with phases and amplitudes by chance, which grow
/// over 2 s, stay for 5 and die out; every 0.01 s, 20 s long.
std::shared_ptr<const GroundAcceleration> likeARecord(double peak, unsigned seed)
{
    constexpr int sines = 80;
    constexpr double interval = 0.01;
    constexpr int values = 2000;
    std::mt19937 random(seed);
    const auto even = [&random] { return std::ldexp(static_cast<double>(random()), -32); };
    std::vector<double> times(values);
    std::vector<double> accelerations(values, 0);
    for (int sine = 0; sine < sines; ++sine)
    {
        const double frequency = 0.5 * std::pow(24, even());
        const double phase = 2 * std::numbers::pi * even();
        const double amplitude = even();
        for (int i = 0; i < values; ++i)
        {
            accelerations[static_cast<std::size_t>(i)] +=
                amplitude * std::sin(2 * std::numbers::pi * frequency * interval * i + phase);
        }
    }
    double largest = 0;
    for (int i = 0; i < values; ++i)
    {
        const double time = interval * i;
        const double envelope = time < 2 ? time * time / 4 : time < 7 ? 1 : std::exp(-0.4 * (time - 7));
        auto& own = accelerations[static_cast<std::size_t>(i)];
        times[static_cast<std::size_t>(i)] = time;
        own *= envelope;
        largest = std::max(largest, std::abs(own));
    }
    for (double& own : accelerations)
    {
        own *= peak / largest;
    }
    return tabulatedAcceleration(std::move(times), std::move(accelerations), Interpolation::linear,
                                 OutOfBounds::zero);
}

/// A record of the folder shared/records next to the source, which not every copy has, scaled to a peak; or
/// null.
std::shared_ptr<const GroundAcceleration> recordOfFile(const std::string& name, double peak)
{
    const std::filesystem::path file =
        std::filesystem::path(DRYSTONE_TUTORIALS) / "../../shared/records" / name;
    if (!std::filesystem::exists(file))
    {
        return nullptr;
    }
    Record record = readPeerRecord(file);
    const double scale = peak / figures(record).peakAcceleration;
    for (double& own : record.accelerations)
    {
        own *= scale;
    }
    return tabulatedAcceleration(std::move(record.times), std::move(record.accelerations),
                                 Interpolation::linear, OutOfBounds::zero);
}

/// The house below its multiplier under a record, or what is like one. \param 0: like one; 1: El Centro
void houseUnderRecord(benchmark::State& state)
{
    auto scene = house();
    const double peak = 0.9 * leastAcceleration(scene);
    const auto acceleration = state.range(0) == 0 ? likeARecord(peak, 1) : recordOfFile("elCentro.AT2", peak);
    if (!acceleration)
    {
        state.SkipWithError("the record is not there");
        return;
    }
    shake(scene, acceleration);
    compare(state, std::move(scene), 0.01, 1000);
    state.SetLabel(fmt::format("peak {:.3g} m/s2", peak)); // csv has the counters of the first for all
}
BENCHMARK(houseUnderRecord)->Arg(0)->Arg(1)->Iterations(1)->Unit(benchmark::kMillisecond);

/// Stones on top of a wall that overhang by more than half of themselves. \param range of stones; units of
/// the wall
void fallingStones(benchmark::State& state)
{
    const auto size = static_cast<int>(state.range(1));
    Assembly<2> assembly = squareWall(size);
    const double top = 0.175 * size;
    const auto count = state.range(0);
    for (long stone = 0; stone < count; ++stone)
    {
        const double left = 0.4 * size * (static_cast<double>(stone) + 0.5) / static_cast<double>(count);
        for (const auto& [from, to, height] :
             {std::array{left, left + 0.3, 0.0}, {left + 0.17, left + 0.47, 0.2}})
        {
            Block<2> block;
            block.outline = {{from, top + height},
                             {to, top + height},
                             {to, top + height + 0.2},
                             {from, top + height + 0.2}};
            block.thickness = 1;
            block.support = -1;
            assembly.blocks.push_back(block);
        }
    }
    compare(state, sceneOf<2>(std::move(assembly), 0.65, FlowRule::associative), 0.01, 12);
}
BENCHMARK(fallingStones)
    ->ArgsProduct({{1, 10, 50}, {100}})
    ->Args({1, 40})
    ->Iterations(1)
    ->Unit(benchmark::kMillisecond);

/// How far steps are off such that are solved a hundred times closer, at most, each from where `automatic`
/// has come to [m].
struct StepErrors
{
    double everything = 0;
    double automatic = 0;
};

template<int Dim>
StepErrors stepErrors(DynamicCase<Dim> scene, double timeStep, int steps)
{
    DynamicCase<Dim> everything = scene;
    everything.schemes.effects.selection = EffectSelection::asGiven;
    DynamicCase<Dim> closer = everything;
    closer.solution.tolerance /= 100;
    scene.schemes.effects.selection = EffectSelection::automatic;
    StepErrors errors;
    Motion<Dim> motion = startMotion(scene, stateAtRest(scene.assembly));
    for (int step = 0; step < steps; ++step)
    {
        std::array<Motion<Dim>, 2> others{motion, motion};
        if (!advance(scene, motion, timeStep) || !advance(everything, others[0], timeStep)
            || !advance(closer, others[1], timeStep))
        {
            throw std::runtime_error("a step was not solved");
        }
        errors.automatic = std::max(errors.automatic, differenceOf(scene, motion.state, others[1].state));
        errors.everything =
            std::max(errors.everything, differenceOf(scene, others[0].state, others[1].state));
    }
    return errors;
}

/// The house with two stones on its top that overhang by a little more than half of themselves, and turn.
/// \param 1: by Coulomb's law
void turningStonesOfHouse(benchmark::State& state)
{
    Assembly<3> assembly = house().assembly;
    for (const double x : {-0.27, 3.7})
    {
        Block<3> block;
        block.shape = makeBox({x, 0.0, 2.5}, {x + 0.5, 0.25, 2.75});
        block.support = -1;
        assembly.blocks.push_back(block);
    }
    const FlowRule flowRule = state.range(0) == 0 ? FlowRule::associative : FlowRule::nonAssociative;
    compare(state, sceneOf<3>(std::move(assembly), 0.6, flowRule), 0.005, 60);
}
BENCHMARK(turningStonesOfHouse)->Arg(0)->Arg(1)->Iterations(1)->Unit(benchmark::kMillisecond);

/// A square wall with a gap of two courses under its upper right corner, which falls. \param units and
/// courses of the corner; of the wall
void fallingCorner(benchmark::State& state)
{
    const auto corner = static_cast<int>(state.range(0));
    const auto size = static_cast<int>(state.range(1));
    Assembly<2> assembly = madeStructure(Dictionary::readString(fmt::format(
        "texture {{ type runningBond; unit (0.4 0.175); length {0}; courses {0}; firstCourse full;\n"
        "openings ( {{ from ({1} {2}); to ({0} {3}); }} ); }}\n"
        "supports {{ ground {{ type ground; segment 0.5; }} }}\n",
        size, size - corner, size - corner - 2, size - corner)));
    constexpr double timeStep = 0.01;
    constexpr int steps = 24;
    const auto scene = sceneOf<2>(std::move(assembly), 0.65, FlowRule::associative);
    compare(state, scene, timeStep, steps);
    if (size <= 40)
    {
        const StepErrors errors = stepErrors(scene, timeStep, steps);
        state.SetLabel(fmt::format("a step off one solved to 1e-11: {:.1e} m; with everything on {:.1e} m",
                                   errors.automatic, errors.everything));
    }
}
BENCHMARK(fallingCorner)
    ->ArgsProduct({{2, 5, 10, 20, 30}, {100}})
    ->ArgsProduct({{2, 5, 10, 20}, {40}})
    ->Iterations(1)
    ->Unit(benchmark::kMillisecond);

/// Drums on top of each other, in space square.
template<int Dim>
Assembly<Dim> columnOf(int drums)
{
    Assembly<Dim> assembly;
    assembly.supports.push_back({"ground", "ground"});
    for (int drum = -1; drum < drums; ++drum)
    {
        const double half = drum < 0 ? 5 : 0.4;
        Block<Dim> block;
        if constexpr (Dim == 2)
        {
            block.outline = {
                {-half, 0.5 * drum}, {half, 0.5 * drum}, {half, 0.5 * drum + 0.5}, {-half, 0.5 * drum + 0.5}};
            block.thickness = 1;
        }
        else
        {
            block.shape = makeBox({-half, -half, 0.5 * drum}, {half, half, 0.5 * drum + 0.5});
        }
        block.support = drum < 0 ? 0 : -1;
        assembly.blocks.push_back(block);
    }
    return assembly;
}

/// A column pushed by a pulse from which it rocks. \param number of drums; 1: by Coulomb's law; 2: also with
/// restitution, for its blows
template<int Dim>
void rockingColumn(benchmark::State& state)
{
    const FlowRule flowRule = state.range(1) == 0 ? FlowRule::associative : FlowRule::nonAssociative;
    auto scene = sceneOf<Dim>(columnOf<Dim>(static_cast<int>(state.range(0))), 0.7, flowRule);
    shake<Dim>(scene, std::make_shared<SinePulse>(PulseShape{0.25 * weight, 0.6, 0.2}, 1));
    if (state.range(1) == 2)
    {
        scene.contact.restitution = Restitution{0.3};
    }
    constexpr int turns = 9; // of some 50 ms, which other programs disturb
    compare(state, std::move(scene), 0.002, Dim == 2 ? 2000 : 500, turns);
}
BENCHMARK(rockingColumn<2>)
    ->ArgsProduct({{6, 12, 24, 48}, {0, 1, 2}})
    ->Iterations(1)
    ->Unit(benchmark::kMillisecond);
BENCHMARK(rockingColumn<3>)
    ->ArgsProduct({{6, 12, 24}, {0, 1, 2}})
    ->Iterations(1)
    ->Unit(benchmark::kMillisecond);

DynamicCase<2> collapsingWall(FlowRule flowRule)
{
    auto scene = sceneOf<2>(paperWall(6), 0.65, flowRule);
    shake<2>(scene, std::make_shared<ConstantAcceleration>(-1.1 * 0.347825 * weight));
    return scene;
}

/// Wall 6 collapsing by Coulomb's law, compared with sets of effects that a user may choose by hand. \param
/// 0: Coulomb's law and large displacements, all that the collapse calls for; 1: with restitution of nothing;
/// 2: with the mildest damping; 3: without large displacements; 4: without Coulomb's correction. Of each set
/// the time and how far it ends from `automatic`
void collapseByCoulombsLaw(benchmark::State& state)
{
    constexpr double timeStep = 0.002;
    constexpr int steps = 100;
    const long set = state.range(0);
    auto byHand = collapsingWall(set == 4 ? FlowRule::associative : FlowRule::nonAssociative);
    if (set == 1)
    {
        byHand.contact.restitution = Restitution{1e-9};
    }
    if (set == 2)
    {
        byHand.effects.push_back(std::make_shared<MassDamping<2>>(Damping{1e-9}));
    }
    byHand.schemes.smallDisplacements = set == 3;
    auto scene = collapsingWall(FlowRule::nonAssociative);
    scene.schemes.effects.selection = EffectSelection::automatic;
    for (auto _ : state)
    {
        std::array<double, 2> least{1e300, 1e300};
        for (int turn = 0; turn < 3; ++turn)
        {
            const Run<2> chosen = run(byHand, timeStep, steps);
            const Run<2> automatic = run(scene, timeStep, steps);
            least = {std::min(least[0], chosen.seconds), std::min(least[1], automatic.seconds)};
            state.counters["awake[%]"] = 100 * automatic.awake / steps;
            state.counters["bodies[%]"] = 100 * automatic.bodies / steps;
            state.counters["difference[m]"] =
                differenceOf(scene, chosen.motion.state, automatic.motion.state);
        }
        state.counters["blocks"] = static_cast<double>(scene.mass.size()) / 3;
        state.counters["steps"] = steps;
        state.counters["everything[ms]"] = 1000 * least[0] / steps;
        state.counters["automatic[ms]"] = 1000 * least[1] / steps;
        state.counters["ratio"] = least[0] / least[1];
    }
}
BENCHMARK(collapseByCoulombsLaw)->DenseRange(0, 4)->Iterations(1)->Unit(benchmark::kMillisecond);

} // namespace
} // namespace drystone
