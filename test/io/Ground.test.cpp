// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Ground is what a support of that type fixes, and nothing else that is fixed.
#include "io/Ground.h"

#include <gtest/gtest.h>

namespace drystone
{

TEST(Ground, IsWhatASupportOfThatTypeFixes)
{
    Assembly<2> assembly;
    assembly.supports = {{"base", "ground"}, {"abutment", "blocks"}};
    assembly.blocks.resize(3);
    assembly.blocks[0].support = 0;
    assembly.blocks[1].support = 1;
    EXPECT_TRUE(isGround(assembly, assembly.blocks[0]));
    EXPECT_FALSE(isGround(assembly, assembly.blocks[1])) << "an abutment has the extent that it has";
    EXPECT_FALSE(isGround(assembly, assembly.blocks[2])) << "a free block";
}

TEST(Ground, ASupportOfAnotherTypeIsNoneWhateverItsName)
{
    Assembly<3> assembly;
    assembly.supports = {{"ground", "blocks"}};
    assembly.blocks.resize(1);
    assembly.blocks[0].support = 0;
    EXPECT_FALSE(isGround(assembly, assembly.blocks[0]));
}

} // namespace drystone
