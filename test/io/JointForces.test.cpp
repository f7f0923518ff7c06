// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
#include "io/JointForces.h"

#include "Scene.h"
#include "core/Error.h"

#include <gtest/gtest.h>

#include <vector>

namespace drystone
{
namespace
{

using test::contact;

TEST(JointForces, AddUpAtTheCentreOfPressure)
{
    std::vector<ContactPoint<2>> points(4);
    points[0] = contact(0, 1, 0, {0, 1}, {0, 1});
    points[1] = contact(0, 1, 0, {4, 1}, {0, 1});
    points[2] = contact(1, 2, 1, {0, 2}, {0, 1}); // carries nothing
    points[3] = contact(1, 2, 1, {4, 2}, {0, 1});
    const auto joints = jointForces(points, {{1, 0.25}, {3, 0.25}, {0, 0}, {0, 0}});
    ASSERT_EQ(joints.size(), 1u);
    EXPECT_EQ(joints[0].centre, Vector<2>(3, 1));
    EXPECT_EQ(joints[0].force, Vector<2>(0.5, 4));
}

TEST(JointSum, HasTheForcesInTheJointAndInTheWorld)
{
    std::vector<ContactPoint<2>> points(3);
    points[0] = contact(0, 1, 0, {0, 1}, {0, 1});
    points[1] = contact(0, 1, 0, {4, 1}, {0, 1});
    points[2] = contact(1, 2, 1, {2, 5}, {1, 0});
    const auto joints = jointSums(points, {{1, 0.25}, {3, 0.25}, {-2, 1}});
    ASSERT_EQ(joints.size(), 2u);
    EXPECT_EQ(joints[0].points.begin, 0u);
    EXPECT_EQ(joints[0].points.end, 2u);
    EXPECT_EQ(joints[0].inJoint, Vector<2>(4, 0.5));
    EXPECT_EQ(joints[0].force, Vector<2>(0.5, 4));
    EXPECT_EQ(joints[1].points.begin, 2u);
    EXPECT_EQ(joints[1].points.end, 3u);
    EXPECT_EQ(joints[1].force, Vector<2>(-2, -1)); // the tangent is the normal turned by -90 degrees
    EXPECT_EQ(joints[1].centreOfPressure(), Vector<2>(2, 5));
    EXPECT_THROW(jointSums(points, {{1, 0}}), FatalError);
}

TEST(JointSum, WithoutNormalForceHasNoCentreOfPressure)
{
    const std::vector<ContactPoint<2>> points{contact(0, 1, 0, {0, 1}, {0, 1}),
                                              contact(0, 1, 0, {4, 1}, {0, 1})};
    for (const double rounding : {0.0, 1e-7, -1e-7})
    {
        const auto joints = jointSums(points, {{-1000, 50}, {1000 + rounding, 30}});
        ASSERT_EQ(joints.size(), 1u);
        EXPECT_FALSE(joints[0].hasCentreOfPressure()) << rounding;
    }
    EXPECT_TRUE(jointSums(points, {{-1000, 50}, {900, 30}})[0].hasCentreOfPressure());
}

} // namespace
} // namespace drystone
