// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
// Capacity curves in space: closed forms of rocking boxes, and the plane's curve of the same structure
// extruded.
#include "statics/Pushover.h"

#include "SpaceStructures.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

namespace drystone
{
namespace
{

using test::onGround;
using test::pushed;

Pushover push(const Assembly<3>& assembly, double mu, const Vector<3>& direction,
              const PushoverSettings& settings)
{
    return solvePushover<3>({assembly, mu, pushed(assembly, direction)}, settings, {},
                            [](const CapacityPoint&, const std::vector<Placement<3>>&) {});
}

// The centroid is b - d from the edge, or the corner, and sqrt(b2 + h2 - (b - d)2) above it: the moment of
// the weight is a straight line to zero at d = b.
TEST(PushoverInSpace, OfABoxFollowsTheMomentOfItsWeight)
{
    for (const auto& [direction, b] :
         {std::pair(Vector<3>(1, 0, 0), 0.25), std::pair(Vector<3>(0, 1, 0), 0.15),
          std::pair(Vector<3>(-1, 0, 0), 0.25)})
    {
        const double h = 1;
        const Assembly<3> assembly = onGround({makeBox({-0.25, -0.15, 0}, {0.25, 0.15, 2 * h})});
        const Pushover pushover = push(assembly, 0.65, direction, {.step = 0.01});
        EXPECT_EQ(pushover.end, PushoverEnd::overturned);
        ASSERT_GT(pushover.curve.size(), 15U);
        for (const CapacityPoint& point : pushover.curve)
        {
            const double x = b - point.displacement;
            EXPECT_NEAR(point.alpha * std::sqrt(b * b + h * h - x * x), x, 2e-4 * b) << point.displacement;
            EXPECT_LE(point.worst, 1e-9);
        }
        EXPECT_NEAR(pushover.curve.back().displacement, b, 2e-4 * b);
        EXPECT_EQ(pushover.curve.back().alpha, 0);
    }
}

// Askew it turns about the edge that is overcome first: d is the displacement along the push, d/cos q that
// towards the edge, and so is the part of the load that counts. (Across the diagonal of a square it is open
// which of two.)
TEST(PushoverInSpace, OfABoxPushedAskewTurnsAboutAnEdge)
{
    const double b = 0.25;
    const double h = 1;
    const Assembly<3> assembly = onGround({makeBox({-b, -b, 0}, {b, b, 2 * h})});
    for (const double angle : {0.3, -0.6})
    {
        const double c = std::cos(angle);
        const Pushover pushover = push(assembly, 0.65, {c, std::sin(angle), 0}, {.step = 0.01});
        EXPECT_EQ(pushover.end, PushoverEnd::overturned);
        ASSERT_GT(pushover.curve.size(), 15U);
        for (const CapacityPoint& point : pushover.curve)
        {
            const double x = b - point.displacement / c;
            EXPECT_NEAR(point.alpha * c * std::sqrt(b * b + h * h - x * x), x, 5e-4 * b)
                << point.displacement;
        }
        EXPECT_NEAR(pushover.curve.back().displacement, b * c, 5e-4 * b);
    }
}

TEST(PushoverInSpace, OfBoxesThatNoLiveLoadMovesIsWithoutLimit)
{
    const Assembly<3> assembly =
        onGround({makeBox({0, 0, 0}, {0.3, 0.4, 0.5}), makeBox({0, 0, 0.5}, {0.3, 0.4, 1})});
    const Pushover pushover = push(assembly, 0.7, {0.1, 0.2, -1}, {.step = 0.01});
    EXPECT_EQ(pushover.end, PushoverEnd::unbounded);
    EXPECT_TRUE(pushover.curve.empty());
}

TEST(PushoverInSpace, OfABoxThatSlidesNeverEnds)
{
    const Pushover pushover = push(onGround({makeBox({0, 0, 0}, {0.5, 0.5, 0.5})}), 0.1, {1, 0, 0},
                                   {.step = 0.01, .maximumSteps = 20});
    EXPECT_EQ(pushover.end, PushoverEnd::stepsUsedUp);
    EXPECT_NEAR(pushover.curve.front().alpha, 0.1, 1e-8);
    EXPECT_NEAR(pushover.curve.back().alpha, 0.1, 1e-6);
}

// The box turns towards a sharp edge, whose faces look 63 degrees past it: nothing would stop it there. Where
// it meets a face instead it stops, and turns on about that.
TEST(PushoverInSpace, EndsWhereBlocksMeetWithoutAContact)
{
    const Polyhedron box = makeBox({-0.25, -0.25, 0}, {0.25, 0.25, 2});
    const auto prism = [](const std::vector<Vector<2>>& outline)
    {
        std::vector<Vector<3>> bottom;
        std::vector<Vector<3>> top;
        for (const Vector<2>& corner : outline)
        {
            bottom.emplace_back(corner.x(), corner.y(), 0);
            top.emplace_back(corner.x(), corner.y(), 1.8);
        }
        return makePrism(bottom, top);
    };
    // The box would be there when its top has moved by about 0.2 m, and overturns by itself at 0.5 m.
    for (const bool isSharp : {true, false})
    {
        Assembly<3> assembly =
            onGround({box, isSharp ? prism({{0.4, 0}, {1, -0.3}, {1, 0.3}})
                                   : prism({{0.4, -0.35}, {0.6, -0.35}, {0.6, 0.35}, {0.4, 0.35}})});
        assembly.blocks[1].support = 0;
        const Pushover pushover = push(assembly, 0.65, {1, 0, 0}, {.step = 0.01, .maximumSteps = 60});
        ASSERT_GT(pushover.curve.size(), 10U);
        EXPECT_LT(pushover.curve.back().displacement, 0.15);
        if (isSharp)
        {
            EXPECT_EQ(pushover.end, PushoverEnd::meeting);
            EXPECT_EQ(pushover.overlap.block, 0);
            EXPECT_EQ(pushover.overlap.neighbour, 1);
            EXPECT_GT(pushover.overlap.depth, 0.02);
            EXPECT_GT(pushover.curve.back().displacement, 0.08);
        }
        else
        {
            EXPECT_NE(pushover.end, PushoverEnd::overturned);
            EXPECT_NE(pushover.end, PushoverEnd::meeting);
        }
    }
}

/// Left, bottom, right, top.
using Rectangle = std::array<double, 4>;

/// The curve of rectangles of the plane, pushed to the right, and that of them with depths. \param inset of
/// the last block, on both sides of a depth of 0.7
std::pair<Pushover, Pushover> curvesOf(const std::vector<Rectangle>& blocks, double mu,
                                       const PushoverSettings& settings, double inset = 0)
{
    Assembly<2> plane;
    std::vector<Polyhedron> shapes;
    for (const auto& [left, bottom, right, top] : blocks)
    {
        plane.blocks.push_back({{{left, bottom}, {right, bottom}, {right, top}, {left, top}}, 1, -1});
        const double from = plane.blocks.size() == blocks.size() ? inset : 0;
        shapes.push_back(makeBox({left, from, bottom}, {right, 0.7 - from, top}));
    }
    plane.blocks.push_back({{{-9, -1}, {9, -1}, {9, 0}, {-9, 0}}, 1, 0});
    plane.supports = {{"ground", "ground"}};
    std::vector<double> masses;
    for (const BlockMass<2>& block : blockMasses(plane))
    {
        masses.push_back(block.volume);
    }
    masses[blocks.size() - 1] *= (0.7 - 2 * inset) / 0.7;
    const LoadVectors loads{gravityLoad(plane, masses, {0, -1}),
                            inertialLoad(plane, masses, {0, -1}, {1, 0})};
    return {solvePushover<2>({plane, mu, loads}, settings, {},
                             [](const CapacityPoint&, const std::vector<Placement<2>>&) {}),
            push(onGround(shapes), mu, {1, 0, 0}, settings)};
}

/// The multiplier of a curve at a displacement, straight between its points.
double multiplierAt(const Pushover& pushover, double displacement)
{
    const auto after = std::find_if(pushover.curve.begin() + 1, pushover.curve.end() - 1,
                                    [displacement](const CapacityPoint& point)
                                    { return point.displacement >= displacement; });
    const auto before = after - 1;
    const double share = (displacement - before->displacement) / (after->displacement - before->displacement);
    return before->alpha + share * (after->alpha - before->alpha);
}

// Two columns under a lintel, and a tower of three blocks: one mechanism each.
TEST(PushoverInSpace, OfAnExtrudedStructureIsThatOfThePlane)
{
    for (const std::vector<Rectangle>& blocks :
         {std::vector<Rectangle>{{0, 0, 0.4, 1.5}, {2, 0, 2.4, 1.5}, {-0.2, 1.5, 2.6, 1.9}},
          std::vector<Rectangle>{{0, 0, 0.9, 0.5}, {0.1, 0.5, 0.8, 1.2}, {0.2, 1.2, 0.6, 2}}})
    {
        const auto [expected, found] = curvesOf(blocks, 0.7, {.step = 0.01});
        EXPECT_EQ(found.end, expected.end);
        ASSERT_GT(expected.curve.size(), 20U);
        EXPECT_NEAR(found.curve.back().displacement, expected.curve.back().displacement, 1e-4);
        // Corners are farther from the mass centres in space, so that its steps are others.
        for (const CapacityPoint& point : expected.curve)
        {
            EXPECT_NEAR(multiplierAt(found, point.displacement), point.alpha, 1e-4) << point.displacement;
        }
    }
}

// A lintel lies on a column that leans, on the far edge of its top: what this may shear by is measured from
// the face of the lintel, and not from a plane between the faces, 0.2 rad off at the end, which let the
// lintel hold the column up for another 0.05 m.
TEST(PushoverInSpace, OfAColumnThatSlipsFromUnderItsLintelIsThatOfThePlane)
{
    for (const double inset : {0.0, 0.1, -0.1}) // its corners, or edges that cross
    {
        const auto [expected, found] =
            curvesOf({{0, 0, 0.26, 1.07}, {1.9, 0, 2.39, 1.07}, {-0.05, 1.07, 2.49, 1.37}}, 0.4,
                     {.step = 0.002}, inset);
        EXPECT_EQ(found.end, expected.end);
        const double end = expected.curve.back().displacement;
        EXPECT_GT(end, 0.2);
        EXPECT_NEAR(found.curve.back().displacement, end, 0.002) << inset;
        for (double displacement = 0.01; displacement < 0.95 * end; displacement += 0.01)
        {
            EXPECT_NEAR(multiplierAt(found, displacement), multiplierAt(expected, displacement), 5e-4)
                << inset << ' ' << displacement;
        }
    }
}

} // namespace
} // namespace drystone
