// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// system/blockTextureDict: structures from dictionaries, and each fault reported with its line.
#include "../MadeStructure.h"
#include "../ReportOf.h"
#include "contact/ContactPoint.h"
#include "texture/Texture.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

using namespace drystone;
using testing::AllOf;
using testing::HasSubstr;

namespace
{

Assembly<2> structure(const std::string& text)
{
    return madeStructure(Dictionary::readString(text, "system/blockTextureDict"));
}

std::string report(const std::string& text)
{
    return reportOf([&] { structure(text); });
}

const std::string bond = "texture { type runningBond; unit (0.4 0.175); length 5; courses 6;";
const std::string ground = "supports { ground { type ground; segment 0.5; } }";

TEST(BlockTextureDict, TheSixWallsOfTheTutorialHaveTheBlocksAndPointsOfThePaper)
{
    const int blocks[] = {33, 55, 46, 55, 61, 146};
    const int points[] = {174, 290, 212, 240, 244, 702};
    for (int wall = 0; wall < 6; ++wall)
    {
        const std::filesystem::path file = std::filesystem::path(DRYSTONE_SOURCE_DIR)
                                           / "tutorials/limitAnalysis/masonryPanels"
                                           / ("wall" + std::to_string(wall + 1)) / "system/blockTextureDict";
        const Assembly<2> assembly = madeStructure(Dictionary::readFile(file));
        EXPECT_EQ(std::count_if(assembly.blocks.begin(), assembly.blocks.end(),
                                [](const Block<2>& block) { return block.support < 0; }),
                  blocks[wall]);
        EXPECT_EQ(findContactPoints(assembly).size(), points[wall]);
        EXPECT_EQ(assembly.supports.front().name, "ground");
    }
}

// With `ground { type import; }` the blocks of the layer ground alone were fixed, and an arch on two
// abutments that its file marks was unstable.
TEST(BlockTextureDict, SupportsOfAFileThatStayFreeAreWarnedOf)
{
    const auto warningOf = [](const std::string& supports)
    {
        const std::string text =
            "dimensions 3; texture { type import; file \"structures/wall_assembly.json\"; } ";
        testing::internal::CaptureStderr();
        makeStructure<3>(Dictionary::readString(text + supports, "system/blockTextureDict"),
                         std::filesystem::path(DRYSTONE_SOURCE_DIR)
                             / "tutorials/limitAnalysis/space/importedAssemblies");
        return testing::internal::GetCapturedStderr();
    };
    EXPECT_EQ(warningOf("supports { base { type import; } }"), "");
    EXPECT_EQ(warningOf("supports { base { type import; layers (is_support); } }"), "");
    EXPECT_THAT(warningOf("supports { pier { type blocks; blocks (20); } }"),
                AllOf(HasSubstr("layers (is_support)"), HasSubstr("supports at line 1")));
}

TEST(BlockTextureDict, DimensionsThatAreMistypedAreNamedWhereTheTextureIsOneOfSpace)
{
    const std::string boxes = "texture { type boxes; blocks (((0 0 0) (1 1 1))); }";
    EXPECT_THAT(report(boxes), HasSubstr("boxes is one of space"));
    EXPECT_THAT(report("dimensions 2; " + boxes), HasSubstr("boxes is one of space"));
    EXPECT_THAT(report("\ndmiensions 3; " + boxes),
                AllOf(HasSubstr("dmiensions"), HasSubstr("Did you mean dimensions?"), HasSubstr("line 2")));
}

TEST(BlockTextureDict, SegmentAndMarginAreInUnitsAndASegmentIsOptional)
{
    const Assembly<2> split = structure(bond + "}" + ground);
    EXPECT_EQ(split.blocks.size(), 33U + 10);
    EXPECT_EQ(findContactPoints(split).size(), 174U);
    const Assembly<2> whole = structure(bond + "} supports { base { type ground; margin 2; } }");
    ASSERT_EQ(whole.blocks.size(), 34U);
    EXPECT_DOUBLE_EQ(whole.blocks.back().outline[0].x(), -0.8);
    EXPECT_EQ(whole.supports.front().name, "base");
    EXPECT_EQ(structure(bond + "}").supports.size(), 0U);
}

TEST(BlockTextureDict, ASupportOfNoBlockIsWarnedOf)
{
    testing::internal::CaptureStderr();
    structure(bond + "} supports {\nfeet { type blocks;\nblocks (); } }");
    EXPECT_THAT(testing::internal::GetCapturedStderr(),
                AllOf(HasSubstr("The support feet holds no block"), HasSubstr("feet/blocks at line 3.")));
}

TEST(BlockTextureDict, BlocksAreFixedByIndex)
{
    const Assembly<2> assembly =
        structure("texture { type polygons; blocks ( ((0 0) (1 0) (1 1)) ((0 0) (1 1) (0 1)) ); } "
                  "supports { abutments { type blocks; blocks (1); } }");
    EXPECT_EQ(assembly.blocks[0].support, -1);
    EXPECT_EQ(assembly.blocks[1].support, 0);
    EXPECT_EQ(findContactPoints(assembly).size(), 2U);
}

TEST(BlockTextureDict, AnArchBringsItsAbutmentsUnlessAGroundTakesTheirPlace)
{
    const std::string arch =
        "texture { type arch; profile circular; radius 1; thickness 0.15; voussoirs 27; ";
    EXPECT_EQ(structure(arch + "depth 1; angle 180; }").supports.size(), 2U);
    const Assembly<2> onGround = structure(arch + "} supports { ground { type ground; } }");
    EXPECT_EQ(onGround.blocks.size(), 28U);
    EXPECT_EQ(onGround.supports.size(), 1U);
    EXPECT_EQ(findContactPoints(onGround).size(), 56U);
    EXPECT_THAT(report(arch + "angle 200; } supports { ground { type ground; } }"), HasSubstr("below y = 0"));
    // Fixed blocks of the texture may be added.
    EXPECT_EQ(structure(arch + "} supports { middle { type blocks; blocks (13); } }").supports.size(), 3U);
}

TEST(BlockTextureDict, AMistypedTypeIsNamedWithTheValidOnes)
{
    EXPECT_EQ(report("dimensions 2;\ntexture\n{\n    type runingBond;\n}\n"),
              "--> DRYSTONE FATAL IO ERROR:\n"
              "Unknown texture type runingBond. Did you mean runningBond?\n\n"
              "Valid texture types: arch courses image import polygons rubble runningBond\n\n"
              "file: system/blockTextureDict/texture/type at line 4.\n\nDRYSTONE exiting\n");
    EXPECT_THAT(report(bond + "} supports { a { type grund; } }"), HasSubstr("Did you mean ground?"));
}

TEST(BlockTextureDict, FaultsOfARunningBondAreNamed)
{
    EXPECT_EQ(report(bond + "}"), "no error");
    const auto fault = [](const std::string& settings, const std::string& message)
    {
        EXPECT_THAT(report("texture\n{\ntype runningBond;\n" + settings + "\n}"),
                    AllOf(HasSubstr(message), HasSubstr("system/blockTextureDict")))
            << settings;
    };
    fault("unit (0.4 0.175); length 5;", "courses");
    fault("unit (0.4 -0.175); length 5; courses 6;", "unit");
    fault("unit 0.4; length 5; courses 6;", "unit");
    fault("unit (0.4 0.175); length nan; courses 6;", "length");
    fault("unit (0.4 0.175); length five; courses 6;", "five");
    fault("unit (0.4 0.175); length 5; courses 6.5;", "6.5");
    fault("unit (0.4 0.175); length 5; courses 0;", "courses");
    fault("unit [0 0 1 0 0 0 0] (0.4 0.175); length 5; courses 6;", "[0 1 0 0 0 0 0]");
    fault("unit (0.4 0.175); length 5; courses 6; firstCourse quarter;", "half");
    fault("unit (0.4 0.175); length 5; courses 6; opennings ();", "openings");
    fault("unit (0.4 0.175); length 1e5; courses 100000;", "more than 10000000 blocks");
    const std::string wall = "unit (0.4 0.175); length 5; courses 6; openings ";
    fault(wall + "( { from (1 6); to (2 7); } );", "reaches outside the wall");
    // The documented example: six courses, an opening drawn for more.
    EXPECT_EQ(report("texture\n{\ntype runningBond;\n" + wall + "( { from (1.5 3); to (2.5 8); } );\n}"),
              "no error");
    fault(wall + "( { from (1 2); to (5.1 4); } );", "reaches outside the wall");
    fault(wall + "( { from (2 2); to (1 4); } );", "has no area");
    fault(wall + "( { from (1 2.5); to (2 4); } );", "within a course");
    fault(wall + "( { from (1 2); } );", "to");
    fault(wall + "( { from (0 0); to (5 6); } );", "no block");
}

TEST(BlockTextureDict, FaultsOfOtherTexturesAreNamed)
{
    EXPECT_THAT(report("texture { type courses; unit (1 1); rows ((1 0 1)); }"), HasSubstr("length 0"));
    EXPECT_THAT(report("texture { type courses; unit (1 1); rows (); }"), HasSubstr("no block"));
    EXPECT_THAT(report("texture { type courses; unit (1 1); rows ((-1)); }"), HasSubstr("no block"));
    EXPECT_THAT(report("texture { type polygons; blocks (); }"), HasSubstr("no block"));
    EXPECT_THAT(
        report(
            "texture\n{\ntype polygons;\nblocks\n(\n((0 0) (1 0) (1 1))\n((0 0) (1 1) (1 0) (0 1))\n);\n}"),
        AllOf(HasSubstr("Outline 1 crosses or touches itself"), HasSubstr("line 7.")));
    EXPECT_THAT(report("texture { type arch; radius 1; thickness 2; voussoirs 9; }"),
                HasSubstr("below twice the radius"));
    EXPECT_THAT(report("texture { type arch; radius 1; thickness 0.1; voussoirs 1; }"),
                HasSubstr("more voussoirs"));
    EXPECT_THAT(report("texture { type arch; profile pointd; radius 1; thickness 0.1; voussoirs 9; }"),
                HasSubstr("circular"));
    const std::string arch = "texture { type arch; radius 1; thickness 0.1; ";
    EXPECT_THAT(report(arch + "voussoirs 9; profile pointed; offset 0.3; }"), HasSubstr("even number"));
    EXPECT_THAT(report(arch + "voussoirs 8; profile pointed; }"), HasSubstr("offset"));
    // It was a block that crossed itself, whose lengths were to be corrected.
    const std::string pointed =
        "texture { type arch; radius 1; thickness 0.12; profile pointed; offset 0.3; ";
    EXPECT_EQ(report(pointed + "voussoirs 124; }"), "no error");
    EXPECT_THAT(report(pointed + "voussoirs 126; }"), HasSubstr("give at most 124 voussoirs"));
    EXPECT_THAT(report(arch + "voussoirs 8; profile pointed; offset 1; }"), HasSubstr("inner radius"));
    EXPECT_THAT(report(arch + "voussoirs 8; offset 0.3; }"), HasSubstr("Only a pointed arch"));
    EXPECT_THAT(report(arch + "voussoirs 8; profile elliptic; }"), HasSubstr("rise above 0"));
    EXPECT_THAT(report(arch + "voussoirs 8; profile elliptic; rise 0.2; }"), HasSubstr("sharpest"));
    EXPECT_THAT(report(arch + "voussoirs 8; profile elliptic; rise 0.5; angle 120; }"),
                HasSubstr("Only a circular arch"));
    EXPECT_THAT(report(bond + " openings ( { from (1 2); to (2 6); lintel 0.5; } ); }"),
                HasSubstr("no course above"));
    EXPECT_THAT(report(bond + " openings ( { from (0.2 2); to (2 5); lintel 0.5; } ); }"),
                HasSubstr("past an end"));
    EXPECT_THAT(report("dimensions 3; " + bond + "}"), HasSubstr("Only dimensions 2"));
    EXPECT_THAT(report("dimensions 2;"), HasSubstr("texture"));
}

TEST(BlockTextureDict, FaultsOfSupportsAreNamed)
{
    EXPECT_THAT(report(bond + "} supports { a { type blocks; blocks (33); } }"),
                HasSubstr("numbered from 0 to 32"));
    EXPECT_THAT(report(bond + "} supports { a { type blocks; blocks (0); } b { type blocks; blocks (0); } }"),
                HasSubstr("by support a"));
    EXPECT_THAT(report(bond + "} supports { a { type ground; segment 0; } }"), HasSubstr("segment"));
    EXPECT_THAT(report(bond + "} supports { a { type ground; segment 1e-9; } }"),
                HasSubstr("more than 10000000"));
    EXPECT_THAT(report(bond + "} supports { a { type ground; } b { type ground; } }"),
                HasSubstr("a ground already"));
    EXPECT_THAT(
        report("texture { type polygons; blocks ( ((0 -1) (1 0) (1 1)) ); } supports { a { type ground; } }"),
        HasSubstr("Block 0 reaches below y = 0"));
}

// A support that was measured reaches under the ground by what counts as a joint; a free block may not.
TEST(BlockTextureDict, SupportsMayReachUnderTheGroundByTheToleranceOfJoints)
{
    const std::string block = "texture { type polygons; blocks ( ((0 -1e-5) (1 -1e-5) (1 1) (0 1)) ); } ";
    const std::string fixed = "a { type blocks; blocks (0); }";
    const std::string slab = "b { type ground; }";
    EXPECT_EQ(structure(block + "jointTolerance 1e-4; supports { " + fixed + slab + " }").blocks.size(), 2u);
    EXPECT_THAT(report(block + "jointTolerance 1e-6; supports { " + fixed + slab + " }"),
                testing::AllOf(HasSubstr("Block 0 reaches below y = 0"), HasSubstr("leave the ground out")));
    EXPECT_THAT(report(block + "jointTolerance 1e-4; supports { " + slab + " }"),
                HasSubstr("Block 0 reaches below y = 0"));
}

} // namespace
