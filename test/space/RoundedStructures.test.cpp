// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
// Structures whose coordinates were written to a few digits keep their joints, at rest and in motion.
#include "../MadeStructure.h"
#include "SpaceStructures.h"
#include "assembly/WrittenDigits.h"
#include "contact/AlmostJoints.h"
#include "contact/AssemblyChecks.h"
#include "contact/JointClosure.h"
#include "contact/space/MovingContacts.h"
#include "dictionary/Dictionary.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <numbers>

namespace drystone
{
namespace
{

/// A front wall of bricks with two returns that are toothed into it: faces along two directions.
Assembly<3> wallsOfU()
{
    return madeStructure<3>(Dictionary::readString(
        "dimensions 3;\n"
        "texture { type walls; unit (0.4 0.2 0.2); bond running; courses 6;\n"
        "    walls { front { from (0 0); length 2; }\n"
        "            left { from (0 0); direction (0 1); length 1.2; thickness right; }\n"
        "            right { from (1.6 0); direction (0 1); length 1.2; thickness left; } } }\n"
        "supports { ground { type ground; } }\n",
        "blockTextureDict"));
}

Eigen::Matrix3d turn(double angle, const Vector<3>& axis)
{
    return Eigen::AngleAxisd(angle, axis.normalized()).toRotationMatrix();
}

/// With coordinates as `%.<digits>f` writes them.
Assembly<3> rounded(Assembly<3> assembly, int digits)
{
    for (Block<3>& block : assembly.blocks)
    {
        for (Vector<3>& vertex : block.shape.vertices)
        {
            for (double& coordinate : vertex)
            {
                coordinate = std::strtod(fmt::format("{:.{}f}", coordinate, digits).c_str(), nullptr);
            }
        }
    }
    return assembly;
}

const Vector<3> vertical(0, 0, 1);
const Vector<3> inclined(1, 2, 3);

TEST(WrittenDigitsInSpace, AreThoseAcrossObliqueFaces)
{
    const Assembly<3> along = wallsOfU();
    EXPECT_EQ(writtenRounding(along), 0); // no face is oblique
    for (const Vector<3>& axis : {vertical, inclined})
    {
        const Assembly<3> turned = test::transformed(along, turn(0.17, axis), 1, {0, 0, 0});
        EXPECT_EQ(writtenRounding(turned), 0); // all digits of a double
        for (const int digits : {4, 6, 8})
        {
            const double unit = std::pow(10.0, -digits);
            EXPECT_NEAR(writtenRounding(rounded(turned, digits)), unit, 1e-12 * unit) << digits;
        }
    }
}

TEST(RoundedStructures, KeepTheirJointsAndTheirMultiplier)
{
    const Assembly<3> along = wallsOfU();
    const std::size_t points = findContactPoints(along).size();
    const double alpha = test::multiplier(along, 0.6, {0, -1, 0});
    ASSERT_GT(alpha, 0.1);
    int open = 0; // with few digits all corners of joints may round alike
    for (const Vector<3>& axis : {vertical, inclined})
    {
        const Eigen::Matrix3d rotation = turn(10 * std::numbers::pi / 180, axis);
        for (const int digits : {4, 5, 6, 7, 9})
        {
            const double unit = std::pow(10.0, -digits);
            Assembly<3> assembly = rounded(test::transformed(along, rotation, 1, {0.3, 0.7, 0.1}), digits);
            closeJoints(assembly);
            EXPECT_EQ(assembly.closure.rounding, std::pow(10.0, -digits)) << digits;
            open += assembly.closure.joints;
            EXPECT_LE(assembly.closure.largest, 1.75 * unit);
            EXPECT_EQ(almostJointsText(assembly), "") << digits;
            EXPECT_TRUE(findOverlaps(assembly).empty()) << digits;
            ASSERT_EQ(findContactPoints(assembly).size(), points) << digits;
            EXPECT_EQ(MovingContacts<3>(assembly)
                          .update(std::vector<Placement<3>>(assembly.blocks.size()), 0)
                          .size(),
                      points);
            // A corner moves by half a unit of lever arms of 0.1 m and more.
            EXPECT_NEAR(test::multiplier(assembly, 0.6, rotation * Vector<3>(0, -1, 0),
                                         rotation * Vector<3>(0, 0, -1)),
                        alpha, 20 * unit + 1e-8)
                << digits;
        }
    }
    EXPECT_GT(open, 100);
}

TEST(RoundedStructures, KeepTheToleranceOfFacesAlongTheAxes)
{
    // The digits explain why oblique faces do not meet; a gap of 1e-5 m over the ground they do not.
    Assembly<3> assembly = rounded(test::transformed(wallsOfU(), turn(0.17, vertical), 1, {0, 0, 0}), 5);
    for (Block<3>& block : assembly.blocks)
    {
        for (Vector<3>& vertex : block.shape.vertices)
        {
            vertex.z() += block.support < 0 ? 1e-5 : 0;
        }
    }
    closeJoints(assembly);
    EXPECT_THAT(almostJointsText(assembly), testing::HasSubstr("where joints are closed up to 2"));
    EXPECT_LT(assembly.closure.alongAxes, 1e-6);
    EXPECT_EQ(assembly.closure.tolerance, 1.8e-5);
}

} // namespace
} // namespace drystone
