// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Bisection to the last bit, and to a number of halvings.
#include "core/Bisection.h"

#include <gtest/gtest.h>

#include <cmath>

namespace drystone
{

TEST(Bisection, FindsWhereAConditionChangesToTheLastBit)
{
    const double root = bisected(1, 2, [](double value) { return value * value < 2; });
    EXPECT_GE(root * root, 2);
    EXPECT_LT(std::pow(std::nextafter(root, 0.0), 2), 2);
    EXPECT_EQ(bisected(0, 1, [](double value) { return value < 1e-300; }), 1e-300);
}

TEST(Bisection, EndsAfterTheHalvingsThatItIsGiven)
{
    int calls = 0;
    const auto isBelow = [&calls](double value)
    {
        ++calls;
        return value < 0.3;
    };
    EXPECT_EQ(bisected(0, 1, isBelow, 2), 0.5);
    EXPECT_EQ(calls, 2);
}

TEST(Bisection, WithoutAChangeGivesTheEnd)
{
    EXPECT_EQ(bisected(0, 1, [](double) { return true; }), 1);
}

} // namespace drystone
