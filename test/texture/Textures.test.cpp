// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Courses, polygons and arches.
#include "contact/ContactPoint.h"
#include "texture/Arch.h"
#include "texture/Courses.h"
#include "texture/Polygons.h"
#include "texture/RunningBond.h"

#include <gtest/gtest.h>

#include <cmath>
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
    EXPECT_NEAR(area, arch.thickness * 27 * std::sin(EIGEN_PI / 27), 1e-14);
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

} // namespace
