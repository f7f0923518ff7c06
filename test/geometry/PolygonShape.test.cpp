// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Shape of polygons: simple outlines, triangulation, overlaps.
#include "../Polygons.h"

#include "geometry/PolygonShape.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

using namespace drystone;

namespace
{

using test::letterL;
using test::randomStar;
using test::rectangle;
using test::turned;

TEST(PolygonShape, SimpleOutlinesDoNotIntersectThemselves)
{
    EXPECT_FALSE(findSelfIntersection(letterL, 1e-9));
    EXPECT_FALSE(
        findSelfIntersection({{0, 0}, {0.5, 0}, {1, 0}, {0, 1}}, 1e-9)); // a straight corner is not a fold
    std::mt19937 random(1);
    EXPECT_FALSE(findSelfIntersection(randomStar(random, 300), 1e-9));
}

TEST(PolygonShape, ABowTieCrossesItself)
{
    EXPECT_EQ(findSelfIntersection({{0, 0}, {1, 1}, {1, 0}, {0, 1}}, 1e-9), std::pair(0, 2));
}

TEST(PolygonShape, ACornerThatTouchesAnotherEdgeAndASpikeAreNotSimple)
{
    EXPECT_TRUE(findSelfIntersection({{0, 0}, {2, 0}, {2, 1}, {1, 0}, {0, 1}}, 1e-9));
    EXPECT_TRUE(findSelfIntersection({{0, 0}, {1, 0}, {1, 1}, {1, 2}, {1, 1}, {0, 1}}, 1e-9));
    EXPECT_TRUE(findSelfIntersection({{0, 0}, {1, 0}, {2, 0}}, 1e-9)); // no area at all
}

TEST(PolygonShape, ALongOutlineThatCrossesItselfFarAlongIsFound)
{
    std::mt19937 random(1);
    Polygon star = randomStar(random, 300);
    std::swap(star[200], star[210]);
    EXPECT_TRUE(findSelfIntersection(star, 1e-9));
}

TEST(PolygonShape, TrianglesOfRandomStarsMakeUpTheirArea)
{
    std::mt19937 random(2);
    for (int corners : {3, 4, 5, 8, 30, 100})
    {
        const Polygon star = randomStar(random, corners);
        double area = 0;
        for (const auto& [a, b, c] : triangulate(star))
        {
            EXPECT_GT(cross(b - a, c - a), 0);
            area += cross(b - a, c - a) / 2;
        }
        EXPECT_NEAR(area, areaProperties(star).area, 1e-13);
    }
}

TEST(PolygonShape, ConvexPartsMakeUpTheWhole)
{
    const Polygon square = rectangle(0, 0, 2, 2);
    EXPECT_EQ(convexParts(square), std::vector<Polygon>{square});
    std::mt19937 random(5);
    std::vector<Polygon> outlines{letterL};
    for (int i = 0; i < 20; ++i)
    {
        outlines.push_back(randomStar(random, 12));
    }
    for (const Polygon& outline : outlines)
    {
        double area = 0;
        for (const Polygon& part : convexParts(outline))
        {
            EXPECT_TRUE(isConvex(part));
            area += areaProperties(part).area;
        }
        EXPECT_NEAR(area, areaProperties(outline).area, 1e-12);
    }
}

TEST(PolygonShape, BlocksThatTouchOverlapByNothing)
{
    std::mt19937 random(3);
    std::uniform_real_distribution<double> uniform(-10, 10);
    for (int i = 0; i < 100; ++i)
    {
        const double angle = uniform(random);
        const Vector<2> shift(uniform(random), uniform(random));
        const Polygon left = turned(letterL, angle, shift);
        EXPECT_NEAR(overlapArea(left, turned(rectangle(1, 1, 2, 2), angle, shift)), 0, 1e-14);
        EXPECT_NEAR(overlapArea(left, turned(rectangle(2, 0, 2.5, 1.5), angle, shift)), 0, 1e-14);
        EXPECT_NEAR(overlapArea(left, turned(rectangle(0.5, 0.5, 1.5, 1.5), angle, shift)), 0.75, 1e-13);
        EXPECT_NEAR(overlapArea(left, left), 3, 1e-13);
    }
}

TEST(PolygonShape, OverlapOfRandomStarsAgreesWithCountingPoints)
{
    std::mt19937 random(4);
    const Polygon a = randomStar(random, 17);
    const Polygon b = turned(randomStar(random, 12), 0.3, {0.4, 0.2});
    const int cells = 1000;
    int common = 0;
    for (int i = 0; i < cells; ++i)
    {
        for (int j = 0; j < cells; ++j)
        {
            const Vector<2> point(-1 + 2 * (i + 0.5) / cells, -1 + 2 * (j + 0.5) / cells);
            common += signedDistance(a, point) < 0 && signedDistance(b, point) < 0 ? 1 : 0;
        }
    }
    // A cell is miscounted only where an outline passes: error far below perimeter x cell size = 0.02.
    EXPECT_NEAR(overlapArea(a, b), 4.0 * common / cells / cells, 2e-3);
    EXPECT_NEAR(overlapArea(b, a), overlapArea(a, b), 1e-14);
}

TEST(PolygonShape, SignedDistanceIsNegativeInsideAndZeroOnTheOutline)
{
    EXPECT_DOUBLE_EQ(signedDistance(letterL, {0.5, 0.25}), -0.25);
    EXPECT_DOUBLE_EQ(signedDistance(letterL, {1.5, 1.5}), 0.5);
    EXPECT_DOUBLE_EQ(signedDistance(letterL, {1, 1.5}), 0);
    EXPECT_DOUBLE_EQ(signedDistance(letterL, {-3, -4}), 5);
}

TEST(PolygonShape, ANeedleHasASmallCompactnessAndASmallAngle)
{
    const ShapeQuality square = shapeQuality(rectangle(0, 0, 1, 1));
    EXPECT_NEAR(square.compactness, std::numbers::pi / 4, 1e-15);
    EXPECT_NEAR(square.smallestAngle, std::numbers::pi / 2, 1e-15);
    EXPECT_DOUBLE_EQ(square.shortestEdge, 0.25);
    const ShapeQuality needle = shapeQuality({{0, 0}, {1, 0}, {0, 1e-4}});
    EXPECT_NEAR(needle.smallestAngle, 1e-4, 1e-8);
    EXPECT_LT(needle.compactness, 1e-3);
}

TEST(PolygonShape, EachFaultOfAnOutlineIsNamed)
{
    EXPECT_EQ(outlineFault(letterL), "");
    EXPECT_EQ(outlineFault({letterL.rbegin(), letterL.rend()}), "");
    EXPECT_EQ(outlineFault({{0, 0}, {1, 0}}), "has 2 corners, and needs at least 3");
    EXPECT_EQ(outlineFault({{0, 0}, {1, std::nan("")}, {1, 1}}),
              "has a coordinate that is not finite, at corner 1");
    EXPECT_EQ(outlineFault({{0, 0}, {1, 0}, {1, 1}, {0, 0}}), "has corners 3 and 0 in the same place");
    EXPECT_EQ(outlineFault({{0, 0}, {1, 1}, {2, 2}}), "has no area");
    EXPECT_EQ(outlineFault({{0, 0}, {2, 1}, {1, 0}, {0, 3}}),
              "crosses or touches itself: the edge from corner 0 to 1 meets the one from corner 2 to 3");
    // Far from the origin a block has the same properties as near it.
    EXPECT_EQ(outlineFault({{1e6, 1e6}, {1e6 + 1e-3, 1e6}, {1e6 + 1e-3, 1e6 + 1e-3}}), "");
}

} // namespace
