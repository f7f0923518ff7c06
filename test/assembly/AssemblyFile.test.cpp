// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The assembly file: what is written reads back bit by bit, and every fault is named with its line.
#include "assembly/AssemblyFile.h"

#include "../ReportOf.h"
#include "core/Error.h"
#include "texture/Arch.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <random>

using namespace drystone;
using testing::HasSubstr;

namespace
{

/// A case directory of its own for each test, gone afterwards.
class AssemblyFile : public testing::Test
{
protected:
    void SetUp() override
    {
        directory =
            std::filesystem::path(testing::TempDir())
            / ("assembly-" + std::string(testing::UnitTest::GetInstance()->current_test_info()->name()));
        std::filesystem::create_directories(directory / "constant/assembly");
    }
    void TearDown() override { std::filesystem::remove_all(directory); }

    void write(const std::string& text) { std::ofstream(assemblyFile(directory)) << text; }

    /// What is reported of a file with this text.
    std::string report(const std::string& text)
    {
        write(text);
        return reportOf([&] { readBlocks<2>(directory); });
    }

    std::filesystem::path directory;
};

const std::string head = "dimensions 2;\nthickness 1;\nsupports { ground { type ground; blocks (1); } }\n";

TEST_F(AssemblyFile, ReadsBackBitByBit)
{
    std::mt19937 random(3);
    std::uniform_real_distribution<double> uniform(0.5, 1);
    Arch arch;
    arch.angle = 131.7;
    Assembly<2> assembly = makeAssembly(arch);
    for (Block<2>& block : assembly.blocks)
    {
        block.thickness = uniform(random);
    }
    write(assemblyText(assembly));
    const Assembly<2> back = readBlocks<2>(directory);
    ASSERT_EQ(back.blocks.size(), assembly.blocks.size());
    for (std::size_t i = 0; i < back.blocks.size(); ++i)
    {
        EXPECT_EQ(back.blocks[i].outline, assembly.blocks[i].outline);
        EXPECT_EQ(back.blocks[i].thickness, assembly.blocks[i].thickness);
        EXPECT_EQ(back.blocks[i].support, assembly.blocks[i].support);
    }
    ASSERT_EQ(back.supports.size(), 2U);
    EXPECT_EQ(back.supports[1].name, "right");
    EXPECT_EQ(back.supports[1].type, "abutments");
    // And once more from what was read.
    EXPECT_EQ(assemblyText(back), assemblyText(assembly));
}

TEST_F(AssemblyFile, AStructureWithoutSupportsReadsBack)
{
    Assembly<2> assembly{{{{{0, 0}, {1, 0}, {0, 1}}, 0.5}}, {}};
    write(assemblyText(assembly));
    EXPECT_EQ(readBlocks<2>(directory).blocks.front().support, -1);
}

TEST_F(AssemblyFile, OpenFoamReadsIt)
{
    if (std::system("command -v foamDictionary > /dev/null") != 0)
    {
        GTEST_SKIP() << "foamDictionary (Debian package openfoam) is not installed";
    }
    write(assemblyText(makeAssembly(Arch{})));
    const std::string command =
        "WM_PROJECT_DIR=/usr/share/openfoam foamDictionary -entry supports/right/blocks -value "
        + assemblyFile(directory).string() + " | grep -q '28'";
    EXPECT_EQ(std::system(command.c_str()), 0);
}

TEST_F(AssemblyFile, ClockwiseOutlinesAreTurned)
{
    write(head + "outlines ( ((0 0) (0 1) (1 1) (1 0)) ((0 0) (1 0) (1 -1) (0 -1)) );");
    for (const Block<2>& block : readBlocks<2>(directory).blocks)
    {
        EXPECT_DOUBLE_EQ(areaProperties(block.outline).area, 1);
        EXPECT_EQ(block.outline.front(), Vector<2>(0, 0));
    }
}

TEST_F(AssemblyFile, AMissingFileAsksForBlockTexture)
{
    EXPECT_THAT(reportOf([&] { readBlocks<2>(directory); }), HasSubstr("Run blockTexture first"));
}

TEST_F(AssemblyFile, FaultsOfAnOutlineAreNamedWithTheirLine)
{
    const std::string good = "    ((0 0) (1 0) (1 -1) (0 -1))\n";
    for (const auto& [outline, fault] : {
             std::pair("((0 0) (1 0))", "Outline 1 has 2 corners"),
             std::pair("((0 0) (1 1) (1 0) (0 2))", "Outline 1 crosses or touches itself"),
             std::pair("((0 0) (1 1) (2 2))", "Outline 1 has no area"),
             std::pair("((0 0) (1 0) (1 0) (0 1))", "Outline 1 has corners 1 and 2 in the same place"),
         })
    {
        const std::string text = report(head + "outlines\n(\n" + good + "    " + outline + "\n);\n");
        EXPECT_THAT(text, HasSubstr(fault));
        EXPECT_THAT(text, HasSubstr("line 7."));
        EXPECT_THAT(text, HasSubstr("constant/assembly/blocks"));
    }
    EXPECT_THAT(report(head + "outlines\n(\n" + good + "    ((0 0) (nan 0) (1 1))\n);\n"),
                HasSubstr("line 7."));
    EXPECT_THAT(report(head + "outlines\n(\n" + good + "    ((0 0) (1e999 0) (1 1))\n);\n"),
                HasSubstr("line 7."));
}

TEST_F(AssemblyFile, OtherFaultsAreNamed)
{
    const std::string outlines = "outlines ( ((0 0) (1 0) (0 1)) ((0 0) (1 0) (0 -1)) );";
    EXPECT_EQ(report(head + outlines), "no error");
    EXPECT_THAT(report("dimensions 3; thickness 1; supports {}" + outlines), HasSubstr("dimensions 3"));
    EXPECT_THAT(report(head + "outlines ();"), HasSubstr("no block"));
    EXPECT_THAT(report(head + "outlines 3( ((0 0) (1 0) (0 1)) );"), HasSubstr("3"));
    EXPECT_THAT(report("dimensions 2; thickness -1; supports {}" + outlines), HasSubstr("not positive"));
    EXPECT_THAT(report("dimensions 2; thickness (1 2 3); supports {}" + outlines), HasSubstr("3 values"));
    EXPECT_THAT(report("dimensions 2; thickness 1;" + outlines), HasSubstr("supports"));
    EXPECT_THAT(report("dimensions 2; thickness 1; supports { a { type blocks; blocks (2); } }" + outlines),
                HasSubstr("numbered from 0 to 1"));
    EXPECT_THAT(
        report("dimensions 2; thickness 1; supports { a { type blocks; blocks (0); } b { type blocks; blocks "
               "(0); } }"
               + outlines),
        HasSubstr("support a fixes already"));
    EXPECT_THAT(report("dimensions 2; thickness 1; supports { a { type blocks; blocks (0 0); } }" + outlines),
                HasSubstr("Support a names block 0 twice"));
    EXPECT_THAT(report(head + "densty 3;" + outlines), HasSubstr("densty"));
}

TEST_F(AssemblyFile, RandomDamageNeverCrashes)
{
    const std::string sound = assemblyText(makeAssembly(Arch{}));
    std::mt19937 random(17);
    for (int i = 0; i < 500; ++i)
    {
        std::string text = sound;
        for (int hits = std::uniform_int_distribution<int>(1, 4)(random); hits > 0; --hits)
        {
            const auto at = std::uniform_int_distribution<std::size_t>(0, text.size() - 1)(random);
            switch (std::uniform_int_distribution<int>(0, 2)(random))
            {
            case 0:
                text.erase(at, 7);
                break;
            case 1:
                text[at] = "(){};-.9 \"\0/"[std::uniform_int_distribution<int>(0, 11)(random)];
                break;
            default:
                text.insert(at, text.substr(at / 2, 9));
            }
        }
        write(text);
        try
        {
            for (const Block<2>& block : readBlocks<2>(directory).blocks)
            {
                EXPECT_GT(areaProperties(block.outline).area, 0);
            }
        }
        catch (const FatalError& error)
        {
            EXPECT_FALSE(error.report().empty());
        }
    }
}

} // namespace
