// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
// Marks of a mechanism's picture: what turns has a hinge line, what slides its edges, and they are painted
// where they are seen.
#include "io/JointMarks.h"

#include "SpaceStructures.h"
#include "core/Error.h"
#include "io/MechanismPicture.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace drystone
{
namespace
{

using test::onGround;
using test::pushed;

/// Marks of the mechanism under a push.
std::vector<JointMark> marksOf(const Assembly<3>& assembly, double mu, const Vector<3>& direction,
                               std::string* picture = nullptr, const Vector<3>& view = usualView())
{
    const std::vector<ContactPoint<3>> points = findContactPoints(assembly);
    const LimitAnalysis result = test::collapse(assembly, points, mu, pushed(assembly, direction));
    EXPECT_EQ(result.status, CollapseStatus::optimal);
    const Rates<3> rates = ratesOfAllBlocks(assembly, result.mechanism);
    std::vector<JointMark> marks =
        jointMarks(assembly, points, std::vector<double>(points.size(), mu), rates);
    if (picture)
    {
        MechanismPicture made;
        made.marks = marks;
        made.towardsViewer = view;
        *picture = mechanismSvg(assembly, mechanismPlacements(assembly, rates, 0.2), made);
    }
    return marks;
}

int count(const std::string& text, const std::string& part)
{
    int number = 0;
    for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1))
    {
        ++number;
    }
    return number;
}

TEST(JointMarks, ABoxThatOverturnsHasALineOrACorner)
{
    const Assembly<3> tower =
        onGround({makeBox({0, 0, 0}, {0.4, 0.2, 1}), makeBox({0, 0, 1}, {0.4, 0.2, 1.2})});
    std::vector<JointMark> marks = marksOf(tower, 2, {1, 0, 0});
    ASSERT_EQ(marks.size(), 1U); // the upper box stays where it is on the lower one
    EXPECT_EQ(marks[0].motion, JointMotion::hinge);
    ASSERT_EQ(marks[0].points.size(), 2U);
    for (const Vector<3>& end : marks[0].points)
    {
        EXPECT_NEAR(end.x(), 0.4, 1e-12);
        EXPECT_NEAR(end.z(), 0, 1e-12);
    }
    EXPECT_NEAR((marks[0].points[0] - marks[0].points[1]).norm(), 0.2, 1e-12);

    marks = marksOf(onGround({makeBox({0, 0, 0}, {0.2, 0.2, 1})}), 2, {1, 1, 0});
    ASSERT_EQ(marks.size(), 1U);
    EXPECT_EQ(marks[0].motion, JointMotion::hinge);
    ASSERT_EQ(marks[0].points.size(), 1U);
    EXPECT_NEAR((marks[0].points[0] - Vector<3>(0.2, 0.2, 0)).norm(), 0, 1e-12);
}

TEST(JointMarks, ABoxThatSlidesHasTheEdgesOfItsJoint)
{
    std::string picture;
    const Assembly<3> assembly =
        onGround({makeBox({0, 0, 0}, {0.4, 0.2, 0.1}), makeBox({0, 0, 0.1}, {0.4, 0.2, 0.2})});
    const std::vector<JointMark> marks = marksOf(assembly, 0.3, {1, 0, 0}, &picture);
    ASSERT_FALSE(marks.empty());
    for (const JointMark& mark : marks)
    {
        EXPECT_EQ(mark.motion, JointMotion::sliding);
        EXPECT_EQ(mark.points.size(), 4U);
    }
    // Two of the four edges are behind the upper box; one line more is the legend's.
    EXPECT_EQ(count(picture, "#1f5fa8"), 2 * static_cast<int>(marks.size()) + 1);
    EXPECT_EQ(count(picture, "#c2185b"), 0);
}

TEST(JointMarks, AHingeIsPaintedWhereItIsSeen)
{
    const Assembly<3> assembly = onGround({makeBox({0, 0, 0}, {0.4, 0.2, 1})});
    for (const auto& [view, lines] : {std::pair("right", 2), std::pair("top", 1), std::pair("(1 -1 0.5)", 2)})
    {
        std::string picture;
        marksOf(assembly, 2, {1, 0, 0}, &picture, viewFrom(view));
        EXPECT_EQ(count(picture, "#c2185b"), lines) << view; // one in the legend
    }
}

TEST(ViewFrom, ReadsSidesAndDirections)
{
    EXPECT_EQ(viewFrom("front"), Vector<3>(0, -1, 0));
    EXPECT_EQ(viewFrom("top"), Vector<3>(0, 0, 1));
    EXPECT_NEAR((viewFrom("(0 -3 4)") - Vector<3>(0, -0.6, 0.8)).norm(), 0, 1e-15);
    EXPECT_NEAR(usualView().norm(), 1, 1e-15);
    for (const char* text : {"", "behind", "(0 0 0)", "(1 2)", "(1 2 3", "(1 2 3) 4", "1 2 3", "(nan 0 1)"})
    {
        EXPECT_THROW(viewFrom(text), FatalError) << text;
    }
}

} // namespace
} // namespace drystone
