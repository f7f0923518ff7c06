// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// What certificates prove, and what they must not.
#include "conic/Certificate.h"

#include "Stacks.h"
#include "conic/InteriorPoint.h"

#include <gtest/gtest.h>

#include <cmath>

namespace drystone
{
namespace
{

/// A body beside a wall without friction, pushed against it by alpha, a gap away.
PlaneConeProgram besideAWall(double gap)
{
    PlaneConeProgram program;
    program.bodies = 1;
    ConeColumns<3, 2> columns;
    columns.first = 0;
    columns.onFirst << 1, 0, 0, 1, 0, 0;
    program.contacts = {columns};
    program.friction = {0};
    program.load = Eigen::VectorXd::Zero(3);
    program.liveLoad = Eigen::Vector3d(1, 0, 0);
    program.gap = Eigen::Vector2d(gap, 0);
    return program;
}

TEST(Certificate, ARayIsUnboundedOnlyWhereItGainsMoreThanGapsCost)
{
    // The objective is alpha - g alpha along the ray.
    const Eigen::VectorXd ray = Eigen::Vector2d(1, 0);
    EXPECT_EQ(certifyUnbounded(besideAWall(0), ray).worst(), 0);
    EXPECT_EQ(certifyUnbounded(besideAWall(0.5), ray).worst(), 0);
    EXPECT_EQ(certifyUnbounded(besideAWall(-3), ray).worst(), 0);
    EXPECT_TRUE(std::isinf(certifyUnbounded(besideAWall(1), ray).worst()));
    EXPECT_TRUE(std::isinf(certifyUnbounded(besideAWall(2), ray).worst()));
    PlaneConeProgram soft = besideAWall(0);
    soft.compliance = Eigen::VectorXd::Constant(2, 0.1);
    EXPECT_TRUE(std::isinf(certifyUnbounded(soft, ray).worst()));
}

TEST(Certificate, GapsDoNotHideThatNothingBalancesALoad)
{
    // It falls straight down beside the wall, whose gap it never closes.
    PlaneConeProgram program = besideAWall(0.1);
    program.friction = {0.05};
    program.load = Eigen::Vector3d(0, -1, 0);
    program.liveLoad.resize(0);
    const ConeSolution solution = solveInteriorPoint(program, {});
    EXPECT_EQ(solution.status, SolveStatus::infeasible);
    EXPECT_LE(certify(program, solution).worst(), 1e-9);
}

} // namespace
} // namespace drystone
