// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Solids cut into convex ones: prisms with notches, a ring, random stars; their volumes add up and they
/// share none.
#include "geometry/space/ConvexParts.h"

#include "geometry/Rotation.h"
#include "geometry/space/PolyhedronOverlap.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

namespace drystone
{
namespace
{

constexpr double tolerance = 1e-7;
constexpr std::size_t most = 100;

/// Corners against the clock seen from above.
Polyhedron prismOn(const std::vector<Vector<2>>& outline, double height)
{
    std::vector<Vector<3>> bottom, top;
    for (const Vector<2>& corner : outline)
    {
        bottom.emplace_back(corner.x(), corner.y(), 0);
        top.emplace_back(corner.x(), corner.y(), height);
    }
    return makePrism(bottom, top);
}

Polyhedron turnedBy(Polyhedron shape, const Vector<3>& turn, const Vector<3>& way)
{
    for (Vector<3>& vertex : shape.vertices)
    {
        vertex = turned(turn, vertex) + way;
    }
    return shape;
}

/// \return how many they are
std::size_t expectPartsOf(const Polyhedron& shape)
{
    const std::vector<Polyhedron> parts = convexParts(shape, tolerance, most);
    double volume = 0;
    for (std::size_t i = 0; i < parts.size(); ++i)
    {
        EXPECT_TRUE(isConvex(parts[i], 1e-9));
        EXPECT_GT(volumeProperties(parts[i]).volume, 0);
        volume += volumeProperties(parts[i]).volume;
        for (std::size_t j = 0; j < i; ++j)
        {
            EXPECT_LE(overlapVolume(parts[i], parts[j]), 1e-9);
        }
        EXPECT_NEAR(overlapVolume(parts[i], shape), volumeProperties(parts[i]).volume, 1e-9);
    }
    EXPECT_NEAR(volume, volumeProperties(shape).volume, 1e-9);
    return parts.size();
}

const Vector<3> oblique(0.3, -0.7, 1.1);
const Vector<3> farAway(40, -20, 10);

TEST(ConvexParts, OfAConvexSolidThereIsOne)
{
    EXPECT_EQ(expectPartsOf(makeBox({0, 0, 0}, {1, 2, 3})), 1u);
    EXPECT_EQ(expectPartsOf(turnedBy(makeBox({0, 0, 0}, {1, 2, 3}), oblique, farAway)), 1u);
}

TEST(ConvexParts, AnAngleHasTwoATeeAndAChannelThree)
{
    const Polyhedron angle = prismOn({{0, 0}, {1, 0}, {1, 0.3}, {0.3, 0.3}, {0.3, 1}, {0, 1}}, 0.4);
    const Polyhedron tee =
        prismOn({{0, 0}, {0.3, 0}, {0.3, 1}, {0.6, 1}, {0.6, 1.2}, {-0.3, 1.2}, {-0.3, 1}, {0, 1}}, 0.4);
    const Polyhedron channel =
        prismOn({{0, 0}, {1, 0}, {1, 0.8}, {0.7, 0.8}, {0.7, 0.3}, {0.3, 0.3}, {0.3, 0.8}, {0, 0.8}}, 0.4);
    for (const Vector<3>& turn : {Vector<3>(0, 0, 0), oblique})
    {
        EXPECT_EQ(expectPartsOf(turnedBy(angle, turn, farAway)), 2u);
        EXPECT_EQ(expectPartsOf(turnedBy(tee, turn, farAway)), 2u); // flange and web
        EXPECT_EQ(expectPartsOf(turnedBy(channel, turn, farAway)), 3u);
    }
}

// A stone at the groin of a vault.
TEST(ConvexParts, AChevronHasTwo)
{
    EXPECT_EQ(expectPartsOf(turnedBy(prismOn({{0, 0}, {1, 1}, {2, 0}, {2, 0.5}, {1, 1.5}, {0, 0.5}}, 0.3),
                                     oblique, farAway)),
              2u);
}

TEST(ConvexParts, ARingOfPrismsIsAsManyAsItHasSides)
{
    constexpr int sides = 6;
    Polyhedron ring;
    for (int i = 0; i < sides; ++i)
    {
        const double angle = 2 * std::numbers::pi * i / sides;
        for (const double radius : {1.0, 0.6})
        {
            for (const double z : {0.0, 0.3})
            {
                ring.vertices.emplace_back(radius * std::cos(angle), radius * std::sin(angle), z);
            }
        }
    }
    for (int i = 0; i < sides; ++i)
    {
        const int a = 4 * i;
        const int b = 4 * ((i + 1) % sides);
        ring.faces.push_back({a, b, b + 1, a + 1});         // outside
        ring.faces.push_back({b + 2, a + 2, a + 3, b + 3}); // inside
        ring.faces.push_back({a + 1, b + 1, b + 3, a + 3}); // top
        ring.faces.push_back({b, a, a + 2, b + 2});         // bottom
    }
    ASSERT_NEAR(volumeProperties(ring).volume, 0.3 * 3 * std::sqrt(3) / 2 * (1 - 0.36), 1e-12);
    EXPECT_LE(expectPartsOf(ring), 2u * sides);
}

TEST(ConvexParts, RandomStarsAddUp)
{
    std::mt19937 random(1);
    std::uniform_real_distribution<double> radius(0.3, 1);
    for (int star = 0; star < 50; ++star)
    {
        std::vector<Vector<2>> outline;
        const int corners = 5 + star % 7;
        for (int i = 0; i < corners; ++i)
        {
            const double angle = 2 * std::numbers::pi * i / corners;
            outline.push_back(radius(random) * Vector<2>(std::cos(angle), std::sin(angle)));
        }
        EXPECT_GT(expectPartsOf(turnedBy(prismOn(outline, 0.5), oblique, Vector<3>(0, 0, 0))), 0u) << star;
    }
}

TEST(ConvexParts, ThereAreNoneWhereTheyWouldBeTooMany)
{
    std::vector<Vector<2>> gear;
    for (int i = 0; i < 200; ++i)
    {
        const double angle = 2 * std::numbers::pi * i / 200;
        gear.push_back((i % 2 ? 1.0 : 0.8) * Vector<2>(std::cos(angle), std::sin(angle)));
    }
    EXPECT_TRUE(convexParts(prismOn(gear, 1), tolerance, 20).empty());
}

// Six decimals leave corners 5e-7 m off their planes.
TEST(ConvexParts, ARoundedBoxIsConvexToItsUnevenness)
{
    Polyhedron box = turnedBy(makeBox({0, 0, 0}, {0.5, 0.3, 0.2}), oblique, Vector<3>(0, 0, 0));
    for (Vector<3>& vertex : box.vertices)
    {
        vertex = (1e6 * vertex).array().round() / 1e6;
    }
    EXPECT_GT(unevenness(box), 1e-8);
    EXPECT_FALSE(isConvex(box));
    EXPECT_TRUE(isConvex(box, 3 * unevenness(box)));
    EXPECT_EQ(convexParts(box, 3 * unevenness(box), most).size(), 1u);
}

} // namespace
} // namespace drystone
