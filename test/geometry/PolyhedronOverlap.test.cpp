// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/space/PolyhedronOverlap.h"
#include "geometry/space/FacePolygon.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

namespace drystone
{
namespace
{

Polyhedron moved(Polyhedron shape, const Eigen::Matrix3d& turn, const Vector<3>& move)
{
    for (Vector<3>& vertex : shape.vertices)
    {
        vertex = turn * vertex + move;
    }
    return shape;
}

/// An L of three unit cubes.
Polyhedron corner()
{
    return makePrism({{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1, 1, 0}, {1, 2, 0}, {0, 2, 0}},
                     {{0, 0, 1}, {2, 0, 1}, {2, 1, 1}, {1, 1, 1}, {1, 2, 1}, {0, 2, 1}});
}

TEST(PolyhedronOverlap, OfBoxesIsTheirCommonBoxHoweverTheyAreTurned)
{
    std::mt19937 random(1);
    std::uniform_real_distribution<double> chance(0.1, 1);
    for (int i = 0; i < 100; ++i)
    {
        const Vector<3> upper(chance(random), chance(random), chance(random));
        const Vector<3> lower = upper.cwiseProduct(Vector<3>(chance(random), chance(random), chance(random)));
        const Vector<3> far = upper + Vector<3>(chance(random), chance(random), chance(random));
        const Eigen::Matrix3d turn =
            Eigen::AngleAxisd(chance(random), Vector<3>(chance(random), chance(random), 1).normalized())
                .toRotationMatrix();
        const Polyhedron a = moved(makeBox({0, 0, 0}, upper), turn, {5, 6, 7});
        const Polyhedron b = moved(makeBox(lower, far), turn, {5, 6, 7});
        EXPECT_NEAR(overlapVolume(a, b), (upper - lower).prod(), 1e-12) << i;
        EXPECT_NEAR(overlapVolume(b, a), (upper - lower).prod(), 1e-12) << i;
        EXPECT_NEAR(overlapDepth(a, b), (upper - lower).minCoeff(), 1e-12) << i;
    }
}

/// A stone of rubble. Corner 3 is on the edge from 0 to 2 but for rounding, and ends the lists of both faces.
Polyhedron stoneWithThreeCornersInALine()
{
    return {{{0, 0, 1.85464},
             {0.307911, 0.281479, 1.72556},
             {0, 0, 1.47606},
             {1.38778e-17, 0, 1.68003},
             {0.304622, 0, 1.47773},
             {0.424257, 0, 1.59411},
             {0.418535, 0, 2},
             {0.28692, 0, 2},
             {0.367328, 0.155625, 1.57221},
             {0.397477, 0.223163, 1.71694}},
            {{0, 1, 2, 3},
             {2, 4, 5, 6, 7, 0, 3},
             {2, 8, 4},
             {8, 5, 4},
             {6, 5, 8},
             {6, 8, 9},
             {8, 1, 9},
             {1, 6, 9},
             {1, 8, 2},
             {1, 0, 7},
             {1, 7, 6}}};
}

// The triangle of three corners in a line has a tetrahedron that is flat but for rounding.
TEST(PolyhedronOverlap, IsThatOfTheSolidsWhereThreeCornersOfAFaceAreInALine)
{
    std::mt19937 random(3);
    std::uniform_real_distribution<double> chance(0.5, 1);
    for (int i = 0; i < 500; ++i)
    {
        Polyhedron stone = stoneWithThreeCornersInALine();
        const Vector<3> scale(chance(random), chance(random), chance(random));
        for (Vector<3>& vertex : stone.vertices)
        {
            vertex = vertex.cwiseProduct(scale);
        }
        EXPECT_NEAR(overlapVolume(makeBox({0, 0.3, 0}, {2, 0.5, 2}), stone), 0, 1e-12) << i;
        EXPECT_NEAR(overlapVolume(makeBox({-1, -1, -1}, {2, 1, 3}), stone), volumeProperties(stone).volume,
                    1e-12)
            << i;
    }
}

TEST(PolyhedronOverlap, BlocksThatTouchOrLieApartHaveNone)
{
    const Polyhedron cube = makeBox({0, 0, 0}, {1, 1, 1});
    for (const Vector<3>& move :
         {Vector<3>(1, 0, 0), Vector<3>(1, 1, 0), Vector<3>(1, 1, 1), Vector<3>(3, 0, 0)})
    {
        const Polyhedron other = moved(cube, Eigen::Matrix3d::Identity(), move);
        EXPECT_EQ(overlapDepth(cube, other), 0);
        EXPECT_NEAR(overlapVolume(cube, other), 0, 1e-14);
    }
    // Edge across edge, parted by neither's faces: only the direction across both edges parts them.
    const Eigen::Matrix3d onEdge =
        Eigen::AngleAxisd(std::numbers::pi / 4, Vector<3>::UnitX()).toRotationMatrix();
    const Polyhedron lower = moved(makeBox({-2, -0.5, -0.5}, {2, 0.5, 0.5}), onEdge, {0, 0, 0});
    const Eigen::Matrix3d across =
        Eigen::AngleAxisd(std::numbers::pi / 2, Vector<3>::UnitZ()).toRotationMatrix();
    const double top = std::sqrt(0.5);
    EXPECT_EQ(overlapDepth(lower, moved(lower, across, {0, 0, 2 * top + 1e-6})), 0);
    EXPECT_NEAR(overlapDepth(lower, moved(lower, across, {0, 0, 2 * top - 0.01})), 0.01, 1e-12);
}

TEST(PolyhedronOverlap, OfConcaveBlocksCountsTheirSolidOnly)
{
    const Polyhedron angle = corner();
    EXPECT_FALSE(isConvex(angle));
    EXPECT_TRUE(isConvex(makeBox({0, 0, 0}, {1, 2, 3})));
    EXPECT_NEAR(overlapVolume(angle, makeBox({1, 1, 0}, {2, 2, 1})), 0, 1e-14); // in the notch
    EXPECT_NEAR(overlapVolume(angle, makeBox({0.9, 0.8, -1}, {2, 2, 0.5})), 0.5 * (1.1 * 0.2 + 0.1 * 1),
                1e-12);
    EXPECT_EQ(overlapDepth(angle, makeBox({1, 1, 0}, {2, 2, 1})), 0);
    EXPECT_NEAR(overlapDepth(angle, makeBox({0.9, 0.9, 0.1}, {2, 2, 0.9})), 0.1, 1e-12);
}

TEST(PolyhedronOverlap, DistancesOfPointsAreFromTheSolid)
{
    const Polyhedron angle = corner();
    EXPECT_EQ(distance(angle, {0.5, 0.5, 0.5}), 0);
    EXPECT_NEAR(distance(angle, {1.5, 1.5, 0.5}), 0.5, 1e-12); // in the notch
    EXPECT_NEAR(distance(angle, {-3, -4, 0.5}), 5, 1e-12);
    EXPECT_NEAR(distance(angle, {1, 1, 2}), 1, 1e-12);
    EXPECT_NEAR(distance(angle, {2, 0.5, 0.5}), 0, 1e-12);
}

// In the plane of its ends the notch of a U is seen under half the full angle, or none, by rounding: a box
// that hung in the notch, flush with both ends, was reported as deep in the block.
TEST(PolyhedronOverlap, OfABoxInANotchFlushWithBothEndsIsNone)
{
    const auto at = [](double y)
    {
        return std::vector<Vector<3>>{{0, y, 0},   {4, y, 0},   {4, y, 1}, {3, y, 1},
                                      {3, y, 0.2}, {1, y, 0.2}, {1, y, 1}, {0, y, 1}};
    };
    const Polyhedron notched = makePrism(at(1), at(0));
    ASSERT_NEAR(volumeProperties(notched).volume, 2.4, 1e-12);
    std::mt19937 random(3);
    std::uniform_real_distribution<double> chance(-1, 1);
    for (int i = 0; i < 200; ++i)
    {
        const Vector<3> lower(1.5 + 0.4 * chance(random), 0, 0.5 + 0.29 * chance(random));
        const Polyhedron box = makeBox(lower, lower + Vector<3>(0.4, 1, 0.4));
        const Eigen::Matrix3d turn =
            Eigen::AngleAxisd(chance(random), Vector<3>(chance(random), chance(random), 1).normalized())
                .toRotationMatrix();
        EXPECT_LT(overlapDepth(moved(notched, turn, {5, 6, 7}), moved(box, turn, {5, 6, 7})), 1e-12) << i;
        const Polyhedron inFloor = moved(box, Eigen::Matrix3d::Identity(), {0, 0, 0.19 - lower.z()});
        EXPECT_NEAR(overlapDepth(notched, inFloor), 0.01, 1e-12) << i;
    }
}

TEST(PolyhedronOverlap, ABallIsMostCompact)
{
    EXPECT_NEAR(solidQuality(makeBox({0, 0, 0}, {1, 1, 1})).compactness, std::numbers::pi / 6, 1e-12);
    EXPECT_LT(solidQuality(makeBox({0, 0, 0}, {1, 1, 1e-3})).compactness, 1e-4);
    EXPECT_NEAR(solidQuality(makeBox({0, 0, 0}, {1, 2, 0.25})).shortestEdge, 0.25, 1e-15);
}

} // namespace
} // namespace drystone
