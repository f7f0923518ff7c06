// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Zones of an assembly and joints that it states: written, read back, used by materials, refused where
/// wrong.
#include "../ReportOf.h"
#include "assembly/AssemblyFile.h"
#include "assembly/AssemblyOrigin.h"
#include "assembly/Materials.h"
#include "core/Error.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

using namespace drystone;
using testing::HasSubstr;

namespace
{

class Zones : public testing::Test
{
protected:
    void SetUp() override
    {
        directory = std::filesystem::path(testing::TempDir())
                    / ("zones-" + std::string(testing::UnitTest::GetInstance()->current_test_info()->name()));
        std::filesystem::create_directories(directory / "constant/assembly");
    }
    void TearDown() override { std::filesystem::remove_all(directory); }

    void write(const std::string& file, const std::string& text) const
    {
        std::ofstream(directory / file) << text;
    }

    std::filesystem::path directory;
};

/// Two cubes on each other, the lower one fixed.
Assembly<3> twoCubes()
{
    Assembly<3> assembly;
    assembly.supports.push_back({"base", "blocks"});
    assembly.blocks.push_back({makeBox({0, 0, 0}, {1, 1, 1}), 0});
    assembly.blocks.push_back({makeBox({0, 0, 1}, {1, 1, 2})});
    assembly.zones = {{"stone", {0, 1}}, {"brick.red", {1}}};
    return assembly;
}

TEST_F(Zones, AreReadBackAsTheyWereWritten)
{
    const Assembly<3> assembly = twoCubes();
    write("constant/assembly/blocks", assemblyText(assembly));
    const Assembly<3> read = readBlocks<3>(directory);
    ASSERT_EQ(read.zones.size(), 2u);
    EXPECT_EQ(read.zones[1].name, "brick.red");
    EXPECT_EQ(read.zones[1].blocks, std::vector<int>{1});
    EXPECT_EQ(fingerprint(read), fingerprint(assembly));
}

TEST_F(Zones, WithABlockThatDoesNotExistIsRefused)
{
    Assembly<3> assembly = twoCubes();
    assembly.zones[1].blocks = {2};
    write("constant/assembly/blocks", assemblyText(assembly));
    EXPECT_THAT(reportOf([&] { readBlocks<3>(directory); }),
                HasSubstr("Zone brick.red has block 2, but blocks are numbered from 0 to 1."));
}

TEST_F(Zones, HaveMaterialsOfTheirOwn)
{
    write("constant/materialProperties",
          "density 2000; zones { stone { density 2500; } \"brick.*\" { unitWeight 18000; } }");
    EXPECT_EQ(readDensities<3>(directory, twoCubes(), {0, 0, -10}), (std::vector<double>{2500, 1800}));
    write("constant/materialProperties", "density 2000; zones { stones { density 2500; } }");
    EXPECT_THAT(reportOf(
                    [&] {
                        readDensities<3>(directory, twoCubes(), {0, 0, -10});
                    }),
                HasSubstr("Unknown zone stones. Did you mean stone?"));
}

TEST_F(Zones, TakeTheMaterialOfTheirNameBeforeThatOfPatterns)
{
    Assembly<3> assembly = twoCubes();
    assembly.zones = {{"stone", {0}}, {"brick", {1}}};
    const std::string ofName = "brick { density 1800; } ";
    const std::string ofPattern = "\".*\" { density 2500; } ";
    for (const std::string& zones : {ofName + ofPattern, ofPattern + ofName})
    {
        write("constant/materialProperties", "density 2000; zones { " + zones + "}");
        EXPECT_EQ(readDensities<3>(directory, assembly, {0, 0, -10}), (std::vector<double>{2500, 1800}))
            << zones;
    }
}

// One of several names was mistyped: its blocks had the density of all others without a word.
TEST_F(Zones, ANameWithinAPatternThatNoZoneHasIsWarnedOf)
{
    const auto warnings = [&](const std::string& pattern)
    {
        write("constant/materialProperties", "density 2000; zones { \"" + pattern + "\" { density 2500; } }");
        testing::internal::CaptureStdout();
        testing::internal::CaptureStderr();
        readDensities<3>(directory, twoCubes(), {0, 0, -10});
        return testing::internal::GetCapturedStdout() + testing::internal::GetCapturedStderr();
    };
    EXPECT_THAT(warnings("sotne|brick.red"),
                testing::Not(HasSubstr("sotne"))); // a dot is no letter of a name
    EXPECT_THAT(warnings("stone|sotne"), HasSubstr("Unknown zone sotne. Did you mean stone?"));
    EXPECT_THAT(warnings("(stone|sotne)"), HasSubstr("In the pattern (stone|sotne): Unknown zone sotne."));
    EXPECT_EQ(warnings("stone|stone"), "");
    EXPECT_EQ(warnings("(stone|clay).*"), "");
}

TEST_F(Zones, JointsThatAreStatedAreReadBackAsTheyWereWritten)
{
    Assembly<3> assembly = twoCubes();
    const Vector<3> normal = Vector<3>(0.1, 0.2, -1).normalized();
    assembly.statedJoints = {{0, 1, normal, {{0.1, 0, 1}, {1, 0, 1}, {1, 1.0 / 3, 1}}}};
    write("constant/assembly/blocks", assemblyText(assembly));
    const Assembly<3> read = readBlocks<3>(directory);
    ASSERT_EQ(read.statedJoints.size(), 1u);
    EXPECT_EQ(read.statedJoints[0].normal, normal);
    EXPECT_EQ(read.statedJoints[0].points, assembly.statedJoints[0].points);
    EXPECT_EQ(fingerprint(read), fingerprint(assembly));
    EXPECT_NE(fingerprint(read), fingerprint(twoCubes()));
}

// Solvers that share out pairs of blocks to threads have each pair once.
TEST_F(Zones, JointsOfAPairOfBlocksAreTogetherInWhateverOrderTheyAreStated)
{
    Assembly<3> assembly = twoCubes();
    assembly.blocks.push_back(assembly.blocks[1]);
    const auto joint = [](int block, int neighbour, double x) {
        return StatedJoint<3>{block, neighbour, {0, 0, -1}, {{x, 0, 1}}};
    };
    assembly.statedJoints = {joint(1, 2, 0), joint(0, 1, 0.1), joint(1, 2, 0.2), joint(0, 1, 0.3)};
    write("constant/assembly/blocks", assemblyText(assembly));
    std::vector<double> places;
    for (const StatedJoint<3>& read : readBlocks<3>(directory).statedJoints)
    {
        places.push_back(read.points[0].x());
    }
    EXPECT_EQ(places, (std::vector<double>{0.1, 0.3, 0, 0.2}));
}

// A second `jointTolerance` made other joints, and the results of the first were said to be of the same
// input.
TEST_F(Zones, OtherJointTolerancesAreOtherStructures)
{
    Assembly<3> assembly = twoCubes();
    assembly.jointTolerance = 0.001;
    write("constant/assembly/blocks", assemblyText(assembly));
    EXPECT_EQ(fingerprint(readBlocks<3>(directory)), fingerprint(assembly));
    Assembly<3> other = assembly;
    other.jointTolerance = 0.002;
    EXPECT_NE(fingerprint(other), fingerprint(assembly));
    EXPECT_NE(fingerprint(twoCubes()), fingerprint(assembly));
}

TEST_F(Zones, JointsOfBlocksThatDoNotExistAreRefused)
{
    for (const auto& [block, neighbour] : {std::pair(0, 2), {-1, 0}, {1, 0}, {1, 1}})
    {
        Assembly<3> assembly = twoCubes();
        assembly.statedJoints = {{block, neighbour, {0, 0, 1}, {{0, 0, 1}}}};
        write("constant/assembly/blocks", assemblyText(assembly));
        EXPECT_THAT(reportOf([&] { readBlocks<3>(directory); }), HasSubstr("Joint 0 is between blocks"));
    }
    Assembly<3> assembly = twoCubes();
    assembly.statedJoints = {{0, 1, {0, 0, 0}, {{0, 0, 1}}}};
    write("constant/assembly/blocks", assemblyText(assembly));
    EXPECT_THAT(reportOf([&] { readBlocks<3>(directory); }), HasSubstr("no direction"));
    assembly.statedJoints = {{0, 1, {0, 0, 1}, {{0, 0, 1}}}};
    std::string text = assemblyText(assembly);
    text.replace(text.find("((0 0 1))"), 9, "()");
    write("constant/assembly/blocks", text);
    EXPECT_THAT(reportOf([&] { readBlocks<3>(directory); }), HasSubstr("no points"));
}

} // namespace
