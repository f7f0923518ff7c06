// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Finite rotations of the plane and of space.
#include "geometry/Rotation.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <numbers>
#include <random>

using namespace drystone;

TEST(Rotation, RotationVectorsOfSpaceAreThoseOfMatrices)
{
    std::mt19937 random(1);
    std::normal_distribution<double> normal;
    const auto draw = [&] { return Vector<3>(normal(random), normal(random), normal(random)); };
    const auto matrixOf = [](const Vector<3>& turn)
    { return Eigen::AngleAxisd(turn.norm(), turn.normalized()).toRotationMatrix(); };
    for (int i = 0; i < 1000; ++i)
    {
        const double size = std::pow(10.0, -8 * (i % 3) / 2.0);
        const Vector<3> first = size * draw();
        const Vector<3> then = draw();
        const Vector<3> arm = draw();
        EXPECT_LT((turned(first, arm) - matrixOf(first) * arm).norm(), 1e-14 * 10);
        EXPECT_LT((swing(first, arm) - (turned(first, arm) - arm)).norm(), 1e-14);
        EXPECT_LT((turned(composed(first, then), arm) - matrixOf(then) * (matrixOf(first) * arm)).norm(),
                  1e-13);
        EXPECT_LT((turned(composed(first, turnBetween(first, then)), arm) - turned(then, arm)).norm(), 1e-13);
        EXPECT_LE(composed(first, then).norm(), std::numbers::pi * (1 + 1e-15));
    }
    EXPECT_EQ(turned(Vector<3>(0, 0, 0), Vector<3>(1, 2, 3)), Vector<3>(1, 2, 3));
    // A small turn keeps its digits.
    EXPECT_DOUBLE_EQ(swing(Vector<3>(0, 0, 1e-12), Vector<3>(1, 0, 0)).y(), 1e-12);
}

TEST(Rotation, ThePlaneIsSpaceAboutZ)
{
    for (const double turn : {-3.0, -1e-9, 0.0, 0.3, 2.0})
    {
        const Vector<2> arm(0.7, -0.2);
        const Vector<3> inSpace(arm.x(), arm.y(), 0);
        const Vector<3> about(0, 0, turn);
        EXPECT_LT((turned(turn, arm) - turned(about, inSpace).head<2>()).norm(), 1e-15);
        EXPECT_LT((swing(turn, arm) - swing(about, inSpace).head<2>()).norm(), 1e-15);
        EXPECT_EQ(velocityOfArm(turn, arm), velocityOfArm(about, inSpace).head<2>());
        EXPECT_EQ(turnBetween(0.5, composed(0.5, turn)), turn + 0.5 - 0.5);
    }
}
