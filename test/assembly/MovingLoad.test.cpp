// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Where a moving load meets blocks.
#include "assembly/MovingLoad.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

using namespace drystone;
using testing::ElementsAre;

namespace
{

Polygon rectangle(double x0, double y0, double x1, double y1)
{
    return {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}};
}

/// Ground, a block of 1 m and one of 2 m height beside each other; ground to the left of them.
Assembly<2> steps()
{
    return {{{rectangle(-9, -1, 9, 0), 1, 0}, {rectangle(0, 0, 1, 1)}, {rectangle(1, 0, 2, 2)}},
            {{"ground", "ground"}}};
}

MovingLoadSettings<2> overSteps()
{
    MovingLoadSettings<2> settings;
    settings.from = {-0.5, 3};
    settings.to = {2.5, 3};
    settings.positions = 7;
    settings.value = {0, -10};
    return settings;
}

TEST(MovingLoad, ActsOnTheFirstBlockBelowThePath)
{
    const std::vector<LoadPosition<2>> positions = movingLoad(steps(), overSteps());
    // At -0.5 and 2.5 on the ground; at 0 on block 1 or the ground? The ground is lower: on block 1.
    ASSERT_EQ(positions.size(), 5u);
    EXPECT_NEAR(positions[0].distance, 0.5, 1e-15);
    EXPECT_THAT(positions[0].blocks, ElementsAre(1));
    EXPECT_EQ(positions[1].place, Vector<2>(0.5, 3));
    EXPECT_THAT(positions[1].blocks, ElementsAre(1));
    EXPECT_EQ(positions[1].live, (Eigen::VectorXd(6) << 0, -10, 0, 0, 0, 0).finished());
    // At x = 1 the higher block is met first.
    EXPECT_THAT(positions[2].blocks, ElementsAre(2));
    EXPECT_NEAR(positions[2].live[5], -10 * -0.5, 1e-12);
    EXPECT_THAT(positions[4].blocks, ElementsAre(2));
}

TEST(MovingLoad, ComesTwiceWhereItMeetsAJoint)
{
    Assembly<2> level = steps();
    level.blocks[2].outline = rectangle(1, 0, 2, 1);
    const std::vector<LoadPosition<2>> positions = movingLoad(level, overSteps());
    ASSERT_EQ(positions.size(), 6u);
    EXPECT_EQ(positions[2].distance, positions[3].distance);
    EXPECT_THAT(positions[2].blocks, ElementsAre(1));
    EXPECT_THAT(positions[3].blocks, ElementsAre(2));
    EXPECT_NEAR(positions[2].live[2], -5, 1e-12);
    EXPECT_NEAR(positions[3].live[5], 5, 1e-12);
}

TEST(MovingLoad, AxlesThatHaveLeftTheBlocksLoadNothing)
{
    MovingLoadSettings<2> settings = overSteps();
    settings.axles = {{0, 1}, {-1.5, 0.5}};
    const std::vector<LoadPosition<2>> positions = movingLoad(steps(), settings);
    // At x = 2 the second axle is at 0.5.
    const auto at = std::find_if(positions.begin(), positions.end(),
                                 [](const auto& position) { return position.place.x() == 2; });
    ASSERT_NE(at, positions.end());
    EXPECT_THAT(at->blocks, ElementsAre(2, 1));
    EXPECT_NEAR(at->live[1], -5, 1e-12);
    EXPECT_NEAR(at->live[4], -10, 1e-12);
    // At x = 2.5 it is alone, on the higher block.
    EXPECT_THAT(positions.back().blocks, ElementsAre(2));
    settings.from.x() = 20;
    settings.to.x() = 30;
    EXPECT_TRUE(movingLoad(steps(), settings).empty());
}

TEST(MovingLoad, InSpaceMeetsFaces)
{
    Assembly<3> assembly{{{makeBox({-9, -9, -1}, {9, 9, 0}), 0},
                          {makeBox({0, 0, 0}, {1, 1, 1}), -1},
                          {makeBox({1, 0, 0}, {2, 1, 2}), -1}},
                         {{"ground", "ground"}}};
    MovingLoadSettings<3> settings;
    settings.from = {0.5, -0.5, 3};
    settings.to = {0.5, 0.5, 3};
    settings.positions = 3;
    settings.value = {0, 0, -10};
    settings.axles = {{0, 1}};
    const std::vector<LoadPosition<3>> positions = movingLoad(assembly, settings);
    ASSERT_EQ(positions.size(), 2u);
    EXPECT_THAT(positions[0].blocks, ElementsAre(1)); // over its edge
    EXPECT_NEAR(positions[0].live[3], -10 * -0.5, 1e-12);
    EXPECT_LT((positions[1].live.head<6>() - (Eigen::VectorXd(6) << 0, 0, -10, 0, 0, 0).finished()).norm(),
              1e-12);
}

} // namespace
