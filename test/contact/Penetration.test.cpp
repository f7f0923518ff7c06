// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Depth of overlaps whose value is known.
#include "../Polygons.h"

#include "contact/Penetration.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace drystone;

namespace
{

using test::rectangle;

const Polygon notched{{0, 0}, {3, 0}, {3, 2}, {2, 2}, {2, 1}, {1, 1}, {1, 2}, {0, 2}};

} // namespace

TEST(Penetration, BlocksThatTouchOrLieApartDoNotOverlap)
{
    EXPECT_EQ(overlapDepth(rectangle(0, 0, 1, 1), rectangle(1, 0, 2, 1)), 0);
    EXPECT_EQ(overlapDepth(rectangle(0, 0, 1, 1), rectangle(1, 1, 2, 2)), 0);
    EXPECT_EQ(overlapDepth(rectangle(0, 0, 1, 1), rectangle(5, 0, 6, 1)), 0);
    EXPECT_EQ(overlapDepth(notched, rectangle(1, 1, 2, 2)), 0);
    EXPECT_EQ(overlapDepth(rectangle(1, 1, 2, 2), notched), 0);
}

TEST(Penetration, OfConvexBlocksIsTheShortestWayOut)
{
    EXPECT_NEAR(overlapDepth(rectangle(0, 0, 1, 1), rectangle(0.2, 0.999, 0.8, 2)), 1e-3, 1e-15);
    EXPECT_NEAR(overlapDepth(rectangle(0, 0, 1, 1), rectangle(0, 0.999, 1, 2)), 1e-3, 1e-15);
    // a cross: no corner is inside the other block
    EXPECT_NEAR(overlapDepth(rectangle(-2, -0.1, 2, 0.1), rectangle(-0.3, -2, 0.3, 2)), 2.1, 1e-15);
    // a corner that stands in an edge
    const double half = std::sqrt(0.5);
    EXPECT_NEAR(overlapDepth({{0, -0.01}, {half, half - 0.01}, {0, 2 * half - 0.01}, {-half, half - 0.01}},
                             rectangle(-1, -1, 1, 0)),
                0.01, 1e-15);
}

TEST(Penetration, OfConcaveBlocksIsSeenInTheirNotchesAndArms)
{
    EXPECT_NEAR(overlapDepth(notched, rectangle(1, 0.99, 2, 2)), 0.01, 1e-12);
    EXPECT_NEAR(overlapDepth(notched, rectangle(0.9, 1.2, 1.9, 1.8)), 0.1, 1e-12);
    EXPECT_GT(overlapDepth(notched, rectangle(-1, 1.4, 4, 1.6)), 0.1); // a bar through both arms
    EXPECT_EQ(overlapDepth(notched, rectangle(1.2, 1.1, 1.8, 5)), 0);
}

TEST(Penetration, NamesTheDeepestPairOfAnAssembly)
{
    Assembly<2> assembly{{{rectangle(0, 0, 1, 1)},
                          {rectangle(0, 1, 1, 2)},
                          {rectangle(-5, -1, 5, 0), 1, 0},
                          {rectangle(4, -1, 9, 0), 1, 0}},
                         {{"ground", "ground"}}};
    std::vector<Placement<2>> placements(4);
    EXPECT_EQ(penetration(assembly, placements).depth, 0); // overlaps of fixed blocks do not count
    EXPECT_EQ(penetration(assembly, placements).block, -1);
    placements[0].translation.y() = -1e-3;
    placements[1].translation.y() = -5e-3;
    const Penetration deepest = penetration(assembly, placements);
    EXPECT_NEAR(deepest.depth, 4e-3, 1e-15);
    EXPECT_EQ(deepest.block, 0);
    EXPECT_EQ(deepest.neighbour, 1);
    placements[1] = {Vector<2>::Zero(), 0.1}; // turns about its centroid: a corner dips into the block below
    EXPECT_NEAR(penetration(assembly, placements).depth, 0.5 * (std::cos(0.1) + std::sin(0.1)) - 0.5 - 1e-3,
                2e-2);
}
