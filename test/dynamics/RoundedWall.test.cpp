// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// A wall whose coordinates were turned and rounded stands, and moves, at the multiplier that it has
/// otherwise.
#include "../MadeStructure.h"
#include "assembly/AssemblyFile.h"
#include "dynamics/Advance.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <fstream>

namespace drystone
{
namespace
{

constexpr double multiplier = 0.642859; // of wall 1

/// Wall 1 as a case states it, turned with its gravity, pushed to its right by a share of its multiplier.
DynamicCase<2> roundedWall(double angle, int digits, double share)
{
    const double cosine = std::cos(angle);
    const double sine = std::sin(angle);
    const std::string file =
        std::string(DRYSTONE_TUTORIALS) + "/limitAnalysis/masonryPanels/wall1/system/blockTextureDict";
    Assembly<2> assembly = madeStructure(Dictionary::readFile(file));
    for (Block<2>& block : assembly.blocks)
    {
        for (Vector<2>& corner : block.outline)
        {
            corner = {std::stod(fmt::format("{:.{}f}", cosine * corner.x() - sine * corner.y(), digits)),
                      std::stod(fmt::format("{:.{}f}", sine * corner.x() + cosine * corner.y(), digits))};
        }
    }
    const auto directory =
        std::filesystem::path(testing::TempDir())
        / ("rounded-" + std::string(testing::UnitTest::GetInstance()->current_test_info()->name()));
    std::filesystem::create_directories(directory / "constant/assembly");
    const auto write = [&](const std::string& name, const std::string& text)
    { std::ofstream(directory / name) << text; };
    write("constant/assembly/blocks", assemblyText(assembly));
    write("constant/g", fmt::format("value ({} {} 0);", 9.81 * sine, -9.81 * cosine));
    write("constant/materialProperties", "unitWeight 1000;");
    write("constant/contactProperties", "friction { type Coulomb; mu 0.65; flowRule associative; }");
    write("constant/groundMotion",
          fmt::format("direction ({} {} 0); acceleration {{ type constant; value {}; }}", -cosine, -sine,
                      share * multiplier * 9.81));
    DynamicCase<2> scene = readDynamicCase<2>(directory);
    std::filesystem::remove_all(directory);
    return scene;
}

/// How far any block goes in 0.2 s [m].
double farthest(const DynamicCase<2>& scene)
{
    Motion<2> motion = startMotion(scene, stateAtRest(scene.assembly));
    EXPECT_EQ(motion.points.size(), 174U);
    for (int step = 0; step < 100; ++step)
    {
        EXPECT_TRUE(advance(scene, motion, 0.002)) << "step " << step;
    }
    double most = 0;
    for (const Placement<2>& placement : motion.state.placements)
    {
        most = std::max(most, placement.translation.norm());
    }
    return most;
}

TEST(RoundedWall, StandsBelowItsMultiplierAndMovesAboveIt)
{
    for (const double angle : {0.0, 0.174532925199433, -1.234, 2.5})
    {
        for (const int digits : {5, 6, 8})
        {
            SCOPED_TRACE(fmt::format("{} decimals, turned by {}", digits, angle));
            EXPECT_LT(farthest(roundedWall(angle, digits, 0.99)), 1e-6);
            EXPECT_GT(farthest(roundedWall(angle, digits, 1.1)), 1e-3);
        }
    }
}

} // namespace
} // namespace drystone
