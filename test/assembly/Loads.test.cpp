// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Load vectors against hand calculations.
#include "assembly/Loads.h"

#include <gtest/gtest.h>

using namespace drystone;

namespace
{

Polygon rectangle(double x0, double y0, double x1, double y1)
{
    return {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}};
}

/// A fixed block first, so that block and free indices differ.
Assembly<2> twoOnGround()
{
    return {{{rectangle(-9, -1, 9, 0), 1, 0}, {rectangle(0, 0, 1, 2)}, {rectangle(1, 0, 3, 1)}},
            {{"ground", "ground"}}};
}

TEST(Loads, GravityActsOnFreeBlocksAtTheirCentroids)
{
    const Eigen::VectorXd load = gravityLoad(twoOnGround(), {7, 2, 3}, {0, -10});
    const Eigen::VectorXd expected = (Eigen::VectorXd(6) << 0, -20, 0, 0, -30, 0).finished();
    EXPECT_EQ(load, expected);
}

TEST(Loads, InertialLoadIsTheOwnWeightWhateverTheLengthOfTheDirection)
{
    for (const double length : {1e-3, 1.0, 1e3})
    {
        const Eigen::VectorXd load = inertialLoad(twoOnGround(), {7, 2, 3}, {0, -10}, {length, 0});
        EXPECT_NEAR(load(0), 20, 1e-13);
        EXPECT_NEAR(load(3), 30, 1e-13);
        EXPECT_EQ(load(1), 0);
    }
}

TEST(Loads, AForceHasItsMomentAboutTheCentroid)
{
    const Assembly<2> assembly = twoOnGround();
    EXPECT_EQ(findLoadedBlock(assembly, {2.5, 1}, 1e-6), 2);
    const Eigen::VectorXd load = pointLoad(assembly, 2, {2.5, 1}, {3, -4});
    // Arm (0.5 0.5) from the centroid (2 0.5): moment 0.5 (-4) - 0.5 3.
    const Eigen::VectorXd expected = (Eigen::VectorXd(6) << 0, 0, 0, 3, -4, -3.5).finished();
    EXPECT_EQ(load, expected);
}

TEST(Loads, APointOnNoFreeBlockLoadsNone)
{
    const Assembly<2> assembly = twoOnGround();
    EXPECT_FALSE(findLoadedBlock(assembly, {5, -0.5}, 0.01)); // the ground is fixed
    EXPECT_FALSE(findLoadedBlock(assembly, {2, 1.1}, 0.01));
    EXPECT_EQ(findLoadedBlock(assembly, {2, 1.005}, 0.01), 2);
    EXPECT_EQ(findLoadedBlock(assembly, {0.5, 1.5}, 0.01), 1);
    EXPECT_EQ(findLoadedBlock(assembly, {1, 0.5}, 0.01), 1); // on the edge of both: the first
}

} // namespace

TEST(Loads, OfALineAreSharedByTheBlocksThatItCrosses)
{
    // Along y = 0.5 from x = 0.5 to 2: half a metre on the first free block, one on the second.
    const auto load = lineLoad(twoOnGround(), {0.5, 0.5}, {2, 0.5}, {0, -10}, 1e-3);
    ASSERT_TRUE(load);
    const Eigen::VectorXd expected = (Eigen::VectorXd(6) << 0, -5, -5 * 0.25, 0, -10, 10 * 0.5).finished();
    EXPECT_LT((*load - expected).lpNorm<Eigen::Infinity>(), 1e-12);
    // Backwards the same, and over the top of a block too; not where there is none.
    EXPECT_LT(
        (*lineLoad(twoOnGround(), {2, 0.5}, {0.5, 0.5}, {0, -10}, 1e-3) - expected).lpNorm<Eigen::Infinity>(),
        1e-12);
    EXPECT_NEAR((*lineLoad(twoOnGround(), {0, 2}, {1, 2}, {0, -10}, 1e-3))[1], -10, 1e-12);
    EXPECT_FALSE(lineLoad(twoOnGround(), {0, 2}, {1.5, 2}, {0, -10}, 1e-3));
    EXPECT_FALSE(lineLoad(twoOnGround(), {-5, -0.5}, {-4, -0.5}, {0, -10}, 1e-3));
}
