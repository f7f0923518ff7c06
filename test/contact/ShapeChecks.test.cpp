// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// What the checks ask of shapes, by blocks whose answers are known by hand.
#include "contact/ShapeChecks.h"
#include "contact/Overlaps.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace drystone
{
namespace
{

Block<2> boxOf(double x0, double y0, double x1, double y1)
{
    return {{{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}}};
}

Block<3> boxOf(const Vector<3>& lower, const Vector<3>& upper)
{
    return {makeBox(lower, upper)};
}

const Block<2> letterLBlock{{{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}}};

} // namespace

TEST(ShapeChecks, ExtentsAreAreasAndVolumes)
{
    EXPECT_DOUBLE_EQ(extentOf(boxOf(0, 0, 2, 3)), 6);
    EXPECT_DOUBLE_EQ(extentOf(boxOf({0, 0, 0}, {2, 3, 4})), 24);
}

TEST(ShapeChecks, CommonPartsOfBlocksThatOverlapTouchAndAreApart)
{
    EXPECT_NEAR(commonExtent(boxOf(0, 0, 1, 1), boxOf(0.75, 0.5, 2, 2), 0), 0.125, 1e-12);
    EXPECT_NEAR(commonDepth(boxOf(0, 0, 1, 1), boxOf(0.75, 0.5, 2, 2)), 0.25, 1e-12);
    EXPECT_NEAR(commonExtent(boxOf(0, 0, 1, 1), boxOf(1, 0, 2, 1), 0), 0, 1e-12);
    EXPECT_EQ(commonDepth(boxOf(0, 0, 1, 1), boxOf(3, 0, 4, 1)), 0);
    const Block<3> cube = boxOf({0, 0, 0}, {1, 1, 1});
    EXPECT_NEAR(commonExtent(cube, boxOf({0.9, 0, 0}, {2, 1, 1}), 1e-9), 0.1, 1e-6);
    EXPECT_NEAR(commonDepth(cube, boxOf({0.9, 0, 0}, {2, 1, 1})), 0.1, 1e-9);
    EXPECT_EQ(commonExtent(cube, boxOf({3, 0, 0}, {4, 1, 1}), 1e-9), 0);
}

TEST(ShapeChecks, AnOutlineWithACornerThatTurnsInwardsIsNotConvex)
{
    EXPECT_TRUE(isConvexBlock(boxOf(0, 0, 1, 1)));
    EXPECT_FALSE(isConvexBlock(letterLBlock));
    EXPECT_TRUE(isConvexBlock(boxOf({0, 0, 0}, {1, 1, 1})));
}

TEST(ShapeChecks, FaultsNameWhatIsWrongAndRangesTakeEveryBlock)
{
    CheckedRange range;
    EXPECT_EQ(inertiaFault(boxOf(0, 0, 1, 1), {}, range), "");
    EXPECT_NEAR(range.least, 1.0 / 6, 1e-12);
    EXPECT_NE(inertiaFault(boxOf(0, 0, 1e6, 1e-3), {}, range), "");
    EXPECT_GT(range.largest, 1e4);
    SliverRanges ranges;
    EXPECT_EQ(sliverFault(boxOf(0, 0, 1, 1), {}, ranges), "");
    EXPECT_NE(sliverFault(boxOf(0, 0, 1000, 1), {}, ranges), "");
}

TEST(ShapeChecks, PairsAreThoseWithinADistanceAndWithoutAPoint)
{
    Assembly<2> assembly;
    assembly.blocks = {boxOf(0, 0, 1, 1), boxOf(1.01, 0, 2, 1), boxOf(5, 0, 6, 1)};
    const auto near = blocksWithin(assembly, 0.02);
    EXPECT_THAT(near, testing::ElementsAre(std::pair(0, 1)));
    EXPECT_TRUE(blocksWithin(assembly, 0.001).empty());
    EXPECT_EQ(pairsWithoutJoint<2>(assembly, near, {}), near);
    ContactPoint<2> point;
    point.block = 0;
    point.neighbour = 1;
    EXPECT_TRUE(pairsWithoutJoint<2>(assembly, near, {point}).empty());
    assembly.blocks[0].support = assembly.blocks[1].support = 0;
    EXPECT_TRUE(pairsWithoutJoint<2>(assembly, near, {}).empty()) << "both fixed";
}

TEST(ShapeChecks, ACornerOnAnEdgeIsALoneTouch)
{
    const Block<2> standing{{{0.5, 1}, {1, 1.5}, {0.5, 2}, {0, 1.5}}};
    const auto touches = loneTouches(standing, boxOf(0, 0, 1, 1), 1e-9);
    ASSERT_EQ(touches.size(), 1U);
    EXPECT_NEAR((touches.front() - Vector<2>(0.5, 1)).norm(), 0, 1e-12);
    EXPECT_TRUE(loneTouches(standing, boxOf(0, -1, 1, 0), 1e-9).empty());
}

TEST(Overlaps, TheLargestIsOfAllPairsButTheSameBlockTwice)
{
    Assembly<2> assembly;
    const Block<2> square = boxOf(0, 0, 1, 1);
    // Too little to be a fault, a fault, and a block that is there twice.
    assembly.blocks = {square, boxOf(1 - 1e-9, 0, 2, 1)};
    const OverlapSearch<2> little = searchOverlaps(assembly, {});
    EXPECT_TRUE(little.faults.empty());
    EXPECT_NEAR(little.largest, 1e-9, 1e-12);
    assembly.blocks.push_back(boxOf(1.8, 0, 3.8, 1));
    EXPECT_NEAR(searchOverlaps(assembly, {}).largest, 0.2, 1e-6);
    assembly.blocks.push_back(square);
    const OverlapSearch<2> all = searchOverlaps(assembly, {});
    EXPECT_NEAR(all.largest, 0.2, 1e-6);
    ASSERT_EQ(all.faults.size(), 2U);
    EXPECT_EQ(findOverlaps(assembly).size(), 2U);
    EXPECT_EQ(searchOverlaps(Assembly<3>(), {}).largest, 0) << "nothing to overlap";
}

} // namespace drystone
