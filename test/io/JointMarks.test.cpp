// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Hinges and sliding joints of mechanisms, and their pictures.
#include "io/JointMarks.h"
#include "contact/ContactPoint.h"
#include "io/MechanismPicture.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace drystone
{
namespace
{

using testing::HasSubstr;
using testing::Not;

/// Two boxes of 0.4 x 1 m on each other, on a fixed one.
Assembly<2> tower()
{
    Assembly<2> assembly;
    assembly.supports.push_back({"base", "blocks"});
    assembly.blocks.push_back({{{0, -1}, {0.4, -1}, {0.4, 0}, {0, 0}}, 1, 0});
    assembly.blocks.push_back({{{0, 0}, {0.4, 0}, {0.4, 1}, {0, 1}}, 1, -1});
    assembly.blocks.push_back({{{0, 1}, {0.4, 1}, {0.4, 2}, {0, 2}}, 1, -1});
    return assembly;
}

std::vector<JointMark> marksOf(const Assembly<2>& assembly, const Rates<2>& rates)
{
    const std::vector<ContactPoint<2>> points = findContactPoints(assembly);
    return jointMarks(assembly, points, std::vector<double>(points.size(), 0.5), rates);
}

std::string pictureOf(const Assembly<2>& assembly, const Rates<2>& rates)
{
    MechanismPicture picture;
    picture.marks = marksOf(assembly, rates);
    return mechanismSvg(assembly, mechanismPlacements(assembly, rates, 0.1), picture);
}

TEST(JointMarks, OfATowerThatTurnsAboutItsFootIsThatCorner)
{
    const Assembly<2> assembly = tower();
    // To the right about (0.4, 0): w = -1, centres at (0.2, 0.5) and (0.2, 1.5).
    Rates<2> rates = Rates<2>::Zero(3, 3);
    rates.col(1) << 0.5, 0.2, -1;
    rates.col(2) << 1.5, 0.2, -1;
    const std::vector<JointMark> marks = marksOf(assembly, rates);
    ASSERT_EQ(marks.size(), 1U); // the boxes stay on each other
    EXPECT_EQ(marks[0].motion, JointMotion::hinge);
    ASSERT_EQ(marks[0].points.size(), 1U);
    EXPECT_NEAR((marks[0].points[0] - Vector<3>(0.4, 0, 0)).norm(), 0, 1e-12);
    const std::string picture = pictureOf(assembly, rates);
    EXPECT_THAT(picture, HasSubstr(">hinge<"));
    EXPECT_THAT(picture, HasSubstr("#c2185b"));
    EXPECT_THAT(picture, Not(HasSubstr(">sliding<")));
}

TEST(JointMarks, OfABoxThatSlidesIsItsJoint)
{
    const Assembly<2> assembly = tower();
    Rates<2> rates = Rates<2>::Zero(3, 3);
    rates.col(2) << 1, 0, 0;
    const std::vector<JointMark> marks = marksOf(assembly, rates);
    ASSERT_EQ(marks.size(), 1U);
    EXPECT_EQ(marks[0].motion, JointMotion::sliding);
    ASSERT_EQ(marks[0].points.size(), 2U);
    EXPECT_NEAR((marks[0].points[0] - marks[0].points[1]).norm(), 0.4, 1e-12);
    EXPECT_THAT(pictureOf(assembly, rates), HasSubstr(">sliding<"));
}

TEST(JointMarks, WhatPartsAltogetherHasNone)
{
    const Assembly<2> assembly = tower();
    Rates<2> rates = Rates<2>::Zero(3, 3);
    rates.col(2) << 0, 1, 0;
    EXPECT_TRUE(marksOf(assembly, rates).empty());
    EXPECT_THAT(pictureOf(assembly, rates), Not(HasSubstr(">hinge<")));
}

Block<3> box(const Vector<3>& lower, const Vector<3>& upper, int support)
{
    Polyhedron shape;
    for (const double z : {lower.z(), upper.z()})
    {
        shape.vertices.emplace_back(lower.x(), lower.y(), z);
        shape.vertices.emplace_back(upper.x(), lower.y(), z);
        shape.vertices.emplace_back(upper.x(), upper.y(), z);
        shape.vertices.emplace_back(lower.x(), upper.y(), z);
    }
    shape.faces = {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}};
    Block<3> block;
    block.shape = shape;
    block.support = support;
    return block;
}

/// A box on a fixed one that turns about the edge of its foot at the side y, as seen with a wall in front or
/// without: a wall of the width given between the viewer, who looks along y, and the boxes.
std::string pictureOfATurningBox(double y, double widthOfWall)
{
    Assembly<3> assembly;
    assembly.supports.push_back({"base", "blocks"});
    assembly.blocks.push_back(box({0, 0, -1}, {1, 1, 0}, 0));
    assembly.blocks.push_back(box({0, 0, 0}, {1, 1, 2}, -1));
    if (widthOfWall > 0)
    {
        assembly.blocks.push_back(box({-0.5, -2, -1}, {-0.5 + widthOfWall, -1.5, 3}, 0));
    }
    MechanismPicture picture;
    picture.towardsViewer = Vector<3>(0, -1, 0);
    picture.marks.push_back({JointMotion::hinge, 1, 0, {{0, y, 0}, {1, y, 0}}});
    Rates<3> rates = Rates<3>::Zero(6, static_cast<Eigen::Index>(assembly.blocks.size()));
    rates.col(1) << 0, 0.1, 0, 0, 0, 0;
    return mechanismSvg(assembly, mechanismPlacements(assembly, rates, 0.01), picture);
}

TEST(JointMarks, InSpaceTheLegendHasWhatIsSeen)
{
    EXPECT_THAT(pictureOfATurningBox(0, 0), HasSubstr(">hinge<"));
    EXPECT_THAT(pictureOfATurningBox(1, 0), Not(HasSubstr(">hinge<"))); // at its back
    EXPECT_THAT(pictureOfATurningBox(0, 2), Not(HasSubstr(">hinge<"))); // behind the wall
    EXPECT_THAT(pictureOfATurningBox(0, 1), HasSubstr(">hinge<"));      // half of it is
}

} // namespace
} // namespace drystone
