// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The walls of the paper, counted.
#include "texture/RunningBond.h"
#include "assembly/ContactPoint.h"
#include "texture/Supports.h"

#include <gtest/gtest.h>

using namespace drystone;

namespace
{

struct Wall
{
    RunningBond bond;
    int blocks;
    int points;
};

/// Table 1 of Portioli, Cascini & Landolfo (COMPDYN 2017); points: the paper's less the 28 a window that face
/// no block.
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

} // namespace
