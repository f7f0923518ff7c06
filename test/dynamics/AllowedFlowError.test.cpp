// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// When further programs of a step bring Coulomb's law no nearer.
#include "dynamics/AllowedFlowError.h"

#include <gtest/gtest.h>

#include <cmath>

namespace drystone
{
namespace
{

// Errors as a house of 70 blocks has them, of which one in a hundred of what the step changes is not met.
TEST(MissedFlow, HasStalledWhereErrorsSwingAndTheMotionStays)
{
    std::vector<MissedFlow> programs{
        {1.6e-6, 8.3e-6}, {1.4e-6, 8.6e-6}, {2.2e-6, 8.5e-6}, {7.3e-7, 8.6e-6}, {1.6e-7, 8.6e-6}};
    EXPECT_FALSE(hasStalled(programs)); // it has just become less
    programs.push_back({2.0e-7, 8.6e-6});
    EXPECT_FALSE(hasStalled(programs));
    programs.push_back({2.1e-7, 8.6e-6});
    EXPECT_FALSE(hasStalled(programs)); // the least of the last three against that of those before
    programs.push_back({2.0e-7, 8.6e-6});
    EXPECT_TRUE(hasStalled(programs));
}

TEST(MissedFlow, HasNotStalledWhereErrorsFallOrAMotionBegins)
{
    std::vector<MissedFlow> falling;
    std::vector<MissedFlow> beginning;
    for (int program = 0; program < 12; ++program)
    {
        falling.push_back({std::pow(0.7, program), 1});
        beginning.push_back({std::pow(1.2, program), std::pow(1.2, program)});
        EXPECT_FALSE(hasStalled(falling)) << program;
        EXPECT_FALSE(hasStalled(beginning)) << program;
    }
}

} // namespace
} // namespace drystone
