// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Blocks of the plane and of space: their numbering and their mass properties.
#include "assembly/Assembly.h"

#include <gtest/gtest.h>

using namespace drystone;

namespace
{

TEST(Assembly, ABlockOfThePlaneAndTheBoxWithItsThicknessHaveTheSameMass)
{
    const Block<2> plane{{{0, 0}, {0.4, 0}, {0.4, 0.175}, {0, 0.175}}, 0.3};
    const Block<3> space{makeBox({0, 0, 0}, {0.4, 0.3, 0.175})};
    EXPECT_NEAR(blockMass(space).volume, blockMass(plane).volume, 1e-16);
    EXPECT_NEAR(blockMass(space).centroid.x(), blockMass(plane).centroid.x(), 1e-16);
    EXPECT_NEAR(blockMass(space).centroid.z(), blockMass(plane).centroid.y(), 1e-16);
    // The plane's x-y is x-z in space: its rotation is about y.
    EXPECT_NEAR(blockMass(space).inertia(1, 1), blockMass(plane).inertia(0, 0), 1e-16);
}

TEST(Assembly, FreeBlocksOfSpaceAreNumberedInTheirOrder)
{
    Assembly<3> assembly;
    assembly.supports = {{"base", "blocks"}};
    for (int support : {-1, 0, -1})
    {
        assembly.blocks.push_back({makeBox({0, 0, 0}, {1, 1, 1}), support});
    }
    EXPECT_EQ(freeIndices(assembly), (std::vector<int>{0, -1, 1}));
}

} // namespace
