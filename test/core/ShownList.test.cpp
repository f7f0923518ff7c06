// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Lists of few items, of as many as are shown, and of more.
#include "core/ShownList.h"

#include <gtest/gtest.h>

#include <vector>

using namespace drystone;

TEST(ShownList, HasAllItemsWhereTheyAreFew)
{
    EXPECT_EQ(shownList(std::vector<int>{}, 2), "");
    EXPECT_EQ(shownList(std::vector<int>{7}, 2), "7");
    EXPECT_EQ(shownList(std::vector<int>{7, 8}, 2), "7, 8");
}

TEST(ShownList, SaysHowManyAreLeftOut)
{
    EXPECT_EQ(shownList(std::vector<int>{7, 8, 9}, 2, " "), "7 8 and 1 more");
    EXPECT_EQ(shownList(std::vector<std::string>(20, "joint"), 3), "joint, joint, joint and 17 more");
}
