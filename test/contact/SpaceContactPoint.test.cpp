// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Joints between polyhedra of every shape.
#include "../Polygons.h"

#include "contact/ContactPoint.h"
#include "contact/JointClosure.h"
#include "contact/space/FacingPatches.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

using namespace drystone;

namespace
{

using test::letterL;

std::vector<Vector<3>> atHeight(const Polygon& polygon, double z)
{
    std::vector<Vector<3>> corners;
    for (const Vector<2>& corner : polygon)
    {
        corners.emplace_back(corner.x(), corner.y(), z);
    }
    return corners;
}

Block<3> prism(const Polygon& section, double lower, double upper)
{
    return {makePrism(atHeight(section, lower), atHeight(section, upper))};
}

const Polygon letterU{{0, 0}, {3, 0}, {3, 2}, {2, 2}, {2, 1}, {1, 1}, {1, 2}, {0, 2}};

int jointCount(const std::vector<ContactPoint<3>>& points)
{
    return points.empty() ? 0 : points.back().joint + 1;
}

Vector<3> areaOf(const std::vector<Vector<3>>& corners)
{
    Vector<3> twice = Vector<3>::Zero();
    for (std::size_t i = 1; i + 1 < corners.size(); ++i)
    {
        twice += (corners[i] - corners[0]).cross(corners[i + 1] - corners[0]);
    }
    return twice / 2;
}

FacingTolerance near(double distance)
{
    FacingTolerance tolerance;
    tolerance.distance = distance;
    tolerance.straight = distance / 2;
    tolerance.leastLength = distance;
    return tolerance;
}

Assembly<3> moved(Assembly<3> assembly, const Eigen::Matrix3d& rotation, const Vector<3>& shift)
{
    for (Block<3>& block : assembly.blocks)
    {
        for (Vector<3>& vertex : block.shape.vertices)
        {
            vertex = (rotation * vertex + shift).eval();
        }
    }
    return assembly;
}

/// Boxes in courses, cut at random along x and y: non-conforming joints everywhere. Three metres by two.
Assembly<3> randomPier(std::mt19937& random, int courses)
{
    std::uniform_real_distribution<double> uniform(0.3, 1);
    std::uniform_int_distribution<int> count(1, 4);
    const auto cuts = [&](double length)
    {
        std::vector<double> places{0};
        for (int i = count(random); i > 0; --i)
        {
            places.push_back(places.back() + uniform(random));
        }
        for (double& place : places)
        {
            place *= length / places.back();
        }
        return places;
    };
    Assembly<3> pier;
    for (int course = 0; course < courses; ++course)
    {
        const std::vector<double> x = cuts(3);
        for (std::size_t i = 0; i + 1 < x.size(); ++i)
        {
            const std::vector<double> y = cuts(2);
            for (std::size_t j = 0; j + 1 < y.size(); ++j)
            {
                pier.blocks.push_back(
                    {makeBox({x[i], y[j], 0.2 * course}, {x[i + 1], y[j + 1], 0.2 * (course + 1)})});
            }
        }
    }
    pier.supports = {{"ground", "ground"}};
    pier.blocks.push_back({makeBox({-5, -5, -1}, {5, 5, 0}), 0});
    return pier;
}

TEST(SpaceContactPoint, ABoxOnTheGroundTouchesAtItsFourCornersWithTheNormalIntoIt)
{
    const Assembly<3> assembly{{{makeBox({0, 0, 0}, {1, 2, 1})}, {makeBox({-5, -5, -1}, {5, 5, 0}), 0}},
                               {{"ground", "ground"}}};
    const auto points = findContactPoints(assembly);
    ASSERT_EQ(points.size(), 4U);
    for (const ContactPoint<3>& point : points)
    {
        EXPECT_EQ(point.block, 0);
        EXPECT_EQ(point.neighbour, 1);
        EXPECT_EQ(point.joint, 0);
        EXPECT_EQ(point.normal, Vector<3>(0, 0, 1));
        EXPECT_EQ(point.position.z(), 0);
        EXPECT_EQ(point.gap, 0);
        EXPECT_EQ(contactFrame(point), (Eigen::Matrix3d() << 0, 1, 0, 0, 0, 1, 1, 0, 0).finished());
    }
    Vector<3> sum = Vector<3>::Zero();
    for (const ContactPoint<3>& point : points)
    {
        sum += point.position;
    }
    EXPECT_EQ(sum, Vector<3>(2, 4, 0));
}

TEST(SpaceContactPoint, EdgesAndCornersThatTouchAreNoJointAndTwoFixedBlocksHaveNone)
{
    const Block<3> box{makeBox({0, 0, 0}, {1, 1, 1})};
    EXPECT_TRUE(findContactPoints(Assembly<3>{{box, {makeBox({1, 1, 0}, {2, 2, 1})}}, {}}).empty());
    EXPECT_TRUE(findContactPoints(Assembly<3>{{box, {makeBox({1, 1, 1}, {2, 2, 2})}}, {}}).empty());
    EXPECT_TRUE(findContactPoints(Assembly<3>{{box, {makeBox({0.2, 1, 1}, {2, 2, 2})}}, {}}).empty());
    Assembly<3> stack{{box, {makeBox({0, 0, 1}, {1, 1, 2})}}, {{"a", "blocks"}}};
    EXPECT_EQ(jointCount(findContactPoints(stack)), 1);
    stack.blocks[0].support = 0;
    stack.blocks[1].support = 0;
    EXPECT_TRUE(findContactPoints(stack).empty());
}

TEST(SpaceContactPoint, AnLShapedFaceHasItsSixCornersAndAUShapedOneSeveralPatches)
{
    const Assembly<3> letter{{prism(letterL, 0, 1), {makeBox({-1, -1, -1}, {4, 4, 0})}}, {}};
    EXPECT_EQ(findContactPoints(letter).size(), 6U);
    const Assembly<3> bridge{{prism(letterU, 0, 1), {makeBox({-1, 1.5, 1}, {4, 3, 2})}}, {}};
    const auto points = findContactPoints(bridge);
    EXPECT_EQ(jointCount(points), 2);
    EXPECT_EQ(points.size(), 8U);
    for (std::size_t i = 1; i < points.size(); ++i)
    {
        EXPECT_GE(points[i].joint, points[i - 1].joint);
    }
    // A box in the U touches it with three sides and has nothing above or below.
    const Assembly<3> inside{{prism(letterU, 0, 1), {makeBox({1, 1, 0}, {2, 2, 1})}}, {}};
    EXPECT_EQ(jointCount(findContactPoints(inside)), 3);
}

TEST(SpaceContactPoint, VerticesThatSplitAnEdgeAddNoPointsAndAFaceInTrianglesHasTheSameArea)
{
    const Assembly<3> split{{prism({{0, 0}, {0.25, 0}, {0.5, 0}, {1, 0}, {1, 1}, {0.3, 1}, {0, 1}}, 0, 1),
                             {makeBox({-1, 0, -1}, {4, 4, 0})}},
                            {}};
    EXPECT_EQ(findContactPoints(split).size(), 4U);
    Assembly<3> triangles{{{makeBox({0, 0, 0}, {1, 1, 1})}, {makeBox({-1, -1, -1}, {4, 4, 0})}}, {}};
    auto& faces = triangles.blocks[0].shape.faces;
    const std::vector<int> bottom = faces[0];
    faces[0] = {bottom[0], bottom[1], bottom[2]};
    faces.push_back({bottom[0], bottom[2], bottom[3]});
    const auto patches = findFacingPatches(triangles, near(1e-6));
    ASSERT_EQ(patches.size(), 2U);
    EXPECT_NEAR((areaOf(patches[0].corners) + areaOf(patches[1].corners) - Vector<3>(0, 0, -1)).norm(), 0,
                1e-15);
}

TEST(SpaceContactPoint, FacesFartherApartThanTheToleranceOrInclinedAreNoJoint)
{
    const auto withTolerance = [](Assembly<3> assembly, double tolerance)
    {
        assembly.jointTolerance = tolerance;
        closeJoints(assembly);
        return assembly;
    };
    const auto above = [](double gap) {
        return Assembly<3>{{{makeBox({0, 0, 0}, {1, 1, 1})}, {makeBox({0, 0, 1 + gap}, {1, 1, 2})}}, {}};
    };
    EXPECT_EQ(jointCount(findContactPoints(above(5e-7))), 1);
    EXPECT_EQ(jointCount(findContactPoints(above(-5e-7))), 1);
    EXPECT_EQ(jointCount(findContactPoints(above(2e-6))), 0);
    EXPECT_EQ(jointCount(findContactPoints(withTolerance(above(2e-6), 1e-5))), 1);
    const auto patches = findFacingPatches(above(5e-7), near(1e-6));
    ASSERT_EQ(patches.size(), 1U);
    EXPECT_NEAR(patches[0].gaps[0], 5e-7, 1e-15);
    EXPECT_NEAR(patches[0].corners[0].z(), 1 + 2.5e-7, 1e-15);
    // Turned about an edge by 1e-5: open at the other side by as much.
    Assembly<3> wedge = above(0);
    for (int corner : {1, 2})
    {
        wedge.blocks[1].shape.vertices[corner].z() += 1e-5;
    }
    EXPECT_EQ(jointCount(findContactPoints(wedge)), 0);
    EXPECT_EQ(jointCount(findContactPoints(withTolerance(wedge, 2e-5))), 1);
}

TEST(SpaceContactPoint, BedJointsOfRandomPiersCoverEveryCourseOnce)
{
    std::mt19937 random(31);
    for (int i = 0; i < 40; ++i)
    {
        const int courses = 1 + i % 5;
        const Assembly<3> pier = randomPier(random, courses);
        double level = 0;
        for (const FacingPatch& patch : findFacingPatches(pier, near(1e-6)))
        {
            EXPECT_LT(patch.block, patch.neighbour);
            EXPECT_NEAR((areaOf(patch.corners).normalized() + patch.normal).norm(), 0, 1e-12);
            level += std::abs(patch.normal.z()) * areaOf(patch.corners).norm();
        }
        EXPECT_NEAR(level, 6.0 * courses, 1e-12) << "pier " << i;
    }
}

TEST(SpaceContactPoint, ATurnedAndMovedRandomPierHasTheTurnedPoints)
{
    std::mt19937 random(32);
    std::normal_distribution<double> normal;
    for (int i = 0; i < 40; ++i)
    {
        const Assembly<3> pier = randomPier(random, 3);
        const Eigen::Matrix3d rotation =
            Eigen::Quaterniond(normal(random), normal(random), normal(random), normal(random))
                .normalized()
                .toRotationMatrix();
        const Vector<3> shift(1000, -30, 5);
        const auto points = findContactPoints(pier);
        const auto turned = findContactPoints(moved(pier, rotation, shift));
        ASSERT_EQ(turned.size(), points.size()) << "pier " << i;
        ASSERT_EQ(jointCount(turned), jointCount(points)) << "pier " << i;
        for (const ContactPoint<3>& point : turned)
        {
            const Vector<3> back = rotation.transpose() * (point.position - shift);
            const auto same =
                std::count_if(points.begin(), points.end(),
                              [&](const ContactPoint<3>& other)
                              {
                                  return other.joint == point.joint && (other.position - back).norm() < 1e-11
                                         && (rotation * other.normal - point.normal).norm() < 1e-12;
                              });
            EXPECT_EQ(same, 1) << "pier " << i;
        }
    }
}

TEST(SpaceContactPoint, TheFrameOfEveryNormalIsOrthonormalAndRightHanded)
{
    std::mt19937 random(33);
    std::normal_distribution<double> normal;
    for (int i = 0; i < 1000; ++i)
    {
        const double flatness = std::pow(10.0, -(i % 12));
        const Vector<3> direction =
            Vector<3>(flatness * normal(random), flatness * normal(random), normal(random)).normalized();
        const Eigen::Matrix3d frame = frameOf(direction);
        EXPECT_NEAR((frame.transpose() * frame - Eigen::Matrix3d::Identity()).norm(), 0, 1e-14);
        EXPECT_NEAR(frame.determinant(), 1, 1e-14);
        EXPECT_EQ(frame.col(0), direction);
        EXPECT_NEAR(frame(2, 1), 0, 1e-6);
    }
}

TEST(SpaceContactPoint, AGridHasAllCornersAndStaysWithinThePatch)
{
    const Assembly<3> boxes{{{makeBox({0, 0, 0}, {1, 2, 1})}, {makeBox({-5, -5, -1}, {5, 5, 0})}}, {}};
    const auto corners = findContactPoints(boxes);
    EXPECT_EQ(divideJoints(corners, 2).size(), 4U);
    const auto grid = divideJoints(corners, 5);
    EXPECT_EQ(grid.size(), 25U);
    const auto at = [&](double x, double y)
    {
        return std::count_if(grid.begin(), grid.end(),
                             [&](const ContactPoint<3>& point)
                             { return (point.position - Vector<3>(x, y, 0)).norm() < 1e-14; });
    };
    EXPECT_EQ(at(0.25, 0.5), 1);
    EXPECT_EQ(at(1, 2), 1);
    const Assembly<3> letter{{prism(letterL, 0, 1), {makeBox({-1, -1, -1}, {4, 4, 0})}}, {}};
    EXPECT_EQ(divideJoints(findContactPoints(letter), 5).size(), 25U - 4); // without the empty quarter
}

TEST(SpaceContactPoint, StatedJointsAreAllThatThereAre)
{
    Assembly<3> boxes{{{makeBox({0, 0, 0}, {1, 2, 1})}, {makeBox({-5, -5, -1}, {5, 5, 0})}}, {}};
    boxes.statedJoints = {{0, 1, {0, 0, 1}, {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}}}};
    const auto points = findContactPoints(boxes);
    ASSERT_EQ(points.size(), 3U);
    EXPECT_EQ(points[2].position, Vector<3>(1, 1, 0));
    EXPECT_EQ(points[2].block, 0);
    EXPECT_EQ(points[2].neighbour, 1);
    EXPECT_EQ(points[2].joint, 0);
    EXPECT_EQ(points[2].normal, Vector<3>(0, 0, 1));
}

} // namespace
