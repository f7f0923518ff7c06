// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Distances of edges, against those of many points on them.
#include "geometry/space/EdgeLine.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>

using namespace drystone;

namespace
{

TEST(EdgeLine, OfABoxAreTwelve)
{
    const std::vector<EdgeLine> edges = edgesOf(makeBox({0, 0, 0}, {1, 2, 3}));
    EXPECT_EQ(edges.size(), 12U);
    double length = 0;
    for (const EdgeLine& edge : edges)
    {
        length += edge.along.norm();
    }
    EXPECT_DOUBLE_EQ(length, 4 * (1 + 2 + 3));
}

TEST(EdgeLine, IsNearestToAnotherWhereBothAreCrossedAtRightAngles)
{
    const EdgeLine edge{{0, 0, 0}, {4, 0, 0}};
    const std::optional<double> part = nearestToLine(edge, {{1, -1, 2}, {0, 5, 0}});
    ASSERT_TRUE(part);
    EXPECT_DOUBLE_EQ(*part, 0.25);
    EXPECT_FALSE(nearestToLine(edge, {{0, 1, 0}, {-2, 0, 0}}));
}

TEST(EdgeLine, OfParallelEdgesTheDistanceIsThatOfTheirEndsOrOfTheirLines)
{
    const EdgeLine edge{{0, 0, 0}, {1, 0, 0}};
    EXPECT_DOUBLE_EQ(distance(edge, {{0.5, 3, 0}, {4, 0, 0}}), 3);
    EXPECT_DOUBLE_EQ(distance(edge, {{4, 4, 0}, {1, 0, 0}}), 5);
    EXPECT_DOUBLE_EQ(distance(edge, {{-3, 4, 0}, {-1, 0, 0}}), 5);
    EXPECT_DOUBLE_EQ(distance(edge, {{8, 4, 0}, {-4, 0, 0}}), 5);
}

TEST(EdgeLine, AreApartAsFarAsTheNearestOfManyPlacesOnThem)
{
    std::mt19937 random(1);
    std::uniform_real_distribution<double> place(-1, 1);
    const auto any = [&] { return Vector<3>(place(random), place(random), place(random)); };
    for (int pair = 0; pair < 200; ++pair)
    {
        const EdgeLine one{any(), any()};
        const EdgeLine other{any(), any()};
        double least = std::numeric_limits<double>::infinity();
        constexpr int parts = 1000;
        for (int i = 0; i <= parts; ++i)
        {
            const Vector<3> from = one.at(static_cast<double>(i) / parts);
            least = std::min(least, (other.at(std::clamp(other.nearest(from), 0.0, 1.0)) - from).norm());
        }
        EXPECT_LE(distance(one, other), least + 1e-12);
        EXPECT_GE(distance(one, other), least - 2.0 / parts);
        EXPECT_NEAR(distance(one, other), distance(other, one), 1e-12);
    }
}

} // namespace
