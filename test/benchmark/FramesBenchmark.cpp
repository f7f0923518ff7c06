// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// A frame of a running simulation, blocks and contacts of the walls of the paper: its bytes as they are
/// written directly and as VTK's writer forms them, and the frame with its files and lists.
///
///     build/test/FramesBenchmark
#include "../MadeStructure.h"
#include "functionObjects/LimitAnalysisResults.h"
#include "io/Frames.h"
#include "io/VtkLibrary.h"
#include "io/VtkSeries.h"

#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <unistd.h>

namespace drystone
{
namespace
{

struct Scene
{
    Assembly<2> assembly;
    std::vector<ContactPoint<2>> points;
    std::vector<Vector<2>> forces;
    std::vector<ContactState> states;
};

Scene wallOfThePaper(int number)
{
    const std::filesystem::path wall =
        std::filesystem::path(DRYSTONE_TUTORIALS) / fmt::format("limitAnalysis/masonryPanels/wall{}", number);
    const LimitAnalysisCase<2> structure = readLimitAnalysisCase<2>(
        wall, madeStructure<2>(Dictionary::readFile(wall / "system/blockTextureDict")));
    Scene scene{structure.assembly, structure.points, {}, {}};
    for (std::size_t i = 0; i < scene.points.size(); ++i)
    {
        scene.forces.emplace_back(100 + std::sin(static_cast<double>(i)), std::cos(static_cast<double>(i)));
    }
    scene.states.assign(scene.points.size(), ContactState::sticking);
    return scene;
}

PolyData<2> blocksAt(const Scene& scene, int step)
{
    std::vector<Placement<2>> placements(scene.assembly.blocks.size());
    Field velocity{"velocity[m/s]", 2, {}};
    Field angularVelocity{"angularVelocity[rad/s]", 1, {}};
    for (std::size_t i = 0; i < placements.size(); ++i)
    {
        const double phase = static_cast<double>(i) + 0.1 * step;
        placements[i] = {{1e-3 * std::sin(phase), 1e-4 * std::cos(phase)}, 1e-3 * std::sin(2 * phase)};
        velocity.values.insert(velocity.values.end(), {std::sin(3 * phase), std::cos(3 * phase)});
        angularVelocity.values.push_back(std::cos(phase));
    }
    return blockFrame(scene.assembly, placements, {velocity, angularVelocity});
}

PolyData<2> contactsOf(const Scene& scene)
{
    return contactFrame(scene.points, scene.forces, scene.states);
}

/// \param bytes of a PolyData<2>
template<class Bytes>
void measureBytes(benchmark::State& state, const Bytes& bytes)
{
    const Scene scene = wallOfThePaper(static_cast<int>(state.range(0)));
    const PolyData<2> blocks = blocksAt(scene, 1);
    const PolyData<2> contacts = contactsOf(scene);
    std::size_t size = 0;
    for (auto _ : state)
    {
        size = bytes(blocks).size() + bytes(contacts).size();
    }
    state.counters["bytes"] = static_cast<double>(size);
}

void direct(benchmark::State& state)
{
    measureBytes(state, [](const PolyData<2>& data) { return vtpBytes(data); });
}
BENCHMARK(direct)->Arg(1)->Arg(6)->Unit(benchmark::kMillisecond);

void byVtk(benchmark::State& state)
{
    measureBytes(state, [](const PolyData<2>& data) { return vtpBytesOfVtk(data); });
}
BENCHMARK(byVtk)->Arg(1)->Arg(6)->Unit(benchmark::kMillisecond);

void wholeFrame(benchmark::State& state)
{
    const Scene scene = wallOfThePaper(static_cast<int>(state.range(0)));
    const std::filesystem::path folder =
        std::filesystem::temp_directory_path() / fmt::format("drystone-frames-{}", ::getpid());
    VtkSeries blocks(folder, "blocks", 0);
    VtkSeries contacts(folder, "contacts", 0);
    int step = 0;
    for (auto _ : state)
    {
        ++step;
        blocks.write(step, blocksAt(scene, step));
        contacts.write(step, contactsOf(scene));
    }
    std::filesystem::remove_all(folder);
}
BENCHMARK(wholeFrame)->Arg(1)->Arg(6)->Unit(benchmark::kMillisecond)->Iterations(500);

} // namespace
} // namespace drystone
