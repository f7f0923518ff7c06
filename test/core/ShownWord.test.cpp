// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Words of damaged files as they come into messages.
#include "core/ShownWord.h"

#include <gtest/gtest.h>

using namespace drystone;

TEST(ShownWord, IsShortAndHasNothingThatATerminalActsOn)
{
    EXPECT_EQ(shown("vertex"), "vertex");
    EXPECT_EQ(shown("a\033[2Jb\x7f"), "a?[2Jb?");
    EXPECT_EQ(shown(std::string(41, 'x')), std::string(40, 'x') + "...");
}
