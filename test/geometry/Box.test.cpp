// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Boxes around points and boxes, and which of them are far from the origin.
#include "geometry/Box.h"

#include <gtest/gtest.h>

using namespace drystone;

TEST(Box, AroundPointsItIsTheSmallestThatContainsThem)
{
    const Box<3> box = boxAround<3>({{1, 2, -3}, {4, -1, 0}, {3, 5, -2}});
    EXPECT_EQ(box.lower, Vector<3>(1, -1, -3));
    EXPECT_EQ(box.upper, Vector<3>(4, 5, 0));
    EXPECT_FALSE(meet(boxAround<3>({}), box)) << "a box around nothing is empty";
}

TEST(Box, FarFromTheOriginIsMoreThanAHundredTimesTheLargestSide)
{
    const auto boxAt = [](double x, double y) { return Box<2>{{x, y}, {x + 1, y + 2}}; };
    EXPECT_FALSE(isFarFromOrigin(boxAt(0, 0)));
    EXPECT_FALSE(isFarFromOrigin(boxAt(198.5, 0)));
    EXPECT_TRUE(isFarFromOrigin(boxAt(199.5, 0)));
    EXPECT_FALSE(isFarFromOrigin(boxAt(0, -199.5)));
    EXPECT_TRUE(isFarFromOrigin(boxAt(0, -200.5)));
    EXPECT_TRUE(isFarFromOrigin(boxAt(-512345.25, 4649876.5)));
}

TEST(Box, APointIsFarFromTheOriginUnlessItIsThereAndAnEmptyBoxIsNot)
{
    EXPECT_FALSE(isFarFromOrigin(Box<2>{}));
    EXPECT_FALSE(isFarFromOrigin(boxAround<2>({{0, 0}})));
    EXPECT_TRUE(isFarFromOrigin(boxAround<2>({{1, 0}})));
}
