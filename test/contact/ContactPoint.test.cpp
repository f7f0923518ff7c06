// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Joints between blocks of every shape.
#include "../Polygons.h"

#include "contact/ContactPoint.h"
#include "contact/Equilibrium.h"
#include "texture/Courses.h"
#include "texture/Supports.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <tuple>

using namespace drystone;

namespace
{

using test::rectangle;

TEST(ContactPoint, ABlockOnTheGroundTouchesAtItsTwoCornersWithTheNormalIntoIt)
{
    Assembly<2> assembly{{{rectangle(0, 0, 1, 1)}, {rectangle(-5, -1, 5, 0), 1, 0}}, {{"ground", "ground"}}};
    const auto points = findContactPoints(assembly);
    ASSERT_EQ(points.size(), 2U);
    EXPECT_EQ(points[0].block, 0);
    EXPECT_EQ(points[0].neighbour, 1);
    EXPECT_EQ(points[0].normal, Vector<2>(0, 1));
    EXPECT_EQ(points[0].position, Vector<2>(0, 0));
    EXPECT_EQ(points[1].position, Vector<2>(1, 0));
    EXPECT_EQ(points[0].joint, points[1].joint);
}

TEST(ContactPoint, BlocksThatMeetAtACornerAloneHaveNoJoint)
{
    Assembly<2> assembly{{{rectangle(0, 0, 1, 1)}, {rectangle(1, 1, 2, 2)}}, {}};
    EXPECT_TRUE(findContactPoints(assembly).empty());
}

TEST(ContactPoint, VerticesThatSplitAnEdgeDoNotDoubleThePoints)
{
    Assembly<2> assembly{{{{{0, 0}, {0.25, 0}, {0.5, 0}, {1, 0}, {1, 1}, {0, 1}}},
                          {{{-1, -1}, {2, -1}, {2, 0}, {0.7, 0}, {0.1, 0}, {-1, 0}}}},
                         {}};
    EXPECT_EQ(findContactPoints(assembly).size(), 2U);
}

TEST(ContactPoint, ABlockThatSitsInAConcaveOneHasAJointForEachFace)
{
    Assembly<2> assembly{
        {{{{0, 0}, {3, 0}, {3, 2}, {2, 2}, {2, 1}, {1, 1}, {1, 2}, {0, 2}}}, {rectangle(1, 1, 2, 2)}}, {}};
    EXPECT_EQ(findContactPoints(assembly).size(), 6U);
}

TEST(ContactPoint, ForcesOnTheTwoBlocksCancelAndMakeNoMomentTogether)
{
    Assembly<2> assembly{{{rectangle(0, 0, 1, 1)}, {rectangle(0.3, 1, 2, 1.5)}}, {}};
    const auto points = findContactPoints(assembly);
    const auto masses = blockMasses(assembly);
    const auto columns = equilibriumColumns(assembly, masses, points);
    ASSERT_EQ(columns.size(), 2U);
    for (std::size_t k = 0; k < columns.size(); ++k)
    {
        for (int j = 0; j < 2; ++j)
        {
            const auto onBlock = columns[k].onBlock.col(j);
            const auto onNeighbour = columns[k].onNeighbour.col(j);
            EXPECT_EQ(onBlock.head<2>(), -onNeighbour.head<2>());
            const double moment = onBlock(2) + cross(masses[0].centroid, onBlock.head<2>()) + onNeighbour(2)
                                  + cross(masses[1].centroid, onNeighbour.head<2>());
            EXPECT_NEAR(moment, 0, 1e-15);
        }
        // Lifting the block by d along the normal opens the gap by d: gap = g0 - A0' dx.
        EXPECT_NEAR(-columns[k].onBlock.col(0).head<2>().dot(points[k].normal), 1, 1e-15);
    }
}

/// A wall of random courses, cut at random: non-conforming joints everywhere.
Assembly<2> randomWall(std::mt19937& random)
{
    std::uniform_real_distribution<double> uniform(0.3, 1);
    std::uniform_int_distribution<int> count(1, 12);
    Courses courses;
    for (int row = count(random); row > 0; --row)
    {
        std::vector<double> lengths;
        double sum = 0;
        for (int block = count(random); block > 0; --block)
        {
            lengths.push_back(uniform(random));
            sum += lengths.back();
        }
        for (double& length : lengths)
        {
            length *= 6 / sum;
        }
        courses.rows.push_back(lengths);
    }
    Assembly<2> wall = makeAssembly(courses);
    addGround(wall, "ground", {0.3});
    return wall;
}

/// Every vertex sent through a map of the plane. Outlines stay counter-clockwise when the map mirrors.
template<class Map>
Assembly<2> mapped(Assembly<2> assembly, const Map& map)
{
    for (Block<2>& block : assembly.blocks)
    {
        for (Vector<2>& vertex : block.outline)
        {
            vertex = map(vertex);
        }
        if (areaProperties(block.outline).area < 0)
        {
            std::reverse(block.outline.begin(), block.outline.end());
        }
    }
    return assembly;
}

/// Points by block, neighbour and place, for comparison as sets.
std::vector<std::array<double, 6>> sortedPoints(const std::vector<ContactPoint<2>>& points)
{
    std::vector<std::array<double, 6>> all;
    for (const ContactPoint<2>& point : points)
    {
        const auto rounded = [](double value) { return std::round(value * 1e9) / 1e9 + 0.0; };
        all.push_back({double(point.block), double(point.neighbour), rounded(point.position.x()),
                       rounded(point.position.y()), rounded(point.normal.x()), rounded(point.normal.y())});
    }
    std::sort(all.begin(), all.end());
    return all;
}

TEST(ContactPoint, AMirroredRandomWallHasTheMirroredPoints)
{
    std::mt19937 random(11);
    for (int i = 0; i < 50; ++i)
    {
        const Assembly<2> wall = randomWall(random);
        std::vector<ContactPoint<2>> points = findContactPoints(wall);
        const auto mirror = [](const Vector<2>& v) { return Vector<2>(-v.x(), v.y()); };
        for (ContactPoint<2>& point : points)
        {
            point.position = mirror(point.position);
            point.normal = mirror(point.normal);
        }
        EXPECT_EQ(sortedPoints(findContactPoints(mapped(wall, mirror))), sortedPoints(points));
    }
}

TEST(ContactPoint, ATurnedAndMovedRandomWallHasTheTurnedPoints)
{
    std::mt19937 random(12);
    for (int i = 0; i < 50; ++i)
    {
        const Assembly<2> wall = randomWall(random);
        const double angle = 0.1 + i;
        Eigen::Matrix2d rotation;
        rotation << std::cos(angle), -std::sin(angle), std::sin(angle), std::cos(angle);
        const auto motion = [&](const Vector<2>& v) -> Vector<2>
        { return rotation * v + Vector<2>(100, -30); };
        const std::vector<ContactPoint<2>> points = findContactPoints(wall);
        const std::vector<ContactPoint<2>> turned = findContactPoints(mapped(wall, motion));
        ASSERT_EQ(turned.size(), points.size());
        const auto key = [](const ContactPoint<2>& p)
        {
            return std::tuple(p.block, p.neighbour, std::round(p.position.x() * 1e6),
                              std::round(p.position.y() * 1e6));
        };
        std::vector<ContactPoint<2>> back = turned;
        for (ContactPoint<2>& point : back)
        {
            point.position = rotation.transpose() * (point.position - Vector<2>(100, -30));
            point.normal = rotation.transpose() * point.normal;
        }
        std::vector<ContactPoint<2>> expected = points;
        const auto before = [&](const auto& a, const auto& b) { return key(a) < key(b); };
        std::sort(back.begin(), back.end(), before);
        std::sort(expected.begin(), expected.end(), before);
        for (std::size_t k = 0; k < back.size(); ++k)
        {
            EXPECT_LT((back[k].position - expected[k].position).norm(), 1e-12);
            EXPECT_LT((back[k].normal - expected[k].normal).norm(), 1e-12);
        }
    }
}

TEST(ContactPoint, BedJointsOfRandomCoursesCoverEveryCourseOnce)
{
    std::mt19937 random(13);
    for (int i = 0; i < 50; ++i)
    {
        const Assembly<2> wall = randomWall(random);
        double top = 0;
        for (const Block<2>& block : wall.blocks)
        {
            top = std::max(top, block.outline[2].y());
        }
        const std::vector<ContactPoint<2>> points = findContactPoints(wall);
        double beds = 0;
        for (std::size_t k = 0; k < points.size(); k += 2)
        {
            EXPECT_EQ(points[k].joint, points[k + 1].joint);
            beds += std::abs(points[k].normal.y()) > 0.5
                        ? (points[k].position - points[k + 1].position).norm()
                        : 0;
        }
        EXPECT_NEAR(beds, std::round(top / 0.175) * 6 * 0.4, 1e-9);
    }
}

TEST(ContactPoint, OneLongEdgeMeetsManyBlocksOfVeryDifferentSize)
{
    Assembly<2> assembly;
    assembly.blocks.push_back({rectangle(0, 1, 64, 2)});
    double from = 0;
    for (int i = 0; i < 12; ++i)
    {
        const double to = from + std::pow(2, -i);
        assembly.blocks.push_back({rectangle(from, 1 - std::pow(2, -i), to, 1)});
        from = to;
    }
    // Each with the long one, and each with the next.
    EXPECT_EQ(findContactPoints(assembly).size(), 2U * (12 + 11));
}

TEST(ContactPoint, EdgesFartherApartThanTheToleranceDoNotTouch)
{
    for (const auto& [gap, points] : {std::pair(1e-8, 2U), std::pair(-1e-8, 2U), std::pair(1e-5, 0U)})
    {
        Assembly<2> assembly{{{rectangle(0, 0, 1, 1)}, {rectangle(0, 1 + gap, 1, 2)}}, {}};
        const auto found = findContactPoints(assembly);
        ASSERT_EQ(found.size(), points) << gap;
        for (const ContactPoint<2>& point : found)
        {
            EXPECT_EQ(point.gap, 0);
        }
    }
}

TEST(ContactPoint, FixedBlocksDoNotTouchEachOther)
{
    Assembly<2> assembly{
        {{rectangle(0, 0, 1, 1), 1, 0}, {rectangle(0, 1, 1, 2), 1, 1}, {rectangle(0, 2, 1, 3)}},
        {{"a", "blocks"}, {"b", "blocks"}}};
    EXPECT_EQ(findContactPoints(assembly).size(), 2U);
}

TEST(ContactPoint, AnAssemblyWithoutBlocksHasNoPoints)
{
    EXPECT_TRUE(findContactPoints(Assembly<2>{}).empty());
}

} // namespace
