// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// What everybody reads of a cone program: gaps, strengths and sizes, where they are stated and where not.
#include "conic/ConeProgram.h"

#include "Stacks.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace drystone
{
namespace
{

TEST(ConeProgram, GapsThatAreNotStatedAreZero)
{
    PlaneConeProgram program = lowBlock(0, 1, 0.5);
    program.gap = Eigen::Vector4d(0.1, 0, 0.2, 0);
    EXPECT_EQ(gapOf(program), program.gap);
    program.gap.resize(0);
    EXPECT_EQ(gapOf(program), Eigen::Vector4d::Zero());
    EXPECT_EQ(gapOf(SpaceConeProgram{}).size(), 0);
}

TEST(ConeProgram, ABlockThatIsLiftedLeavesAGap)
{
    PlaneConeProgram program = lowBlock(0, 1, 0.5);
    program.gap.resize(0);
    const Eigen::Vector4d after = gapAfter(program, Eigen::Vector3d(0, 0.01, 0));
    EXPECT_NEAR(after[0], 0.01, 1e-15);
    EXPECT_NEAR(after[2], 0.01, 1e-15);
    EXPECT_EQ(after[1], 0);
    program.gap = Eigen::Vector4d(0.5, 0, 0, 0);
    EXPECT_NEAR(gapAfter(program, Eigen::Vector3d(0, 0.01, 0))[0], 0.51, 1e-15);
    // Turned counter-clockwise it lifts its right corner by half its width for each radian.
    EXPECT_NEAR(gapAfter(program, Eigen::Vector3d(0, 0, 0.01))[2], 0.005, 1e-15);
}

TEST(ConeProgram, PointsWithoutStrengthHaveNone)
{
    PlaneConeProgram program = lowBlock(0, 1, 0.5);
    EXPECT_FALSE(program.strengthOf(1).isBond());
    EXPECT_FALSE(program.strengthOf(1).isBounded());
    program.strength = {{3, 1, 50}, {}};
    EXPECT_EQ(program.strengthOf(0).cohesion, 3);
    EXPECT_TRUE(program.strengthOf(0).isBounded());
    EXPECT_FALSE(program.strengthOf(1).isBond());
}

TEST(ConeProgram, TheLargestRowWeighsMomentsByTheirFactor)
{
    const Eigen::VectorXd plane{{1, -3, 8, 0, 0, -20}};
    EXPECT_EQ((largestRow<3, 2>(plane, 0.1)), 3);
    EXPECT_EQ((largestRow<3, 2>(plane, 0.5)), 10);
    // In space three rows are forces: the same numbers are one body.
    EXPECT_EQ((largestRow<6, 3>(plane, 0.1)), 8);
    EXPECT_EQ((largestRow<3, 2>(Eigen::VectorXd(), 1)), 0);
}

TEST(ConeProgram, TheLargestOfRowsThatAreNoNumbersIsInfinite)
{
    Eigen::VectorXd rows = Eigen::VectorXd::Ones(6);
    rows[5] = std::nan("");
    EXPECT_EQ((largestRow<3, 2>(rows, 1)), std::numeric_limits<double>::infinity());
    rows[5] = -std::numeric_limits<double>::infinity();
    EXPECT_EQ((largestRow<3, 2>(rows, 1)), std::numeric_limits<double>::infinity());
}

} // namespace
} // namespace drystone
