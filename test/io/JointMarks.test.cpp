// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Hinges and sliding joints of mechanisms of the plane, and their pictures.
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

} // namespace
} // namespace drystone
