// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Which columns become one front: all of a dense matrix, those of small bodies that touch, not those of a
/// long band.
#include "linear/Supernodes.h"

#include <gtest/gtest.h>

namespace drystone
{
namespace
{

constexpr int planeRows = 3;

std::vector<Supernode> supernodesOf(int bodies, const std::vector<Coupling>& couplings)
{
    return supernodes(makeFactorPattern(makeBlockPattern(bodies, couplings)).factor, planeRows);
}

std::vector<Coupling> allPairs(int bodies)
{
    std::vector<Coupling> couplings;
    for (int one = 0; one < bodies; ++one)
    {
        for (int other = one + 1; other < bodies; ++other)
        {
            couplings.push_back({one, other});
        }
    }
    return couplings;
}

} // namespace

TEST(Supernodes, OfADenseMatrixThereIsOneWithoutZeros)
{
    const std::vector<Supernode> found = supernodesOf(60, allPairs(60));
    ASSERT_EQ(found.size(), 1U);
    EXPECT_EQ(found.front().firstBody, 0);
    EXPECT_EQ(found.front().lastBody, 60);
    EXPECT_EQ(found.front().bodies, 60);
    EXPECT_EQ(found.front().zeros, 0);
}

TEST(Supernodes, BodiesThatTouchNothingStayAlone)
{
    EXPECT_EQ(supernodesOf(4, {}).size(), 4U);
    EXPECT_TRUE(supernodesOf(0, {}).empty());
}

/// Hard: of a chain two bodies always share a front, for it is narrow, and never all of them.
TEST(Supernodes, OfALongChainFrontsAreNarrowAndFollowEachOther)
{
    constexpr int bodies = 500;
    std::vector<Coupling> chain;
    for (int body = 1; body < bodies; ++body)
    {
        chain.push_back({body - 1, body});
    }
    const std::vector<Supernode> found = supernodesOf(bodies, chain);
    EXPECT_GT(found.size(), 20U);
    EXPECT_LT(found.size(), 500U);
    int next = 0;
    for (const Supernode& front : found)
    {
        EXPECT_EQ(front.firstBody, next);
        next = front.lastBody;
        const int width = front.lastBody - front.firstBody;
        EXPECT_EQ(front.bodies, width + (next < bodies ? 1 : 0)) << "each with the next body below";
    }
    EXPECT_EQ(next, bodies);
}

} // namespace drystone
