// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The assembly file in space: what is written reads back bit by bit, and what a hand can mistype is named
/// with its line.
#include "../ReportOf.h"
#include "assembly/AssemblyFile.h"
#include "assembly/Materials.h"
#include "core/Error.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <random>

using namespace drystone;
using testing::AllOf;
using testing::HasSubstr;

namespace
{

class SpaceAssemblyFile : public testing::Test
{
protected:
    void SetUp() override
    {
        directory =
            std::filesystem::path(testing::TempDir())
            / ("spaceAssembly-" + std::string(testing::UnitTest::GetInstance()->current_test_info()->name()));
        std::filesystem::create_directories(directory / "constant/assembly");
    }
    void TearDown() override { std::filesystem::remove_all(directory); }

    void write(const std::string& text) { std::ofstream(assemblyFile(directory)) << text; }

    template<int Dim = 3>
    std::string report(const std::string& text)
    {
        write(text);
        return reportOf([&] { readBlocks<Dim>(directory); });
    }

    std::filesystem::path directory;
};

const std::string spaceHead = "dimensions 3;\nsupports { }\nblocks\n(\n";
const std::string vertices =
    "{ vertices ((0 0 0) (1 0 0) (1 1 0) (0 1 0) (0 0 1) (1 0 1) (1 1 1) (0 1 1));\n";

std::string box(const std::string& faces = "(0 3 2 1)\n(4 5 6 7)\n(0 1 5 4)\n(1 2 6 5)\n(2 3 7 6)\n(3 0 4 7)")
{
    return spaceHead + vertices + "faces (\n" + faces + "\n); }\n);\n";
}

TEST_F(SpaceAssemblyFile, ReadsBackBitByBit)
{
    std::mt19937 random(3);
    std::uniform_real_distribution<double> uniform(0.5, 1);
    Assembly<3> assembly;
    for (int i = 0; i < 20; ++i)
    {
        const Vector<3> lower(uniform(random), uniform(random), uniform(random));
        assembly.blocks.push_back(
            {makeBox(lower, lower + Vector<3>(uniform(random), uniform(random), uniform(random))),
             i % 3 == 0 ? 0 : -1});
    }
    assembly.supports = {{"ground", "ground"}};
    assembly.jointTolerance = 1e-5;
    write(assemblyText(assembly));
    EXPECT_EQ(assemblyDimensions(directory), 3);
    const Assembly<3> back = readBlocks<3>(directory);
    ASSERT_EQ(back.blocks.size(), assembly.blocks.size());
    for (std::size_t i = 0; i < back.blocks.size(); ++i)
    {
        EXPECT_EQ(back.blocks[i].shape, assembly.blocks[i].shape) << i;
        EXPECT_EQ(back.blocks[i].support, assembly.blocks[i].support) << i;
    }
    EXPECT_EQ(back.jointTolerance, assembly.jointTolerance);
    EXPECT_EQ(blockPlaces<3>(directory).size(), assembly.blocks.size());
}

TEST_F(SpaceAssemblyFile, ASoundBlockIsRead)
{
    EXPECT_EQ(report(box()), "no error");
}

TEST_F(SpaceAssemblyFile, AFaceThatIsTurnedIsNamedWithItsLine)
{
    EXPECT_THAT(report(box("(0 3 2 1)\n(4 5 6 7)\n(4 5 1 0)\n(1 2 6 5)\n(2 3 7 6)\n(3 0 4 7)")),
                AllOf(HasSubstr("Block 0 is not a solid"), HasSubstr("turned inside"), HasSubstr("line"),
                      HasSubstr("seen from outside")));
    EXPECT_THAT(report(box("(1 2 3 0)\n(7 6 5 4)\n(4 5 1 0)\n(5 6 2 1)\n(6 7 3 2)\n(7 4 0 3)")),
                HasSubstr("all its faces are turned inside"));
}

TEST_F(SpaceAssemblyFile, AMissingFaceAndAWrongIndexAreNamed)
{
    EXPECT_THAT(report(box("(0 3 2 1)\n(4 5 6 7)\n(0 1 5 4)\n(1 2 6 5)\n(2 3 7 6)")),
                HasSubstr("it is not closed: the edge of face"));
    EXPECT_THAT(report(box("(0 3 2 1)\n(4 5 6 7)\n(0 1 5 8)\n(1 2 6 5)\n(2 3 7 6)\n(3 0 4 7)")),
                AllOf(HasSubstr("face 2 has the vertex 8"), HasSubstr("line 9")));
    EXPECT_THAT(report(box("(0 3 2 1)\n(4 5 6 7)\n(0 1 5.5 4)")), HasSubstr("line 9"));
}

TEST_F(SpaceAssemblyFile, AVertexNeedsThreeComponents)
{
    EXPECT_THAT(
        report(
            spaceHead
            + "{ vertices ((0 0 0)\n(1 0)\n(1 1 0) (0 1 0)); faces ((0 1 2) (0 1 3) (1 2 3) (0 2 3)); } );"),
        AllOf(HasSubstr("2 numbers, but 3 are expected"), HasSubstr("z (up)"), HasSubstr("line 6")));
}

TEST_F(SpaceAssemblyFile, KeysAreChecked)
{
    EXPECT_THAT(report(spaceHead + "{ vertixes ((0 0 0)); faces ((0 1 2)); } );"), HasSubstr("vertices"));
    EXPECT_THAT(report(box() + "thickness 1;\n"), HasSubstr("thickness"));
    EXPECT_THAT(report("dimensions 3;\nsupports { }\nblocks ();\n"), HasSubstr("no block"));
    EXPECT_THAT(report("dimensions 4;\nsupports { }\nblocks ();\n"), HasSubstr("2 is the plane, 3 is space"));
    EXPECT_THAT(report("dimensions 2;\nthickness 1;\nsupports { }\noutlines (((0 0) (1 0) (0 1)));\n"),
                HasSubstr("in the plane (dimensions 2), not in space"));
}

TEST_F(SpaceAssemblyFile, MotionOfACaseInSpaceIsRefused)
{
    EXPECT_THAT(report<2>(box()),
                AllOf(HasSubstr("in space (dimensions 3), not in the plane"), HasSubstr("line 1")));
}

TEST_F(SpaceAssemblyFile, GravityHasThreeComponentsAndPointsDown)
{
    const auto gravity = [&](const std::string& text)
    {
        std::ofstream(directory / "constant/g") << text;
        return reportOf([&] { readGravity<3>(directory); });
    };
    EXPECT_EQ(gravity("value (0 0 -9.81);"), "no error");
    EXPECT_THAT(gravity("value (0 -9.81);"), HasSubstr("3 are expected"));
}

} // namespace
