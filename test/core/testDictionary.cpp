// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Dictionaries: the grammar, macros and directives, typed reading, and messages.
#include "core/Dictionary.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace drystone
{
namespace
{

const char* const blockTexture = R"(
FoamFile { version 2.0; format ascii; class dictionary; object blockTextureDict; }
dimensions 2;
texture
{
    type        runningBond;
    unit        (0.4 0.175);   // length of a full block, height of a course [m]
    thickness   1;             /* out of plane */
    courses     6;
    openings    ( { from (1.5 3); to (2.5 8); } );
}
supports { ground { type ground; segment 0.5; } }
)";

TEST(Dictionary, ReadsTheBlockTextureOfTheContract)
{
    const Dictionary dictionary = Dictionary::readString(blockTexture, "system/blockTextureDict");
    EXPECT_EQ(dictionary.get<int>("dimensions"), 2);
    const Dictionary& texture = dictionary.subDict("texture");
    EXPECT_EQ(texture.get<std::string>("type"), "runningBond");
    EXPECT_EQ((texture.get<std::array<double, 2>>("unit")), (std::array{0.4, 0.175}));
    EXPECT_EQ(texture.getOrDefault<double>("thickness", 2), 1);
    EXPECT_EQ(texture.getOrDefault<double>("absent", 2), 2);
    const auto openings = texture.get<std::vector<Dictionary>>("openings");
    ASSERT_EQ(openings.size(), 1U);
    EXPECT_EQ((openings[0].get<std::array<double, 2>>("to")), (std::array{2.5, 8.0}));
    EXPECT_EQ(texture.lookup("courses").location().line, 9);
    EXPECT_EQ(texture.lookup("courses").location().entry, "texture/courses");
}

} // namespace
} // namespace drystone
