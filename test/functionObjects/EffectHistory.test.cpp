// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// What steps have called for, as a table over time: its columns, and the means that long runs keep.
#include "functionObjects/EffectHistory.h"

#include "functionObjects/Histories.h"

#include <gtest/gtest.h>
#include <unistd.h>

using namespace drystone;

namespace
{

/// Four free blocks, friction and large displacements.
DynamicCase<2> fourBlocks()
{
    DynamicCase<2> scene;
    scene.mass = Eigen::VectorXd::Ones(12);
    scene.effectNames.simulated = {"friction"};
    return scene;
}

/// Half of the blocks were simulated, as one body, and friction acted on a quarter of the points.
Motion<2> motionAt(double time)
{
    Motion<2> motion;
    motion.state.time = time;
    motion.state.velocity = Eigen::VectorXd::Zero(12);
    motion.isAwake = {true, true, false, false};
    motion.bodies = {0, 0, -1, -1};
    motion.effectCalls = {0.25, 0.5};
    return motion;
}

} // namespace

TEST(EffectHistory, ATableAndAPictureOfTheShares)
{
    const std::filesystem::path folder =
        std::filesystem::temp_directory_path() / ("drystoneEffectHistory" + std::to_string(getpid()));
    const DynamicCase<2> scene = fourBlocks();
    EffectHistory<2> history(scene);
    EXPECT_TRUE(history.isEmpty());
    constexpr int steps = 5000;
    for (int step = 1; step <= steps; ++step)
    {
        Motion<2> motion = motionAt(0.01 * step);
        if (step > steps / 2) // at rest
        {
            motion.isAwake.assign(4, false);
            motion.bodies.assign(4, -1);
            motion.effectCalls.assign(2, 0);
        }
        history.observe(motion);
    }
    ASSERT_FALSE(history.isEmpty());
    history.writeTable(folder);
    history.writePicture(folder, "case", {PictureFormat::svg});
    EXPECT_TRUE(std::filesystem::exists(folder / "effects.svg"));
    const NumberTable table = readNumberTable(folder / "effects.dat");
    EXPECT_EQ(table.names,
              (std::vector<std::string>{"Time", "blocks", "bodies", "friction", "largeDisplacements"}));
    ASSERT_EQ(table.columns.size(), 5u);
    EXPECT_LE(table.columns[0].size(), 800u);
    EXPECT_GE(table.columns[0].size(), 400u);
    EXPECT_NEAR(table.columns[0].back(), 0.01 * steps, 1e-3);
    EXPECT_EQ(table.columns[1].front(), 50);
    EXPECT_EQ(table.columns[2].front(), 25);
    EXPECT_EQ(table.columns[3].front(), 25);
    EXPECT_EQ(table.columns[4].front(), 50);
    EXPECT_EQ(table.columns[1].back(), 0);
    std::filesystem::remove_all(folder);
}
