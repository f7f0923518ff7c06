// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Starts of 0/motion: inside another block they are refused, and a rotation may name its point.
#include "../ReportOf.h"
#include "Scenes.h"
#include "SpaceScenes.h"

#include "contact/Penetration.h"
#include "core/Error.h"
#include "dynamics/StartCheck.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

namespace drystone
{
namespace
{

using testing::AllOf;
using testing::HasSubstr;

/// The block of tutorial rockingBlock, 0.5 x 2 m, on the ground.
class StartCheck : public testing::Test
{
protected:
    void SetUp() override
    {
        assembly.blocks.push_back(scenes::rectangle(-0.25, 0, 0.5, 2));
        directory = std::filesystem::path(testing::TempDir())
                    / ("start-" + std::string(testing::UnitTest::GetInstance()->current_test_info()->name()));
        std::filesystem::create_directories(directory / "0");
    }
    void TearDown() override { std::filesystem::remove_all(directory); }

    std::string report(const std::string& start, JointStiffness joints = JointStiffness::rigid)
    {
        std::ofstream(directory / "0/motion") << "1\n{\n    " << start << "\n}\n";
        return reportOf(
            [&]
            {
                const InitialState<2> initial = readInitialMotion(directory, "0", assembly);
                state = initial.state;
                refuseStartOverlaps(assembly, state.placements, initial.places, joints);
            });
    }

    std::filesystem::path directory;
    Assembly<2> assembly = scenes::ground(-4, 4);
    DynamicState<2> state;
};

TEST_F(StartCheck, ElasticJointsMayStartPressedTogether)
{
    testing::internal::CaptureStderr();
    EXPECT_EQ(report("displacement (0 -0.01);", JointStiffness::elastic), "no error");
    EXPECT_THAT(testing::internal::GetCapturedStderr(),
                AllOf(HasSubstr("block 1 is 0.01 m deep in block 0"), HasSubstr("0/motion/1 at line 1")));
    EXPECT_THAT(report("displacement (0 -0.5);", JointStiffness::elastic),
                HasSubstr("block 1 is 0.5 m deep in block 0"));
    EXPECT_THAT(report("displacement (0 -0.01);"), HasSubstr("block 1 is 0.01 m deep in block 0"));
}

TEST_F(StartCheck, QuestionsSpeedsThatNoStepResolves)
{
    const auto warning = [this](const std::string& start, double deltaT, bool adjustTimeStep = false)
    {
        std::ofstream(directory / "0/motion") << "1\n{\n    " << start << "\n}\n";
        const InitialState<2> initial = readInitialMotion(directory, "0", assembly);
        testing::internal::CaptureStderr();
        TimeControls controls;
        controls.deltaT = deltaT;
        controls.adjustTimeStep = adjustTimeStep;
        questionSpeeds(assembly, initial, controls);
        return testing::internal::GetCapturedStderr();
    };
    EXPECT_THAT(warning("angularVelocity 1e6;", 0.01),
                AllOf(HasSubstr("Block 1 turns by 1e+04 rad in a step of deltaT 0.01 s"),
                      HasSubstr("at most 1e-07 s"), HasSubstr("0/motion/1 at line 1")));
    EXPECT_THAT(warning("velocity (0 1e3);", 0.01), HasSubstr("Block 1 moves by 10 m"));
    EXPECT_EQ(warning("velocity (0 10); angularVelocity -20;", 0.01), "");
    EXPECT_EQ(warning("angularVelocity 1e6;", 1e-8), "");
    EXPECT_EQ(warning("angularVelocity 1e6;", 0.01, true), "") << "the first step is shorter";
}

TEST_F(StartCheck, RefusesAStartInTheGroundWithBothNamesAndTheDepth)
{
    EXPECT_THAT(report("displacement (0 -0.1);"),
                AllOf(HasSubstr("block 1 is 0.1 m deep in block 0 (support ground)"),
                      HasSubstr("about (x y);"), HasSubstr("0/motion"), HasSubstr("line 1.")));
    EXPECT_THAT(report("rotation 0.05;"), HasSubstr("block 1 is 0.0112"));
    EXPECT_THAT(report("displacement (0 -1e-5);"), HasSubstr("1e-05 m deep"));
}

TEST_F(StartCheck, NamesThePatternThatPlacedTheBlock)
{
    std::ofstream(directory / "0/motion") << "\n\n\"[1-9]\" { displacement (0 -0.1); }\n";
    const InitialState<2> initial = readInitialMotion(directory, "0", assembly);
    ASSERT_EQ(initial.places.size(), assembly.blocks.size());
    EXPECT_EQ(initial.places[1].line, 3);
    EXPECT_TRUE(readInitialMotion(directory, "1", assembly).places.empty()) << "there is no 1/motion";
}

TEST_F(StartCheck, PatternsThatGiveABlockNothingAreNamed)
{
    const auto warning = [this](const std::string& name)
    {
        std::ofstream(directory / "0/motion") << "\n\n\"" << name << "\" { velocity (1 0); }\n";
        testing::internal::CaptureStdout();
        testing::internal::CaptureStderr();
        readInitialMotion(directory, "0", assembly);
        return testing::internal::GetCapturedStdout() + testing::internal::GetCapturedStderr();
    };
    EXPECT_THAT(warning("(1|33)"), AllOf(HasSubstr("there is no block 33"), HasSubstr("line 3")));
    EXPECT_EQ(warning("0|1"), "") << "the support has no start";
    EXPECT_EQ(warning(".*"), "");
    const std::string report = reportOf([&] { warning("0|00"); });
    testing::internal::GetCapturedStdout();
    testing::internal::GetCapturedStderr();
    EXPECT_THAT(report, AllOf(HasSubstr("Only free blocks can be given a start"), HasSubstr("line 3")));
}

TEST_F(StartCheck, RefusesAStartInAnotherFreeBlock)
{
    assembly.blocks.push_back(scenes::rectangle(0.25, 0, 0.5, 2));
    EXPECT_THAT(report("displacement (0.01 0);"), HasSubstr("block 1 is 0.01 m deep in block 2"));
    EXPECT_EQ(report("displacement (-0.01 0);"), "no error");
}

TEST_F(StartCheck, AcceptsStartsOnAndAboveTheGround)
{
    EXPECT_EQ(report("velocity (1 0);"), "no error");
    EXPECT_EQ(report("displacement (0 1);"), "no error");
    EXPECT_EQ(report("displacement (0 -1e-9);"), "no error");
    // As tutorial rockingBlock had it, by arithmetic.
    EXPECT_EQ(report("displacement (-0.124056374524979 0.0230533726068292); rotation 0.122489331563432;"),
              "no error");
}

TEST_F(StartCheck, TurnsABlockAboutAPointThatIsNamed)
{
    ASSERT_EQ(report("rotation 0.122489331563432; about (-0.25 0);"), "no error");
    EXPECT_NEAR(state.placements[1].translation.x(), -0.124056374524979, 1e-14);
    EXPECT_NEAR(state.placements[1].translation.y(), 0.0230533726068292, 1e-14);
    EXPECT_LT(penetration(assembly, state.placements).depth, 1e-15);
    const Polygon outline = placedOutline(assembly.blocks[1], state.placements[1]);
    EXPECT_LT((outline[0] - Vector<2>(-0.25, 0)).norm(), 1e-15);
    // Then it is displaced.
    ASSERT_EQ(report("rotation 0.1; about (-0.25 0); displacement (1 2);"), "no error");
    EXPECT_LT((placedOutline(assembly.blocks[1], state.placements[1])[0] - Vector<2>(0.75, 2)).norm(), 1e-14);
    EXPECT_THAT(report("about (-0.25 0);"), HasSubstr("no rotation"));
}

TEST_F(StartCheck, APointOfSpaceHasThreeComponents)
{
    Assembly<3> tower;
    tower.blocks.push_back(spaceScenes::boxBlock({0, 0, 0}, {1, 1, 2}));
    std::ofstream(directory / "0/motion") << "0\n{\n    rotation (0 0.1 0);\n    about (0.5 0);\n}\n";
    EXPECT_THAT(reportOf([&] { readInitialMotion(directory, "0", tower); }),
                AllOf(HasSubstr("3"), HasSubstr("0/motion/0/about at line 4")));
}

TEST_F(StartCheck, QuestionsRotationsThatLookLikeDegrees)
{
    testing::internal::CaptureStderr();
    report("rotation 5; displacement (0 3);");
    EXPECT_THAT(
        testing::internal::GetCapturedStderr(),
        AllOf(HasSubstr("286.5 degrees"), HasSubstr("`rotation 0.0872664626;`"), HasSubstr("0/motion")));
    testing::internal::CaptureStderr();
    report("rotation 0.3; about (-0.25 0);");
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

} // namespace
} // namespace drystone
