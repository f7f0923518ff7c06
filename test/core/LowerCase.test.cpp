// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Letters only, and only those of English.
#include "core/LowerCase.h"

#include <gtest/gtest.h>

namespace drystone
{

TEST(LowerCase, CapitalsBecomeSmallAndTheRestStays)
{
    EXPECT_EQ(lowerCase("Wall.OBJ"), "wall.obj");
    EXPECT_EQ(lowerCase("already small 123_-"), "already small 123_-");
    EXPECT_EQ(lowerCase(""), "");
}

TEST(LowerCase, BytesOfOtherLettersAreNotTouched)
{
    EXPECT_EQ(lowerCase("\xc3\x84\xff\x80Z"), "\xc3\x84\xff\x80z");
    EXPECT_EQ(lowerCase(std::string_view("A\0B", 3)), std::string("a\0b", 3));
}

} // namespace drystone
