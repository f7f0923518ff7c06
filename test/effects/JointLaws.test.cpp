// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Strengths of joints: names, patterns, areas, and every fault with its line.
#include "effects/JointLaws.h"

#include "../ReportOf.h"
#include "effects/EffectList.h"
#include "effects/Friction.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

using namespace drystone;
using testing::AllOf;
using testing::HasSubstr;

namespace
{

/// Two blocks of 1 x 2 m, 0.5 and 0.25 m thick, one on the other, on ground of another thickness.
class JointLaws : public testing::Test
{
protected:
    void SetUp() override
    {
        directory =
            std::filesystem::path(testing::TempDir())
            / ("joints-" + std::string(testing::UnitTest::GetInstance()->current_test_info()->name()));
        std::filesystem::create_directories(directory / "constant");
    }
    void TearDown() override { std::filesystem::remove_all(directory); }

    std::vector<PointLaw> laws(const std::string& text)
    {
        std::ofstream(directory / "constant/contactProperties") << text;
        const ContactProperties properties = readContactProperties(directory);
        const std::vector<ContactPoint<2>> ends = findContactPoints(assembly);
        return pointLaws(properties, assembly, divideJoints(ends, properties.pointsPerJoint.value_or(2)));
    }
    std::string report(const std::string& text)
    {
        return reportOf([&] { laws(text); });
    }

    std::filesystem::path directory;
    Assembly<2> assembly{{{{{0, 0}, {1, 0}, {1, 2}, {0, 2}}, 0.5},
                          {{{0, 2}, {1, 2}, {1, 4}, {0, 4}}, 0.25},
                          {{{-5, -1}, {5, -1}, {5, 0}, {-5, 0}}, 3, 0}},
                         {{"ground", "ground"}}};
};

} // namespace

TEST_F(JointLaws, AreNamedByBlocksAndSupports)
{
    EXPECT_EQ(jointName(assembly, 1, 0), "0-1");
    EXPECT_EQ(jointName(assembly, 2, 0), "0-ground");
}

TEST_F(JointLaws, ShareTheAreaOfAJointAmongItsPoints)
{
    // 0-1: the lesser thickness, 0.25 m2 in halves; 0-ground: that of the block, 0.5 m2.
    const std::vector<double> areas = pointAreas(assembly, findContactPoints(assembly));
    ASSERT_EQ(areas.size(), 4U);
    EXPECT_DOUBLE_EQ(areas[0], 0.125);
    EXPECT_DOUBLE_EQ(areas[1], 0.125);
    EXPECT_DOUBLE_EQ(areas[2], 0.25);
    EXPECT_DOUBLE_EQ(areas[3], 0.25);
    const std::vector<ContactPoint<2>> points = divideJoints(findContactPoints(assembly), 5);
    ASSERT_EQ(points.size(), 10U);
    EXPECT_DOUBLE_EQ(pointAreas(assembly, points)[0], 0.25 / 8);
    EXPECT_DOUBLE_EQ(pointAreas(assembly, points)[2], 0.25 / 4);
    EXPECT_EQ(points[0].position, findContactPoints(assembly)[0].position);
    EXPECT_EQ(points[4].position, findContactPoints(assembly)[1].position);
}

TEST_F(JointLaws, AreThoseOfAllJointsWhereNoNameFits)
{
    const auto of =
        laws("friction { type Coulomb; mu 0.5; } cohesion { strength 1000; } tension { strength 800; } "
             "crushing { strength 1e6; }");
    ASSERT_EQ(of.size(), 4U);
    EXPECT_EQ(of[0].mu, 0.5);
    EXPECT_DOUBLE_EQ(of[0].cohesion, 125);
    EXPECT_DOUBLE_EQ(of[2].cohesion, 250);
    EXPECT_DOUBLE_EQ(of[2].tension, 200);
    EXPECT_DOUBLE_EQ(of[2].crushing, 2.5e5);
    EXPECT_TRUE(std::isinf(laws("friction { type Coulomb; mu 0.5; }")[0].crushing));
}

TEST_F(JointLaws, OfExactNamesComeBeforeTheLastPattern)
{
    const auto of =
        laws("friction { type Coulomb; mu 0.5; }\njoints\n{\n\".*-ground\" { friction { mu 0.3; } "
             "cohesion { strength 4; } }\n0-1 { friction { mu 0.1; } }\n\".*\" { friction { mu 0.2; } "
             "}\n}");
    EXPECT_EQ(of[0].mu, 0.1); // 0-1
    EXPECT_EQ(of[2].mu, 0.2); // 0-ground: the last that matches
    EXPECT_EQ(of[2].cohesion, 0);
}

TEST_F(JointLaws, WarnOfANameWithinAPatternThatNoJointHas)
{
    const auto warnings = [&](const std::string& pattern)
    {
        testing::internal::CaptureStderr();
        laws("friction { type Coulomb; mu 0.5; }\njoints\n{\n\"" + pattern
             + "\" { friction { mu 0.2; } }\n}");
        return testing::internal::GetCapturedStderr();
    };
    assembly.zones = {{"shaft", {0}}, {"base", {1}}};
    EXPECT_EQ(warnings("0-1|0-ground"), "");
    EXPECT_EQ(warnings("(shaft|base)-ground"), "");
    EXPECT_EQ(warnings("(0-1|0-ground)"), "") << "whole names in brackets were said not to exist";
    EXPECT_EQ(warnings("((0-1|ground-0)|(shaft|base)-ground)"), "");
    EXPECT_EQ(warnings("(shaft|base)-.*|7-.*"), "") << "not of names alone";
    EXPECT_THAT(warnings("0-1|shatf-ground"),
                testing::AllOf(testing::HasSubstr("no joint shatf-ground. Did you mean shaft-ground?"),
                               testing::HasSubstr("at line 4")));
    EXPECT_THAT(warnings("(shaft|bsae)-ground"), testing::HasSubstr("no joint bsae. Did you mean base?"));
    EXPECT_THAT(warnings("(0-1|0-gruond)"), testing::HasSubstr("no joint 0-gruond. Did you mean 0-ground?"));
}

// The last of the two counted without a word.
TEST_F(JointLaws, TwoEntriesThatNameAJointByItsZonesAreWarnedOf)
{
    assembly.zones = {{"base", {0}}, {"shaft", {1}}, {"damp", {1}}};
    const auto warnings = [&](const std::string& more)
    {
        testing::internal::CaptureStderr();
        EXPECT_EQ(laws("friction { type Coulomb; mu 0.5; }\njoints\n{\nbase-shaft { friction { mu 0.3; } }\n"
                       + more + "\n}")[0]
                      .mu,
                  0.2);
        return testing::internal::GetCapturedStderr();
    };
    EXPECT_THAT(warnings("damp-base { friction { mu 0.2; } }"),
                AllOf(HasSubstr("as base-shaft at line 4 and as damp-base at line 5: damp-base, which comes "
                                "later, counts"),
                      HasSubstr("joints/damp-base at line 5")));
    EXPECT_EQ(warnings("damp-base { friction { mu 0.1; } } 0-1 { friction { mu 0.2; } }"), "")
        << "the name of the blocks comes before both";
}

// Of a zone with fixed and free blocks the fixed ones kept the friction of all joints without a word.
TEST_F(JointLaws, ZonesHaveTheirFixedBlocksToo)
{
    assembly.zones = {{"base", {0, 2}}, {"shaft", {1}}, {"rock", {2}}};
    const auto of = [&](const std::string& name) {
        return laws("friction { type Coulomb; mu 0.5; }\njoints\n{\n" + name
                    + " { friction { mu 0.2; } }\n}");
    };
    EXPECT_EQ(of("base-base")[2].mu, 0.2); // 0-ground
    EXPECT_EQ(of("base-rock")[2].mu, 0.2);
    EXPECT_EQ(of("base-ground")[2].mu, 0.2);
    EXPECT_EQ(of("base-shaft")[0].mu, 0.2);
    EXPECT_EQ(of("base-shaft")[2].mu, 0.5);
}

TEST_F(JointLaws, AreNamedByTheirBlocksInEitherOrder)
{
    const auto of = laws("friction { type Coulomb; mu 0.5; }\njoints\n{\n1-0 { friction { mu 0.1; } }\n"
                         "ground-0 { friction { mu 0.2; } }\n}");
    EXPECT_EQ(of[0].mu, 0.1);
    EXPECT_EQ(of[2].mu, 0.2);
}

TEST_F(JointLaws, AJointThatIsNamedInBothOrdersIsRefusedWithBothLines)
{
    EXPECT_THAT(report("friction { type Coulomb; mu 0.5; }\njoints\n{\n0-1 { friction { mu 0.3; } }\n"
                       "\".*\" { friction { mu 0.2; } }\n1-0 { friction { mu 0.1; } }\n}"),
                AllOf(HasSubstr("named twice, as 0-1 at line 4 and as 1-0 at line 6"),
                      HasSubstr("Remove one of the two."), HasSubstr("joints/1-0 at line 6")));
    assembly.zones = {{"lower", {0}}, {"upper", {1}}};
    EXPECT_THAT(report("friction { type Coulomb; mu 0.5; }\njoints\n{\nupper-lower { friction { mu 0.3; } }\n"
                       "lower-upper { friction { mu 0.1; } }\n}"),
                HasSubstr("as upper-lower at line 4 and as lower-upper at line 5"));
    EXPECT_EQ(report("friction { type Coulomb; mu 0.5; }\njoints\n{\nupper-lower { friction { mu 0.3; } }\n"
                     "1-0 { friction { mu 0.1; } }\n}"),
              "no error");
}

// They were refused as joints that there are none, so that only a pattern could give them a friction.
TEST_F(JointLaws, OfBlocksThatTouchLaterHaveAFrictionInMotionAlone)
{
    const auto reportOfMotion = [&](const std::string& joint)
    {
        std::ofstream(directory / "constant/contactProperties")
            << "friction { type Coulomb; mu 0.5; }\njoints\n{\n" + joint + "\n}";
        const ContactProperties properties = readContactProperties(directory);
        try
        {
            const FrictionOfJoints known = frictionOfJoints(properties, assembly);
            ContactPoint<2> met;
            met.block = 1;
            met.neighbour = 2;
            return fmt::format("{}", frictionAt(properties, assembly, known, {met})[0]);
        }
        catch (const FatalError& error)
        {
            return error.report();
        }
    };
    EXPECT_EQ(reportOfMotion("1-ground { friction { mu 0.3; } }"), "0.3");
    EXPECT_EQ(reportOfMotion("ground-1 { friction { mu 0.3; } }"), "0.3");
    EXPECT_THAT(reportOfMotion("1-gruond { friction { mu 0.3; } }"), HasSubstr("no joint 1-gruond"));
    EXPECT_THAT(reportOfMotion("1-ground { cohesion { strength 5; } }"), HasSubstr("no joint 1-ground"));
    EXPECT_THAT(reportOfMotion("1-7 { friction { mu 0.3; } }"), HasSubstr("no joint 1-7"));
    EXPECT_THAT(report("friction { type Coulomb; mu 0.5; }\njoints { 1-ground { friction { mu 0.3; } } }"),
                HasSubstr("no joint 1-ground"));
    assembly.zones = {{"upper", {1}}, {"lower", {0}}};
    EXPECT_EQ(reportOfMotion("upper-ground { friction { mu 0.2; } }"), "0.2");
    EXPECT_THAT(reportOfMotion("upper-upper { friction { mu 0.2; } }"), HasSubstr("no joint upper-upper"));
}

TEST_F(JointLaws, FaultsAreNamed)
{
    EXPECT_THAT(report("joints\n{\n\"7-.*\" { friction { mu 0.3; } }\n}"),
                AllOf(HasSubstr("There is no joint 7-.*"), HasSubstr("line 3.")));
    EXPECT_THAT(
        report("friction { type Coulomb; mu 0.5; }\ncohesion { strength 10; }\ntension { strength 30; }"),
        AllOf(HasSubstr("cohesion { strength 15; }"), HasSubstr("line 3.")));
    EXPECT_THAT(report("\ncohesion { strength -1; }"), AllOf(HasSubstr("strength"), HasSubstr("line 2.")));
    EXPECT_THAT(report("cohesion { }"), HasSubstr("strength"));
    EXPECT_THAT(report("\ncrushing { strength 0; }"),
                AllOf(HasSubstr("bears no pressure"), HasSubstr("line 2.")));
    EXPECT_THAT(report("pointsPerJoint 1;"), HasSubstr("pointsPerJoint"));
    EXPECT_THAT(report("joints { 0-1 { restitution { normal 1; } } }"), HasSubstr("restitution"));
}
