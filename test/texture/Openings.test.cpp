// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Openings and their lintels beside each other and where walls meet, in the plane and in space.
#include "../MadeStructure.h"
#include "../ReportOf.h"
#include "contact/AssemblyChecks.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

using namespace drystone;
using testing::AllOf;
using testing::HasSubstr;

namespace
{

template<int Dim>
std::string report(const std::string& text)
{
    return reportOf([&] { madeStructure<Dim>(Dictionary::readString(text, "system/blockTextureDict")); });
}

std::string inPlane(const std::string& openings)
{
    return "texture { type runningBond; unit (0.4 0.175); length 8; courses 8;\nopenings ( " + openings
           + " ); }";
}

/// An L of two walls of one leaf, `side` behind the left end of `front`.
std::string corner(const std::string& openings)
{
    return "dimensions 3; texture { type walls; unit (0.4 0.2 0.2); courses 6; walls { front { from (0 0); "
           "length 4; } side { from (0 0); direction (0 1); length 2; thickness right; } }\nopenings ( "
           + openings + " ); }";
}

/// A T: `b` meets `a` from behind at 0.7 - 0.9 m, 1.75 - 2.25 bricks.
std::string tee(const std::string& openings)
{
    return "dimensions 3; texture { type walls; unit (0.4 0.2 0.2); courses 6; walls { a { from (0 0); "
           "length 4; } b { from (0.7 0); direction (0 1); length 2; thickness right; } }\nopenings ( "
           + openings + " ); }";
}

double volume(const std::string& text)
{
    const Assembly<3> assembly = madeStructure<3>(Dictionary::readString(text, "dict"));
    EXPECT_TRUE(findOverlaps(assembly).empty());
    double sum = 0;
    for (const Block<3>& block : assembly.blocks)
    {
        sum += volumeProperties(block.shape).volume;
    }
    return sum;
}

TEST(Openings, ALintelInACourseThatAnotherOpeningCutsIsRefused)
{
    EXPECT_THAT(report<2>(inPlane("{ from (1.5 2); to (3.5 4); lintel 0.5; } { from (2 4); to (3 6); }")),
                AllOf(HasSubstr("Opening 0 (1.5 2)-(3.5 4) has a lintel from 1 to 4 units in course 4"),
                      HasSubstr("opening 1 is cut there from 2 to 3"), HasSubstr("Move one"),
                      HasSubstr("line 2.")));
    // Whatever comes first in the list, and also where only a bearing is cut.
    EXPECT_THAT(report<2>(inPlane("{ from (0.5 4); to (1.2 6); } { from (1.5 2); to (3.5 4); lintel 0.5; }")),
                HasSubstr("opening 0 is cut there"));
    EXPECT_EQ(report<2>(inPlane("{ from (0 4); to (1 6); } { from (1.5 2); to (3.5 4); lintel 0.5; }")),
              "no error");
    EXPECT_EQ(report<2>(inPlane("{ from (2 5); to (3 6); } { from (1.5 2); to (3.5 4); lintel 0.5; }")),
              "no error");
    const std::string below = "{ wall front; from (1.5 2); to (3 4); lintel 0.5; } ";
    EXPECT_THAT(report<3>(corner(below + "{ wall front; from (2 4); to (3 5); }")),
                HasSubstr("opening 1 is cut there from 2 to 3"));
    EXPECT_EQ(report<3>(corner(below + "{ wall side; from (1 4); to (2 5); }")), "no error");
}

TEST(Openings, LintelsThatOverlapAreRefusedAndThoseThatMeetAreNot)
{
    EXPECT_THAT(report<2>(inPlane(
                    "{ from (1.5 2); to (2.5 4); lintel 0.5; } { from (3.2 2); to (4.5 4); lintel 0.5; }")),
                AllOf(HasSubstr("Opening 0 (1.5 2)-(2.5 4) has a lintel from 1 to 3 units in course 4"),
                      HasSubstr("that of opening 1 is from 2.7 to 5: they overlap"), HasSubstr("Shorten")));
    EXPECT_EQ(report<2>(inPlane(
                  "{ from (1.5 2); to (2.5 4); lintel 0.6; } { from (3.7 2); to (4.5 4); lintel 0.6; }")),
              "no error");
    EXPECT_THAT(
        report<3>(corner("{ wall front; from (1.2 2); to (2 4); lintel 0.5; } { wall front; from (2.7 "
                         "3); to (3.4 4); lintel 0.5; }")),
        HasSubstr("they overlap"));
}

// 1.1 - 0.6 is 0.5 and a rounding: no block is left between it and the joint at 0.5.
TEST(Openings, ALintelThatEndsAtAJointButForRoundingLeavesNoSliver)
{
    const Assembly<2> wall =
        madeStructure(Dictionary::readString(inPlane("{ from (1.1 2); to (2.2 4); lintel 0.6; }"), "dict"));
    for (const Block<2>& block : wall.blocks)
    {
        EXPECT_GT(areaProperties(block.outline).area, 1e-3);
    }
}

TEST(Openings, ALintelWhoseBearingAnotherWallTakesIsRefused)
{
    EXPECT_THAT(report<3>(corner("{ wall front; from (0.6 0); to (2 3); lintel 0.5; }")),
                AllOf(HasSubstr("Opening 0 (0.6 0)-(2 3) has a lintel from 0.1 to 2.5 bricks in course 3"),
                      HasSubstr("wall side runs through from 0 to 0.5"),
                      HasSubstr("a course higher or lower"), HasSubstr("line 2.")));
    EXPECT_EQ(report<3>(corner("{ wall front; from (0.6 0); to (2 4); lintel 0.5; }")), "no error");
    EXPECT_EQ(report<3>(corner("{ wall front; from (1 0); to (2 3); lintel 0.5; }")), "no error");
    // The side wall's window is open over the whole corner.
    EXPECT_THAT(report<3>(corner("{ wall front; from (0.6 0); to (2 4); lintel 0.5; } { wall side; from (0 "
                                 "4); to (1 5); }")),
                HasSubstr("an opening of the wall that it meets is cut from 0 to 0.5"));
}

TEST(Openings, AnOpeningOverAJunctionIsOpenOverTheThicknessOfItsWall)
{
    // The walls less the opening, of its wall's thickness, whichever wall runs through: 6 courses of 1.6 m
    // and 0.6 m, 0.2 m thick.
    const double walls = 1.2 * 0.2 * (1.6 + 0.6);
    EXPECT_NEAR(volume(tee("{ wall a; from (1 1); to (3 4); }")), walls - 0.8 * 0.2 * 0.6, 1e-12);
    EXPECT_NEAR(volume(tee("{ wall b; from (0 1); to (1 4); }")), walls - 0.4 * 0.2 * 0.6, 1e-12);
    EXPECT_NEAR(volume(corner("{ wall front; from (0 2); to (1 4); }")), walls - 0.4 * 0.2 * 0.4, 1e-12);
    EXPECT_NEAR(volume(corner("{ wall side; from (0 2); to (1 4); }")), walls - 0.4 * 0.2 * 0.4, 1e-12);
    EXPECT_NEAR(volume(corner("{ wall front; from (0.5 2); to (1 4); }")), walls - 0.2 * 0.2 * 0.4, 1e-12);
}

TEST(Openings, AnOpeningThatEndsWithinAJunctionIsRefusedWhereTheOtherWallRunsThrough)
{
    EXPECT_THAT(report<3>(tee("{ wall a; from (1 2); to (2 4); }")),
                AllOf(HasSubstr("Opening 0 (1 2)-(2 4) reaches into the junction with wall b"),
                      HasSubstr("1.75 to 2.25 bricks of wall a and runs through in course 3"),
                      HasSubstr("End the opening before")));
    EXPECT_THAT(
        report<3>(corner("{ wall side; from (0.2 1); to (1 3); }")),
        HasSubstr("junction with wall front, which takes 0 to 0.5 bricks of wall side and runs through "
                  "in course 2"));
    // Walls at an angle, whose ends miss each other by rounding.
    EXPECT_THAT(
        report<3>("dimensions 3; texture { type walls; unit (0.4 0.2 0.2); courses 6; walls { front { "
                  "from (0 0); direction (-0.8 0.6); length 4; } side { from (0 0); direction (-0.6 "
                  "-0.8); length 3; thickness right; } } openings ({ wall side; from (0.2 1); to (1 "
                  "3); }); }"),
        HasSubstr("which takes 0 to 0.5 bricks of wall side"));
    // In a course of its own the wall's brick is cut at the jamb.
    EXPECT_EQ(report<3>(tee("{ wall a; from (1 2); to (2 3); }")), "no error");
    EXPECT_EQ(report<3>(tee("{ wall a; from (1 2); to (1.75 4); }")), "no error");
}

} // namespace
