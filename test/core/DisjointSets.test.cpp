// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Sets that are joined pair by pair, in any order.
#include "core/DisjointSets.h"

#include <gtest/gtest.h>

namespace drystone
{

TEST(DisjointSets, EachIsAloneToBeginWith)
{
    DisjointSets sets(3);
    for (const int member : {0, 1, 2})
    {
        EXPECT_EQ(sets.firstOf(member), member);
    }
}

TEST(DisjointSets, AreNamedAfterTheirLeastMember)
{
    DisjointSets sets(6);
    sets.join(5, 3);
    sets.join(3, 4);
    EXPECT_EQ(sets.firstOf(5), 3);
    EXPECT_EQ(sets.firstOf(4), 3);
    EXPECT_EQ(sets.firstOf(2), 2);
    sets.join(4, 1);
    EXPECT_EQ(sets.firstOf(5), 1);
}

TEST(DisjointSets, JoiningWithOneselfOrTwiceChangesNothing)
{
    DisjointSets sets(3);
    sets.join(1, 1);
    sets.join(1, 2);
    sets.join(2, 1);
    EXPECT_EQ(sets.firstOf(2), 1);
    EXPECT_EQ(sets.firstOf(0), 0);
}

/// Hard: a chain from its far end, whose paths would be as long as it is.
TEST(DisjointSets, ALongChainIsOneSet)
{
    constexpr int members = 100000;
    DisjointSets sets(members);
    for (int member = members - 1; member > 0; --member)
    {
        sets.join(member, member - 1);
    }
    for (const int member : {0, 1, members / 2, members - 1})
    {
        EXPECT_EQ(sets.firstOf(member), 0);
    }
}

} // namespace drystone
