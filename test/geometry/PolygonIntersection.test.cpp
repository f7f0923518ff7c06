// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Common parts of polygons, convex and concave, that overlap, touch or nearly do.
#include "../Polygons.h"

#include "geometry/PolygonIntersection.h"
#include "geometry/PolygonShape.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <numeric>
#include <random>

using namespace drystone;

namespace
{

using test::letterL;
using test::rectangle;
using test::turned;

const Polygon comb{{0, 0}, {5, 0}, {5, 2}, {4, 2}, {4, 1}, {3, 1},
                   {3, 2}, {2, 2}, {2, 1}, {1, 1}, {1, 2}, {0, 2}};

double totalArea(const std::vector<Polygon>& parts)
{
    return std::accumulate(parts.begin(), parts.end(), 0.0,
                           [](double sum, const Polygon& part) { return sum + areaProperties(part).area; });
}

TEST(PolygonIntersection, TouchingAlongAnEdgeOrAtACornerIsNoPartHoweverItIsTurned)
{
    std::mt19937 random(21);
    std::uniform_real_distribution<double> uniform(-10, 10);
    for (int i = 0; i < 200; ++i)
    {
        const double angle = i == 0 ? 0 : uniform(random);
        const Vector<2> shift = i == 0 ? Vector<2>(0, 0) : Vector<2>(uniform(random), uniform(random));
        const auto move = [&](const Polygon& polygon) { return turned(polygon, angle, shift); };
        for (const Polygon& polygon : {letterL, rectangle(0, 0, 2, 1)})
        {
            EXPECT_TRUE(intersection(move(polygon), move(rectangle(0.5, -1, 1.5, 0)), 1e-9).empty());
            EXPECT_TRUE(intersection(move(polygon), move(rectangle(-1, -1, 0, 0)), 1e-9).empty());
            EXPECT_TRUE(intersection(move(polygon), move(rectangle(2, 1, 3, 2)), 1e-9).empty());
        }
        EXPECT_TRUE(intersection(move(letterL), move(rectangle(1, 1, 2, 2)), 1e-9).empty()); // in its corner
        EXPECT_TRUE(intersection(move(letterL), move(rectangle(1, 1, 2, 2)), 1e-9).empty());
    }
}

TEST(PolygonIntersection, AllCornersOfAPartAreFoundAndNoneThatSplitsAnEdge)
{
    std::mt19937 random(22);
    std::uniform_real_distribution<double> uniform(-10, 10);
    for (int i = 0; i < 200; ++i)
    {
        const double angle = i == 0 ? 0 : uniform(random);
        const Vector<2> shift = i == 0 ? Vector<2>(0, 0) : Vector<2>(uniform(random), uniform(random));
        const auto move = [&](const Polygon& polygon) { return turned(polygon, angle, shift); };
        const auto same = intersection(move(letterL), move(letterL), 1e-9);
        ASSERT_EQ(same.size(), 1U) << i;
        EXPECT_EQ(same[0].size(), 6U) << i;
        EXPECT_NEAR(totalArea(same), 3, 1e-11);
        const auto flush = intersection(move(rectangle(0, 0, 2, 1)), move(rectangle(1, 0, 3, 1)), 1e-9);
        ASSERT_EQ(flush.size(), 1U) << i;
        EXPECT_EQ(flush[0].size(), 4U) << i;
        EXPECT_NEAR(totalArea(flush), 1, 1e-12);
        const auto within = intersection(move(letterL), move(rectangle(0.25, 0.25, 1.5, 1.5)), 1e-9);
        ASSERT_EQ(within.size(), 1U) << i;
        EXPECT_EQ(within[0].size(), 6U) << i;
        EXPECT_NEAR(totalArea(within), 1.5625 - 0.25, 1e-11);
    }
}

TEST(PolygonIntersection, AConcavePolygonMayShareSeveralParts)
{
    for (const double angle : {0.0, 0.3, 1.0, 2.5})
    {
        const auto parts =
            intersection(turned(comb, angle, {3, 4}), turned(rectangle(-1, 1, 6, 3), angle, {3, 4}), 1e-9);
        ASSERT_EQ(parts.size(), 3U);
        for (const Polygon& part : parts)
        {
            EXPECT_EQ(part.size(), 4U);
            EXPECT_NEAR(areaProperties(part).area, 1, 1e-10);
        }
        // Tooth in gap: they touch along three edges each.
        EXPECT_TRUE(
            intersection(turned(comb, angle, {3, 4}), turned(rectangle(1, 1, 2, 3), angle, {3, 4}), 1e-9)
                .empty());
    }
}

TEST(PolygonIntersection, ATongueThinnerThanTheToleranceIsCutOff)
{
    // A flap of 1e-10 above the step of the L.
    const auto parts = intersection(letterL, rectangle(0.5, 1 - 1e-10, 3, 3), 1e-9);
    ASSERT_EQ(parts.size(), 1U);
    EXPECT_EQ(parts[0].size(), 4U);
    EXPECT_NEAR(totalArea(parts), 0.5, 1e-9);
    EXPECT_TRUE(intersection(letterL, rectangle(1.2, 1 - 1e-10, 3, 3), 1e-9).empty());
}

TEST(PolygonIntersection, RandomStarsHaveTheAreaThatTheirTrianglesHaveInCommon)
{
    std::mt19937 random(23);
    std::uniform_real_distribution<double> radius(0.3, 1);
    std::uniform_real_distribution<double> uniform(-1, 1);
    const auto star = [&](int corners)
    {
        Polygon polygon;
        for (int i = 0; i < corners; ++i)
        {
            const double angle = 2 * std::numbers::pi * i / corners;
            polygon.push_back(radius(random) * Vector<2>(std::cos(angle), std::sin(angle)));
        }
        return polygon;
    };
    for (int i = 0; i < 300; ++i)
    {
        const Polygon a = star(3 + i % 17);
        const Polygon b = turned(star(3 + i % 11), 3 * uniform(random), {uniform(random), uniform(random)});
        const std::vector<Polygon> parts = intersection(a, b, 1e-9);
        EXPECT_NEAR(totalArea(parts), overlapArea(a, b), 1e-8) << i;
        for (const Polygon& part : parts)
        {
            EXPECT_FALSE(findSelfIntersection(part, 1e-12)) << i;
        }
    }
}

} // namespace
