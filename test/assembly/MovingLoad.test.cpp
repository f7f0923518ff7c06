// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Where a moving load meets blocks.
#include "../Polygons.h"

#include "assembly/MovingLoad.h"

#include "geometry/space/Polyhedron.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <utility>

using namespace drystone;
using testing::ElementsAre;

namespace
{

using test::rectangle;

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

TEST(MovingLoad, NamesThePlacesThatAreLeftOut)
{
    const MovingLoadSettings<2> settings = overSteps();
    EXPECT_THAT(placesWithoutLoad(movingLoad(steps(), settings), settings), ElementsAre(0.0, 3.0));
    Assembly<2> gap = steps();
    gap.blocks[2].outline = rectangle(1.2, 0, 2, 1); // the gap, and beside both blocks
    EXPECT_THAT(placesWithoutLoad(movingLoad(gap, settings), settings), ElementsAre(0.0, 3.0));
    gap.blocks[2].outline = rectangle(1.7, 0, 2.2, 1);
    EXPECT_THAT(placesWithoutLoad(movingLoad(gap, settings), settings), ElementsAre(0.0, 2.0, 3.0));
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

// At a corner of four blocks those of neither the lowest nor the highest index were left out: a multiplier
// was nine times too high where one of them was the weakest.
TEST(MovingLoad, ComesOnEachBlockOfACornerOnce)
{
    const Assembly<3> slabs{{{makeBox({-1, -1, 0}, {0, 0, 1}), -1},
                             {makeBox({0, -1, 0}, {1, 0, 1}), -1},
                             {makeBox({-1, 0, 0}, {0, 1, 1}), -1},
                             {makeBox({0, 0, 0}, {1, 1, 1}), -1}},
                            {}};
    MovingLoadSettings<3> settings;
    settings.from = {0, 0, 2};
    settings.to = {0, 0.5, 2};
    settings.positions = 2;
    settings.value = {0, 0, -10};
    std::vector<LoadPosition<3>> positions = movingLoad(slabs, settings);
    ASSERT_EQ(positions.size(), 6u);
    for (int i = 0; i < 4; ++i)
    {
        EXPECT_THAT(positions[static_cast<std::size_t>(i)].blocks, ElementsAre(i));
        EXPECT_EQ(positions[static_cast<std::size_t>(i)].distance, 0);
    }
    // With a second axle on the joint of 0 and 1 every choice comes, not equal sides alone.
    settings.axles = {{0, 1}, {-0.5, 2}};
    positions = movingLoad(slabs, settings);
    ASSERT_EQ(positions.size(), 8u + 8u);
    EXPECT_THAT(positions[0].blocks, ElementsAre(0, 0));
    EXPECT_THAT(positions[1].blocks, ElementsAre(0, 1));
    EXPECT_THAT(positions[6].blocks, ElementsAre(3, 0));
    EXPECT_THAT(positions[7].blocks, ElementsAre(3, 1));
    // Of what is fixed there is one choice: no load.
    Assembly<3> onFixed = slabs;
    onFixed.blocks[1].support = onFixed.blocks[2].support = 0;
    onFixed.supports = {{"ground", "ground"}};
    settings.axles = {};
    positions = movingLoad(onFixed, settings);
    ASSERT_EQ(positions.size(), 3u);
    EXPECT_THAT(positions[0].blocks, ElementsAre(0));
    EXPECT_THAT(positions[1].blocks, ElementsAre(3));
}

// So many axles at joints at once take one side together.
TEST(MovingLoad, ManyAxlesAtJointsAreOnEqualSides)
{
    Assembly<2> row{{{rectangle(-9, -1, 9, 0), 1, 0}}, {{"ground", "ground"}}};
    MovingLoadSettings<2> settings = overSteps();
    settings.from = {0, 3};
    settings.to = {0.5, 3};
    settings.positions = 2;
    for (int i = -1; i < 8; ++i)
    {
        row.blocks.push_back({rectangle(i, 0, i + 1, 1)});
        if (i >= 0)
        {
            settings.axles.emplace_back(i, 1);
        }
    }
    const std::vector<LoadPosition<2>> positions = movingLoad(row, settings);
    ASSERT_EQ(positions.size(), 2u + 1u);
    EXPECT_THAT(positions[0].blocks, ElementsAre(1, 2, 3, 4, 5, 6, 7, 8));
    EXPECT_THAT(positions[1].blocks, ElementsAre(2, 3, 4, 5, 6, 7, 8, 9));
}

/// Four blocks of 1 m side by side on the ground, their tops at the level 1.
Assembly<2> row()
{
    Assembly<2> assembly{{{rectangle(-9, -1, 9, 0), 1, 0}}, {{"ground", "ground"}}};
    for (int i = 0; i < 4; ++i)
    {
        assembly.blocks.push_back({rectangle(i, 0, i + 1, 1)});
    }
    return assembly;
}

TEST(MovingLoad, SpreadsUniformlyThroughAFill)
{
    MovingLoadSettings<2> settings;
    settings.from = {1.5, 3};
    settings.to = {2, 3};
    settings.positions = 2;
    settings.value = {0, -10};
    settings.loadedLength = 0.3;
    settings.spread = 0.5;
    const std::vector<LoadPosition<2>> positions = movingLoad(row(), settings);
    ASSERT_EQ(positions.size(), 2u); // once where its middle meets a joint
    // At the depth 2 it is 0.3 + 2 x 0.5 x 2 = 2.3 wide: from 0.85 to 3.15.
    const Eigen::VectorXd& live = positions[1].live;
    const double width = 2.3;
    const double least = 10.0 / 400; // a part of the load
    EXPECT_NEAR(live[1] + live[4] + live[7] + live[10], -10, 1e-12);
    for (const auto& [block, length] :
         {std::pair(0, 0.15), std::pair(1, 1.0), std::pair(2, 1.0), std::pair(3, 0.15)})
    {
        EXPECT_NEAR(live[3 * block + 1], -10 * length / width, least) << block;
        EXPECT_NEAR(live[3 * block], 0, 1e-12) << block;
    }
    // Of the outer blocks only the inner 0.15 m are loaded, in their middle at 0.425 m from that of the
    // block.
    EXPECT_NEAR(live[2], -10 * 0.15 / width * 0.425, least);
    EXPECT_NEAR(live[11], 10 * 0.15 / width * 0.425, least);
    EXPECT_THAT(positions[1].blocks, ElementsAre(1, 2, 3, 4));
    ASSERT_EQ(positions[1].axles.size(), 1u);
    EXPECT_NEAR((positions[1].axles[0].place - Vector<2>(2, 1)).norm(), 0, 1e-12);
    // From the other position, 0.35 to 2.65, the last block bears nothing.
    EXPECT_NEAR(positions[0].live[1], -10 * 0.65 / width, least);
    EXPECT_NEAR(positions[0].live[10], 0, 1e-12);
    // What falls beside the blocks is borne by the ground.
    settings.from.x() = 4;
    settings.to.x() = 4.5;
    const Eigen::VectorXd beside = movingLoad(row(), settings)[0].live;
    EXPECT_NEAR(beside[7], -10 * 0.15 / width, least);
    EXPECT_NEAR(beside[10], -10 * 1 / width, least);
}

TEST(MovingLoad, SpreadsSteeplyToWhatIsFarBelow)
{
    // 10 m below the path 60 m wide: rays at its ends are much longer than the one in its middle.
    const Assembly<2> one{{{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}, -1}}, {}};
    MovingLoadSettings<2> settings;
    settings.from = {0.5, 11};
    settings.to = {1.5, 11};
    settings.positions = 2;
    settings.value = {0, -60};
    settings.spread = 3;
    const std::vector<LoadPosition<2>> positions = movingLoad(one, settings);
    ASSERT_EQ(positions.size(), 2u);
    EXPECT_NEAR(positions[0].live[1], -1, 1e-3);
}

TEST(MovingLoad, SpreadsToBothSidesInSpace)
{
    Assembly<3> slab;
    slab.blocks.resize(2);
    slab.blocks[0].shape = makeBox({-2, -3, 0}, {0, 3, 1});
    slab.blocks[1].shape = makeBox({0, -3, 0}, {2, 3, 1});
    MovingLoadSettings<3> settings;
    settings.from = {0, 0, 3};
    settings.to = {1.4, 0, 3};
    settings.positions = 2;
    settings.value = {0, 0, -10};
    settings.loadedLength = 0.3;
    settings.loadedWidth = 1.3;
    settings.spread = 0.5;
    const std::vector<LoadPosition<3>> positions = movingLoad(slab, settings);
    ASSERT_EQ(positions.size(), 2u);
    // Over the joint half of it on either block, 2.3 m along the path: at 0.575 m from the joint, in the
    // middle across. A block is met as far beside it as a joint may be wide.
    constexpr double width = 2e-5;
    const Eigen::VectorXd& middle = positions[0].live;
    EXPECT_NEAR(middle[2], -5, width);
    EXPECT_NEAR(middle[8], -5, width);
    EXPECT_NEAR(middle[3], 0, width);
    EXPECT_NEAR(middle[4], 5 * (1 - 0.575), width); // r x F about y, with r = (0.425 .. 0.5)
    EXPECT_NEAR(middle[10], -5 * (1 - 0.575), width);
    // At 1.4 the part beyond the end of the slab meets nothing.
    const double share = (2.3 - 0.55) / 2.3;
    EXPECT_NEAR(positions[1].live[2] + positions[1].live[8], -10 * share, width);
    EXPECT_NEAR(positions[1].beside, 1 + (positions[1].live[2] + positions[1].live[8]) / 10, 1e-12);
    EXPECT_NEAR(positions[0].beside, 0, 1e-12);
    // Partly beside the slab across the path.
    settings.from = {-0.5, 2.6, 3};
    settings.to = {-0.4, 2.6, 3};
    const double across = 1.3 + 2 * 0.5 * 2;
    const LoadPosition<3> beside = movingLoad(slab, settings).front();
    EXPECT_NEAR(beside.live[2] + beside.live[8], -10 * (across / 2 + 0.4) / across, 10 * width);
}

TEST(MovingLoad, InSpaceActsWhereItMeetsTheFacesOfANarrowBlock)
{
    // A ridge that bears a sixteenth of the load, on its top from x = 0 to 1 and on its side at x = 1. Rays
    // are at 6 + 10 u at its top and come to the side where u is from -1/2 to -10/21.
    Assembly<3> ridge;
    ridge.blocks.resize(1);
    ridge.blocks[0].shape = makeBox({0, -30, 0}, {1, 30, 1});
    MovingLoadSettings<3> settings;
    settings.from = {6, 0, 21};
    settings.to = {7, 0, 21};
    settings.positions = 2;
    settings.value = {0, 0, -10};
    settings.spread = 0.5;
    const std::vector<LoadPosition<3>> positions = movingLoad(ridge, settings);
    ASSERT_EQ(positions.size(), 2u);
    const double top = 0.1 / 2;
    const double side = (0.5 - 10.0 / 21) / 2;
    const Eigen::VectorXd& live = positions[0].live;
    EXPECT_NEAR(live[2], -10 * (top + side), 1e-4);
    EXPECT_NEAR(live[4], 10 * side * 0.5, 2e-3); // about y; what bears on the top is in its middle
}

TEST(MovingLoad, InSpaceSharesAreRightWhereAPathIsAskewToEdges)
{
    // The load is spread over a square of side 2, with u along the path and v across it. The corner of a slab
    // is at (p q) there, and its edges go from it to u = -1 and to v = 1.
    Assembly<3> slab;
    slab.blocks.resize(1);
    slab.blocks[0].shape = makeBox({-9, -9, 0}, {0, 0, 1});
    const double p = 0.35;
    const double q = -0.2;
    for (const double askew : {0.0, 0.01, 0.047, 0.3, 0.5})
    {
        const Vector<3> along(std::cos(askew), std::sin(askew), 0);
        const Vector<3> across(std::sin(askew), -std::cos(askew), 0);
        MovingLoadSettings<3> settings;
        settings.from = Vector<3>(0, 0, 3) - p * along - q * across;
        settings.to = settings.from + along;
        settings.positions = 2;
        settings.value = {0, 0, -10};
        settings.spread = 0.5;
        const double slope = std::tan(askew);
        const Polygon loaded{{p, q}, {p - slope * (1 - q), 1}, {-1, 1}, {-1, q - slope * (p + 1)}};
        EXPECT_NEAR(movingLoad(slab, settings).front().live[2], -10 * areaProperties(loaded).area / 4, 1e-4)
            << askew;
    }
}

TEST(MovingLoad, OfALoadedLengthAloneDoesNotWiden)
{
    MovingLoadSettings<2> settings;
    settings.from = {1.5, 3};
    settings.to = {3.75, 3};
    settings.positions = 2;
    settings.value = {0, -10};
    settings.loadedLength = 0.5;
    const std::vector<LoadPosition<2>> positions = movingLoad(row(), settings);
    EXPECT_NEAR(positions[0].live[4], -10, 1e-12); // all of it on the second block
    EXPECT_NEAR(positions[0].live[5], 0, 1e-12);
    EXPECT_NEAR(positions[1].live[10], -10, 1e-12);
    EXPECT_NEAR(positions[1].live[11], -10 * 0.25, 1e-12);
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
