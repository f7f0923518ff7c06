// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// A force at a point that several blocks share acts on the one that is chosen.
#include "assembly/Loads.h"
#include "core/Error.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

using namespace drystone;
using testing::AllOf;
using testing::HasSubstr;

namespace
{

/// Two blocks of 1 x 1 m side by side and one upon them.
class LoadsOnJoints : public testing::Test
{
protected:
    void SetUp() override
    {
        directory = std::filesystem::path(testing::TempDir())
                    / ("loads-" + std::string(testing::UnitTest::GetInstance()->current_test_info()->name()));
        std::filesystem::create_directories(directory / "constant");
    }
    void TearDown() override { std::filesystem::remove_all(directory); }

    /// The free block that a force acts on, or what is said.
    std::string loaded(const std::string& force, const std::string& type = "force")
    {
        std::ofstream(directory / "constant/loads")
            << "dead { type gravity; }\nlive\n{\n    type " << type << ";\n    "
            << (type == "sum" ? "" : "value (0 -1 0);") << "\n    " << force << "\n}\n";
        try
        {
            const Eigen::VectorXd live =
                readLoads<2>(directory, {assembly, masses, {0, -10}}, LiveLoad::required).live;
            for (int block = 0; block < 3; ++block)
            {
                if (live[3 * block + 1] != 0)
                {
                    return std::to_string(block);
                }
            }
            return "none";
        }
        catch (const FatalIOError& error)
        {
            return error.report();
        }
    }

    static Block<2> box(double left, double bottom, double right, double top, int support = -1)
    {
        return {{{left, bottom}, {right, bottom}, {right, top}, {left, top}}, 1, support};
    }

    std::filesystem::path directory;
    Assembly<2> assembly{{box(0, 0, 1, 1), box(1, 0, 2, 1), box(0, 1, 2, 2), box(-1, -1, 3, 0, 0)},
                         {{"ground", "ground"}}};
    std::vector<double> masses{1, 1, 2, 4};
};

TEST_F(LoadsOnJoints, AskForTheBlockWithinTheToleranceOfAJoint)
{
    for (const double off : {-1e-7, 0.0, 1e-7})
    {
        EXPECT_THAT(loaded(fmt::format("at ({} 0.5);", 1 + off)),
                    AllOf(HasSubstr("on the joint of blocks 0 and 1"), HasSubstr("`block 0;`"),
                          HasSubstr("line 6.")));
        EXPECT_EQ(loaded(fmt::format("at ({} 0.5); block 0;", 1 + off)), "0");
        EXPECT_EQ(loaded(fmt::format("at ({} 0.5); block 1;", 1 + off)), "1");
    }
    EXPECT_THAT(loaded("at (1 1);"), HasSubstr("blocks 0 and 1 and 2"));
}

TEST_F(LoadsOnJoints, NeedNoBlockWhereOnlyOneIsMeant)
{
    EXPECT_EQ(loaded("at (0.999 0.5);"), "0");
    EXPECT_EQ(loaded("at (1.001 0.5);"), "1");
    EXPECT_EQ(loaded("at (1 2);"), "2");
    EXPECT_EQ(loaded("at (0.5 0);"), "0");     // the ground carries what acts on it by itself
    EXPECT_EQ(loaded("at (-0.01 0.5);"), "0"); // near by
}

TEST_F(LoadsOnJoints, RefuseABlockThatIsNotThere)
{
    EXPECT_THAT(loaded("at (0.5 0.5); block 1;"),
                AllOf(HasSubstr("can not act on block 1"), HasSubstr("block 0")));
    EXPECT_THAT(loaded("at (1 0.5); block 7;"), HasSubstr("in or on block 0 and 1"));
    EXPECT_THAT(loaded("at (1 0.5); block -1;"), HasSubstr("block"));
}

TEST_F(LoadsOnJoints, AskForTheBlockOfALineAlongAJoint)
{
    for (const double off : {-1e-7, 0.0, 1e-7})
    {
        const std::string line = fmt::format("from ({} 0.2); to (1 0.8);", 1 + off);
        EXPECT_THAT(loaded(line, "line"), AllOf(HasSubstr("along the joint of blocks 0 and 1"),
                                                HasSubstr("`block 0;`"), HasSubstr("line 6.")));
        EXPECT_EQ(loaded(line + " block 0;", "line"), "0");
        EXPECT_EQ(loaded(line + " block 1;", "line"), "1");
        EXPECT_THAT(loaded(line + " block 2;", "line"), HasSubstr("along the joint of blocks 0 and 1"));
    }
    EXPECT_THAT(loaded("from (0.1 1); to (1.9 1);", "line"), HasSubstr("blocks 0 and 2"));
    EXPECT_EQ(loaded("from (0.1 1); to (1.9 1); block 2;", "line"), "2");
    EXPECT_EQ(loaded("from (0.1 2); to (1.9 2);", "line"), "2");
    EXPECT_EQ(loaded("from (0.1 0.5); to (1.9 0.5);", "line"), "0"); // it crosses the joint
    EXPECT_THAT(loaded("from (0.1 0.5); to (0.9 0.5); block 1;", "line"),
                HasSubstr("can not act on block 1"));
}

TEST_F(LoadsOnJoints, RefuseWhatLiesInTheGround)
{
    EXPECT_THAT(loaded("at (0.5 -0.01);"), HasSubstr("no free block at (0.5 -0.01)"));
    EXPECT_THAT(loaded("from (0.2 -0.01); to (0.8 -0.01);", "line"), HasSubstr("leaves the free blocks"));
}

TEST_F(LoadsOnJoints, AreSaidToBeTakenFromOutside)
{
    testing::internal::CaptureStdout();
    EXPECT_EQ(loaded("at (-0.01 0.5);"), "0");
    EXPECT_EQ(loaded("at (0 0.5);"), "0");
    EXPECT_EQ(loaded("from (0 2.01); to (1 2.01);", "line"), "2");
    EXPECT_EQ(testing::internal::GetCapturedStdout(),
              "The force at (-0.01 0.5) acts on block 0, 0.01 m away.\n"
              "The line from (0 2.01) to (1 2.01) acts on block 2, 0.01 m away.\n");
}

TEST_F(LoadsOnJoints, ThatCancelButForRoundingAreNoLiveLoad)
{
    EXPECT_THAT(
        loaded("loads { a { type force; at (0.1 0.5); value (0.1 0.7); } b { type force; at (0.1 0.5); "
               "value (0.2 0.1); } c { type force; at (0.1 0.5); value (-0.3 -0.8); } }",
               "sum"),
        HasSubstr("zero on every block"));
}

} // namespace
