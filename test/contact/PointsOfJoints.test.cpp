// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Tests of the points of each joint in a list.
#include "contact/PointsOfJoints.h"

#include <gtest/gtest.h>

namespace drystone
{
namespace
{

std::vector<ContactPoint<2>> pointsOf(const std::vector<int>& joints)
{
    std::vector<ContactPoint<2>> points(joints.size());
    for (std::size_t i = 0; i < joints.size(); ++i)
    {
        points[i].joint = joints[i];
    }
    return points;
}

TEST(PointsOfJoints, AreTheRangesOfEqualJointsInTheirOrder)
{
    const std::vector<PointRange> joints = pointsOfJoints(pointsOf({4, 4, 2, 7, 7, 7}));
    ASSERT_EQ(joints.size(), 3u);
    EXPECT_EQ(joints[0].begin, 0u);
    EXPECT_EQ(joints[0].end, 2u);
    EXPECT_EQ(joints[1].begin, 2u);
    EXPECT_EQ(joints[1].end, 3u);
    EXPECT_EQ(joints[2].begin, 3u);
    EXPECT_EQ(joints[2].end, 6u);
    EXPECT_EQ(joints[2].size(), 3u);
}

TEST(PointsOfJoints, AreNoneWithoutPoints)
{
    EXPECT_TRUE(pointsOfJoints(pointsOf({})).empty());
}

TEST(PointsOfJoints, AreOneRangeWhereAllPointsAreOfOneJoint)
{
    const std::vector<PointRange> joints = pointsOfJoints(pointsOf({-1, -1}));
    ASSERT_EQ(joints.size(), 1u);
    EXPECT_EQ(joints[0].size(), 2u);
}

} // namespace
} // namespace drystone
