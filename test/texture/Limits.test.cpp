// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The limit of the number of blocks, in all textures of space that count them.
#include "texture/Limits.h"
#include "../MadeStructure.h"
#include "../ReportOf.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

using namespace drystone;
using testing::HasSubstr;

namespace
{

std::string reportOfTexture(const std::string& texture)
{
    return reportOf(
        [&]
        {
            madeStructure<3>(Dictionary::readString("dimensions 3; texture { " + texture + " }",
                                                    "system/blockTextureDict"));
        });
}

TEST(Limits, TheLargestStructureIsNoneTooLarge)
{
    EXPECT_EQ(countFault(maximumBlocks, "A wall"), "");
    EXPECT_EQ(countFault(maximumBlocks + 1.0, "A wall"),
              "A wall has more than 10000000 blocks: make it smaller.");
}

// One limit for all that count blocks, before any is made.
TEST(Limits, MoreBlocksThanAStructureHasAreRefusedAtOnce)
{
    const std::string many = "more than 10000000 blocks: make it smaller";
    std::string axes;
    for (int i = 0; i < 1001; ++i)
    {
        axes += fmt::format("({} 0) ", i);
    }
    const std::string arch = "radius 1; thickness 0.1; ";
    EXPECT_THAT(reportOfTexture("type barrelVault; " + arch + "voussoirs 5000; length 1; slices 2001;"),
                HasSubstr("A vault of 5000 voussoirs by 2001 slices has " + many));
    EXPECT_THAT(reportOfTexture("type barrelVault; " + arch + "voussoirs 10000000; length 1;"),
                HasSubstr("give at most 31415."));
    EXPECT_THAT(reportOfTexture("type extrusion; of { type arch; " + arch + "voussoirs 10000000; }"),
                HasSubstr("10000000 voussoirs are 3.1e-07 m thin, in an arch that is 0.1 m thick"));
    EXPECT_THAT(reportOfTexture(
                    "type tower; around 100000; courses 101; innerRadius 1; outerRadius 2; courseHeight 1;"),
                HasSubstr(many));
    EXPECT_THAT(reportOfTexture("type dome; " + arch
                                + "around 1000; rows 9000; cap 10; drum { height 1; courses 1001; }"),
                HasSubstr(many));
    EXPECT_THAT(reportOfTexture("type column; radius 0.3; drums 10000; drumHeight 1; at (" + axes + ");"),
                HasSubstr(many));
    EXPECT_THAT(
        reportOfTexture("type walls; unit (0.24 0.12 0.08); bond flemish; courses 4000; walls { wall { from "
                        "(0 0); length 1000; } }"),
        HasSubstr("This plan of walls has " + many));
}

} // namespace
