// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The walls of the paper: numbers of blocks and contact points.
#include "texture/RunningBond.h"
#include "contact/ContactPoint.h"
#include "texture/Supports.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

using namespace drystone;

namespace
{

struct Wall
{
    RunningBond bond;
    int blocks;
    int points;
};

/// Table 1 of Portioli, Cascini & Landolfo (COMPDYN 2017); points: those of the paper less 28 per window that
/// face no block.
std::vector<Wall> paperWalls()
{
    const Vector<2> unit(0.4, 0.175);
    return {
        {{unit, 1, 5, 6, FirstCourse::half, {}}, 33, 174},
        {{unit, 1, 5, 10, FirstCourse::half, {}}, 55, 290},
        {{unit, 1, 4, 11, FirstCourse::full, {{{1.5, 3}, {2.5, 8}}}}, 46, 212},
        {{unit, 1, 5, 11, FirstCourse::half, {{{1, 3}, {2, 8}}, {{3, 3}, {4, 8}}}}, 55, 240},
        {{unit, 1, 3, 19, FirstCourse::half, {{{1, 3}, {2, 8}}, {{1, 11}, {2, 16}}}}, 61, 244},
        {{unit,
          1,
          7,
          21,
          FirstCourse::half,
          {{{1.5, 4}, {2.5, 9}}, {{4.5, 4}, {5.5, 9}}, {{1.5, 12}, {2.5, 17}}, {{4.5, 12}, {5.5, 17}}}},
         146,
         702},
    };
}

TEST(RunningBond, TheSixWallsOfThePaperHaveItsBlocksAndContactPoints)
{
    for (const Wall& wall : paperWalls())
    {
        Assembly<2> assembly = makeAssembly(wall.bond);
        EXPECT_EQ(assembly.blocks.size(), wall.blocks);
        Ground ground;
        ground.segment = 0.5 * wall.bond.unit.x();
        addGround(assembly, "ground", ground);
        EXPECT_EQ(findContactPoints(assembly).size(), wall.points);
    }
}

// 2.1/0.7 is 3 and the last digit more, which made a block without a length.
TEST(RunningBond, RoundingOfItsLengthMakesNoBlock)
{
    RunningBond bond = paperWalls()[0].bond;
    bond.length = 3;
    const std::size_t blocks = makeAssembly(bond).blocks.size();
    for (const double length : {2.1 / 0.7, 3 + 1e-10, 3 - 1e-10})
    {
        bond.length = length;
        EXPECT_EQ(makeAssembly(bond).blocks.size(), blocks) << length;
    }
}

TEST(RunningBond, OpeningsTakeAwayTheirOwnAreaAndNothingElse)
{
    std::mt19937 random(5);
    for (int i = 0; i < 200; ++i)
    {
        RunningBond bond;
        bond.length = std::uniform_int_distribution<int>(2, 30)(random) / 2.0;
        bond.courses = std::uniform_int_distribution<int>(1, 20)(random);
        bond.firstCourse = i % 2 == 0 ? FirstCourse::half : FirstCourse::full;
        std::uniform_real_distribution<double> along(0, bond.length);
        std::uniform_int_distribution<int> up(0, bond.courses);
        const auto [left, right] = std::minmax({along(random), along(random)});
        const auto [bottom, top] = std::minmax({up(random), up(random)});
        bond.openings = {{{left, bottom}, {right, top}}};
        double area = 0;
        const Assembly<2> wall = makeAssembly(bond);
        for (const Block<2>& block : wall.blocks)
        {
            const AreaProperties properties = areaProperties(block.outline);
            EXPECT_GT(properties.area, 0);
            area += properties.area;
        }
        const double expected = bond.length * bond.courses - (right - left) * (top - bottom);
        EXPECT_NEAR(area, expected * 0.4 * 0.175, 1e-12 * bond.length * bond.courses);
    }
}

TEST(RunningBond, CoursesAreShiftedByHalfABlockAndEndFlush)
{
    RunningBond bond;
    bond.length = 4.5; // ends with half a block where the course starts full
    bond.courses = 2;
    bond.firstCourse = FirstCourse::full;
    const Assembly<2> wall = makeAssembly(bond);
    ASSERT_EQ(wall.blocks.size(), 10U);
    EXPECT_DOUBLE_EQ(wall.blocks[4].outline[1].x(), 4.5 * 0.4);
    EXPECT_DOUBLE_EQ(wall.blocks[4].outline[0].x(), 4 * 0.4);
    EXPECT_DOUBLE_EQ(wall.blocks[5].outline[1].x(), 0.5 * 0.4);
    EXPECT_DOUBLE_EQ(wall.blocks[9].outline[0].x(), 3.5 * 0.4);
}

TEST(RunningBond, ABlockThatCrossesBothJambsIsCutInTwo)
{
    RunningBond bond;
    bond.length = 2;
    bond.courses = 1;
    bond.firstCourse = FirstCourse::full;
    bond.openings = {{{0.25, 0}, {0.75, 1}}};
    const Assembly<2> wall = makeAssembly(bond);
    ASSERT_EQ(wall.blocks.size(), 3U);
    EXPECT_DOUBLE_EQ(wall.blocks[0].outline[1].x(), 0.1);
    EXPECT_DOUBLE_EQ(wall.blocks[1].outline[0].x(), 0.3);
}

TEST(Ground, ItsSegmentsEndWithTheStructureAndItsMarginGoesOn)
{
    RunningBond bond;
    bond.length = 3;
    bond.courses = 1;
    Assembly<2> wall = makeAssembly(bond);
    const std::size_t before = wall.blocks.size();
    Ground ground;
    ground.segment = 0.5;
    ground.margin = 2;
    addGround(wall, "ground", ground);
    ASSERT_EQ(wall.blocks.size(), before + 3); // 1.2 m in pieces of 0.5 m
    EXPECT_DOUBLE_EQ(wall.blocks[before].outline[0].x(), -2);
    EXPECT_DOUBLE_EQ(wall.blocks[before].outline[1].x(), 0.5);
    EXPECT_DOUBLE_EQ(wall.blocks[before + 2].outline[0].x(), 1);
    EXPECT_DOUBLE_EQ(wall.blocks[before + 2].outline[1].x(), 3.2);
    EXPECT_EQ(wall.blocks[before].outline[2].y(), 0);
}

} // namespace
