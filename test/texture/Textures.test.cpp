// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Courses, polygons and arches.
#include "contact/ContactPoint.h"
#include "geometry/PolygonShape.h"
#include "texture/Arch.h"
#include "texture/Courses.h"
#include "texture/Polygons.h"
#include "texture/RunningBond.h"
#include "texture/plane/PlaneRubble.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

using namespace drystone;

namespace
{

TEST(Courses, ANegativeLengthIsAVoid)
{
    Courses courses;
    courses.unit = {2, 0.5};
    courses.rows = {{0.5, 1, 1, 0.5}, {1, -1, 1}};
    const Assembly<2> assembly = makeAssembly(courses);
    ASSERT_EQ(assembly.blocks.size(), 6U);
    EXPECT_EQ(assembly.blocks[5].outline[0], Vector<2>(4, 0.5));
    EXPECT_EQ(assembly.blocks[5].outline[2], Vector<2>(6, 1));
    // Bottom: 3 heads; each upper block on two lower ones.
    EXPECT_EQ(findContactPoints(assembly).size(), 2U * (3 + 4));
}

TEST(Courses, RepeatARunningBond)
{
    Courses courses;
    courses.unit = {0.4, 0.175};
    courses.rows = {{0.5, 1, 1, 0.5}, {1, 1, 1}};
    RunningBond bond;
    bond.length = 3;
    bond.courses = 2;
    const Assembly<2> a = makeAssembly(courses);
    const Assembly<2> b = makeAssembly(bond);
    ASSERT_EQ(a.blocks.size(), b.blocks.size());
    for (std::size_t i = 0; i < a.blocks.size(); ++i)
    {
        EXPECT_EQ(a.blocks[i].outline, b.blocks[i].outline);
    }
}

TEST(Polygons, EitherOrientationEndsUpCounterClockwiseWithTheSameFirstCorner)
{
    const Dictionary dictionary =
        Dictionary::readString("blocks ( ((0 0) (0 1) (1 0)) ((0 0) (1 0) (0 1)) );");
    const Assembly<2> assembly = makeAssembly(readOptions<Polygons>(dictionary));
    EXPECT_EQ(assembly.blocks[0].outline, assembly.blocks[1].outline);
}

TEST(Arch, VoussoirsAreTrapezoidsBetweenTheTwoCircles)
{
    Arch arch;
    arch.thickness = 0.106721;
    const Assembly<2> assembly = makeAssembly(arch);
    ASSERT_EQ(assembly.blocks.size(), 29U);
    double area = 0;
    for (int i = 0; i < 27; ++i)
    {
        const Polygon& outline = assembly.blocks[i].outline;
        EXPECT_NEAR(outline[0].norm(), 1 - arch.thickness / 2, 1e-15);
        EXPECT_NEAR(outline[2].norm(), 1 + arch.thickness / 2, 1e-15);
        area += areaProperties(outline).area;
    }
    // n trapezoids of the angle pi/n between radii r and R: (R^2 - r^2) sin(pi/n) n/2 = R t n sin(pi/n).
    EXPECT_NEAR(area, arch.thickness * 27 * std::sin(std::numbers::pi / 27), 1e-14);
    EXPECT_EQ(assembly.supports[0].name, "left");
    EXPECT_EQ(assembly.supports[1].name, "right");
    EXPECT_EQ(findContactPoints(assembly).size(), 2U * 28);
}

TEST(Arch, AbutmentsOfASemicircleLieUnderTheGroundLine)
{
    const Assembly<2> assembly = makeAssembly(Arch{});
    for (int i : {27, 28})
    {
        for (const Vector<2>& vertex : assembly.blocks[i].outline)
        {
            EXPECT_LE(vertex.y(), 0);
        }
        EXPECT_GT(areaProperties(assembly.blocks[i].outline).area, 0);
    }
    EXPECT_LT(assembly.blocks[27].outline[0].x(), 0); // left first
}

TEST(Arch, EveryAngleHasAJointAtEachSpringingAndIsItsOwnMirrorImage)
{
    for (const double angle : {30.0, 90.0, 120.0, 180.0, 200.0, 270.0})
    {
        for (const int voussoirs : {1, 2, 3, 27, 28})
        {
            if (angle / voussoirs >= 180)
            {
                continue;
            }
            Arch arch;
            arch.angle = angle;
            arch.voussoirs = voussoirs;
            const Assembly<2> assembly = makeAssembly(arch);
            EXPECT_EQ(findContactPoints(assembly).size(), 2U * (voussoirs + 1)) << angle << ' ' << voussoirs;
            for (int i = 0; i < voussoirs; ++i)
            {
                const Polygon& one = assembly.blocks[i].outline;
                const Polygon& other = assembly.blocks[voussoirs - 1 - i].outline;
                for (const auto& [a, b] : {std::pair(0, 1), std::pair(3, 2)})
                {
                    EXPECT_EQ(one[a].x(), -other[b].x());
                    EXPECT_EQ(one[a].y(), other[b].y());
                }
                EXPECT_GT(areaProperties(one).area, 0);
            }
        }
    }
}

TEST(Arch, AbutmentsOfAHorseshoeDoNotMeet)
{
    for (const double angle : {181.0, 200.0, 220.0, 240.0, 270.0})
    {
        for (const double thickness : {0.1, 0.5, 1.0, 1.5, 1.9})
        {
            Arch arch;
            arch.angle = angle;
            arch.thickness = thickness;
            arch.voussoirs = 15;
            const Assembly<2> assembly = makeAssembly(arch);
            EXPECT_EQ(findContactPoints(assembly).size(), 32U) << angle << ' ' << thickness;
            for (const Vector<2>& corner : assembly.blocks.back().outline)
            {
                EXPECT_GT(corner.x(), 0) << angle << ' ' << thickness;
            }
            EXPECT_GT(areaProperties(assembly.blocks.back().outline).area, 0);
        }
    }
}

TEST(Arch, APointedArchHasItsCrownJointOnTheAxisAndSpringsLevel)
{
    Arch arch;
    arch.profile = ArchProfile::pointed;
    arch.thickness = 0.12;
    arch.offset = 0.3;
    arch.voussoirs = 16;
    const Assembly<2> assembly = makeAssembly(arch);
    EXPECT_EQ(findContactPoints(assembly).size(), 2U * 17);
    const Polygon& last = assembly.blocks[15].outline;
    EXPECT_NEAR(last[1].x(), 1 - 0.06 - 0.3, 1e-15);
    EXPECT_EQ(last[1].y(), 0);
    const Polygon& crown = assembly.blocks[8].outline;
    EXPECT_EQ(crown[0].x(), 0);
    EXPECT_NEAR(crown[3].y(), std::sqrt(1.06 * 1.06 - 0.09), 1e-15);
    // Joints between are radial to the centre of their arc, at equal angles up to where the centreline meets
    // the axis.
    const double angle = std::acos(0.3) / 8;
    EXPECT_NEAR(assembly.blocks[15].outline[0].y(), 0.94 * std::sin(angle), 1e-15);
    for (int i = 0; i < 16; ++i)
    {
        EXPECT_EQ(assembly.blocks[i].outline[0].x(), -assembly.blocks[15 - i].outline[1].x());
    }
}

TEST(Arch, AnEllipticArchHasJointsPerpendicularToItsCentrelineAndACircleAmongThem)
{
    Arch arch;
    arch.profile = ArchProfile::elliptic;
    arch.radius = 2;
    arch.rise = 1;
    arch.voussoirs = 15;
    const Assembly<2> assembly = makeAssembly(arch);
    EXPECT_EQ(findContactPoints(assembly).size(), 2U * 16);
    for (int i = 0; i < 15; ++i)
    {
        const Polygon& outline = assembly.blocks[i].outline;
        const Vector<2> middle = (outline[0] + outline[3]) / 2;
        const Vector<2> normal(middle.x() / 4, middle.y());
        EXPECT_NEAR(std::pow(middle.x() / 2, 2) + std::pow(middle.y(), 2), 1, 1e-14);
        EXPECT_NEAR(cross(normal.normalized(), outline[3] - outline[0]), 0, 1e-15);
        EXPECT_NEAR((outline[3] - outline[0]).norm(), arch.thickness, 1e-15);
    }
    arch.rise = 2;
    Arch circle = arch;
    circle.profile = ArchProfile::circular;
    const Assembly<2> round = makeAssembly(circle);
    const Assembly<2> ellipse = makeAssembly(arch);
    for (int i = 0; i < 15; ++i)
    {
        for (int corner = 0; corner < 4; ++corner)
        {
            EXPECT_NEAR((round.blocks[i].outline[corner] - ellipse.blocks[i].outline[corner]).norm(), 0,
                        1e-14);
        }
    }
}

TEST(RunningBond, ALintelReachesPastBothJambs)
{
    RunningBond bond;
    bond.courses = 6;
    bond.openings = {{{1.5, 1}, {2.5, 3}, 0.25}};
    const Assembly<2> wall = makeAssembly(bond);
    const auto lintel = std::find_if(wall.blocks.begin(), wall.blocks.end(),
                                     [](const Block<2>& block)
                                     { return std::abs(block.outline[0].x() - 1.25 * 0.4) < 1e-12; });
    ASSERT_NE(lintel, wall.blocks.end());
    EXPECT_DOUBLE_EQ(lintel->outline[1].x(), 2.75 * 0.4);
    EXPECT_DOUBLE_EQ(lintel->outline[0].y(), 3 * 0.175);
    double area = 0;
    for (const Block<2>& block : wall.blocks)
    {
        area += areaProperties(block.outline).area;
    }
    EXPECT_NEAR(area, (5 * 6 - 2) * 0.4 * 0.175, 1e-13);
}

TEST(PlaneRubble, FillsTheWallWithSimpleOutlinesAndNoShortJoints)
{
    for (const int seed : {1, 2, 3, 4, 5})
    {
        PlaneRubble rubble;
        rubble.stones = 150;
        rubble.seed = seed;
        const Assembly<2> wall = makeAssembly(rubble);
        const double mean = std::sqrt(6.0 / 150);
        double area = 0;
        for (const Block<2>& block : wall.blocks)
        {
            EXPECT_EQ(outlineFault(block.outline), "") << "seed " << seed;
            area += areaProperties(block.outline).area;
        }
        EXPECT_NEAR(area, 6, 1e-12) << "seed " << seed;
        const auto points = findContactPoints(wall);
        EXPECT_GT(points.size(), 2U * 300) << "seed " << seed; // Euler: nearly three joints a stone
        for (std::size_t i = 0; i + 1 < points.size(); i += 2)
        {
            // Corners are moved by half of what they merge over.
            EXPECT_GT((points[i + 1].position - points[i].position).norm(), 0.05 * mean) << "seed " << seed;
        }
        EXPECT_EQ(makeAssembly(rubble).blocks[7].outline, wall.blocks[7].outline);
        rubble.seed += 100;
        EXPECT_NE(makeAssembly(rubble).blocks[7].outline, wall.blocks[7].outline);
    }
}

} // namespace
