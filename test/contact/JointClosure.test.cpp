// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// How many digits coordinates were written to, and joints that rounding has opened.
#include "contact/JointClosure.h"

#include "assembly/WrittenDigits.h"
#include "contact/ContactPoint.h"
#include "contact/Facing.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <numbers>

using namespace drystone;

namespace
{

/// Changes every coordinate.
template<class Change>
Assembly<2> changed(Assembly<2> assembly, const Change& change)
{
    for (Block<2>& block : assembly.blocks)
    {
        for (Vector<2>& corner : block.outline)
        {
            corner = {change(corner.x()), change(corner.y())};
        }
    }
    return assembly;
}

Assembly<2> turned(Assembly<2> assembly, double angle)
{
    for (Block<2>& block : assembly.blocks)
    {
        for (Vector<2>& corner : block.outline)
        {
            corner = {std::cos(angle) * corner.x() - std::sin(angle) * corner.y(),
                      std::sin(angle) * corner.x() + std::cos(angle) * corner.y()};
        }
    }
    return assembly;
}

double toDecimals(double value, int digits)
{
    return std::strtod(fmt::format("{:.{}f}", value, digits).c_str(), nullptr);
}

double toSignificant(double value, int digits)
{
    return std::strtod(fmt::format("{:.{}g}", value, digits).c_str(), nullptr);
}

Block<2> box(double left, double bottom, double right, double top, int support = -1)
{
    return {{{left, bottom}, {right, bottom}, {right, top}, {left, top}}, 1, support};
}

/// Two courses, the upper one shifted by a third: joints that end between corners.
Assembly<2> courses()
{
    Assembly<2> assembly;
    assembly.supports = {{"ground", "ground"}};
    assembly.blocks = {box(-1, -1, 13, 0, 0)};
    for (int i = 0; i < 12; ++i)
    {
        assembly.blocks.push_back(box(i, 0, i + 1, 0.5));
        assembly.blocks.push_back(box(i + 1.0 / 3, 0.5, i + 4.0 / 3, 1));
    }
    return assembly;
}

double widest(const Assembly<2>& assembly)
{
    FacingTolerance tolerance;
    tolerance.distance = 1e-3;
    tolerance.leastLength = 1e-2;
    double most = 0;
    for (const FacingPiece& piece : findFacingPieces(assembly, tolerance))
    {
        most = std::max({most, std::abs(piece.gapAtFrom), std::abs(piece.gapAtTo)});
    }
    return most;
}

TEST(WrittenDigits, AreCountedInDecimalsAndInSignificantDigits)
{
    const Assembly<2> oblique = turned(courses(), 0.3);
    EXPECT_EQ(writtenRounding(oblique), 0); // all digits of a double
    for (const int digits : {5, 6, 7, 8, 9})
    {
        const double unit = std::pow(10.0, -digits);
        EXPECT_NEAR(writtenRounding(changed(oblique, [&](double x) { return toDecimals(x, digits); })), unit,
                    1e-12 * unit);
        // Coordinates go up to 12 m.
        EXPECT_NEAR(writtenRounding(changed(oblique, [&](double x) { return toSignificant(x, digits); })),
                    100 * unit, 1e-10 * unit);
    }
}

TEST(WrittenDigits, SayNothingOfEdgesAlongTheAxes)
{
    EXPECT_EQ(writtenRounding(changed(courses(), [](double x) { return toDecimals(x, 3); })), 0);
    EXPECT_EQ(writtenRounding(Assembly<2>{}), 0);
}

TEST(JointClosure, LeavesJointsThatMeetAsTheyAre)
{
    for (const double angle : {0.0, 0.3})
    {
        const Assembly<2> before = turned(courses(), angle);
        Assembly<2> after = before;
        closeJoints(after);
        EXPECT_EQ(after.closure.joints, 0);
        for (std::size_t block = 0; block < before.blocks.size(); ++block)
        {
            EXPECT_EQ(after.blocks[block].outline, before.blocks[block].outline);
        }
    }
}

TEST(JointClosure, FindsTheJointsOfRoundedCoordinatesAndClosesThemToTheLastDigits)
{
    const auto points = findContactPoints(courses()).size();
    for (const int digits : {4, 5, 6, 8})
    {
        Assembly<2> rounded =
            changed(turned(courses(), 0.3), [&](double x) { return toDecimals(x, digits); });
        closeJoints(rounded);
        EXPECT_GT(rounded.closure.joints, 10);
        EXPECT_LT(rounded.closure.largest, 1.5 * std::pow(10.0, -digits));
        EXPECT_LT(widest(rounded), 1e-13);
        EXPECT_EQ(findContactPoints(rounded).size(), points) << digits;
    }
}

TEST(JointClosure, MovesNoCornerFartherThanRoundingHas)
{
    const Assembly<2> exact = turned(courses(), 0.3);
    Assembly<2> rounded = changed(exact, [](double x) { return toDecimals(x, 5); });
    closeJoints(rounded);
    for (std::size_t block = 0; block < exact.blocks.size(); ++block)
    {
        for (std::size_t i = 0; i < exact.blocks[block].outline.size(); ++i)
        {
            EXPECT_LT((rounded.blocks[block].outline[i] - exact.blocks[block].outline[i]).norm(), 1.5e-5);
        }
    }
}

TEST(JointClosure, ClosesJointsWhereThreeLinesMeetAtACorner)
{
    // Three blocks about a point that none of the coordinates can state.
    const Vector<2> middle(0.123456789, 0.0987654321);
    Assembly<2> assembly;
    assembly.supports = {{"blocks", "blocks"}};
    for (int i = 0; i < 3; ++i)
    {
        const auto at = [&](double angle) -> Vector<2>
        { return middle + Vector<2>(std::cos(angle), std::sin(angle)); };
        const double angle = 0.2 + 2 * std::numbers::pi / 3 * i;
        assembly.blocks.push_back(
            {{middle, at(angle), 1.5 * at(angle + 1) - 0.5 * middle, at(angle + 2 * std::numbers::pi / 3)},
             1,
             i - 1 < 0 ? 0 : -1});
        // Each block with a middle of its own.
        assembly.blocks.back().outline[0] += 3e-7 * Vector<2>(std::cos(5.0 * i), std::sin(7.0 * i));
    }
    closeJoints(assembly);
    EXPECT_EQ(assembly.closure.joints, 3);
    EXPECT_LT(widest(assembly), 1e-12);
}

TEST(JointClosure, LeavesGapsAlongTheAxesThatTheDigitsDoNotExplain)
{
    Assembly<2> assembly;
    assembly.supports = {{"ground", "ground"}};
    assembly.blocks = {box(-1, -1, 2, 0, 0), box(0, 0.001, 1, 1)};
    closeJoints(assembly);
    EXPECT_EQ(assembly.closure.joints, 0);
    EXPECT_EQ(assembly.blocks[1].outline[0].y(), 0.001);
}

TEST(JointClosure, ClosesMortarJointsWithAStatedTolerance)
{
    Assembly<2> assembly;
    assembly.supports = {{"ground", "ground"}};
    assembly.blocks = {box(-1, -1, 3, 0, 0), box(0, 0.01, 0.99, 0.5), box(1, 0.01, 2, 0.5),
                       box(0.5, 0.51, 1.5, 1)};
    closeJoints(assembly);
    EXPECT_TRUE(findContactPoints(assembly).empty());
    assembly.jointTolerance = 0.011;
    closeJoints(assembly);
    EXPECT_EQ(assembly.closure.joints, 5);
    EXPECT_NEAR(assembly.closure.largest, 0.01, 1e-12);
    EXPECT_EQ(findContactPoints(assembly).size(), 10U);
}

TEST(JointClosure, IsNotFollowedIntoDigitsTooFewForTheBlocks)
{
    const Assembly<2> rounded = changed(turned(courses(), 0.3), [](double x) { return toDecimals(x, 1); });
    EXPECT_LE(jointTolerance(rounded).oblique, 1e-3 * meanBlockSize(rounded));
}

} // namespace
