// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Steps of few bodies by their active rays are those that the other solvers find, from near and from far, or
/// nothing.
#include "conic/ActiveRays.h"

#include "Stacks.h"
#include "conic/AugmentedLagrangian.h"
#include "conic/Certificate.h"

#include <gtest/gtest.h>

namespace drystone
{
namespace
{

constexpr double tolerance = 1e-10;

ConeSolution fromNothing(const PlaneConeProgram& program)
{
    ConeSolution start;
    start.contactForce = Eigen::VectorXd::Zero(2 * program.points());
    start.displacement = Eigen::VectorXd::Zero(program.load.size());
    return start;
}

/// How many of a hundred stacks were answered, each as the augmented Lagrangian does. \param near whether
/// from its forces
int answered(int bodies, bool near)
{
    int count = 0;
    for (unsigned seed = 1; seed <= 100; ++seed)
    {
        const PlaneConeProgram program = randomStack(bodies, seed);
        const ConeSolution other = solveAugmentedLagrangian(program, {}, exactSettings(200));
        EXPECT_EQ(other.status, SolveStatus::optimal);
        const auto own = solveByActiveRays(program, near ? other : fromNothing(program), tolerance);
        if (own)
        {
            ++count;
            EXPECT_EQ(own->status, SolveStatus::optimal);
            EXPECT_LE(certifyOptimal(program, *own).worst(), tolerance);
            EXPECT_LE((own->displacement - other.displacement).lpNorm<Eigen::Infinity>(), 1e-9) << seed;
        }
    }
    return count;
}

TEST(ActiveRays, StepsAreThoseOfTheAugmentedLagrangian)
{
    // Not answered are those where a body keeps the whole of its base, whose forces are not unique.
    for (const int bodies : {1, 2, 3, 4})
    {
        const int near = answered(bodies, true);
        EXPECT_GE(near, 5) << bodies;
        EXPECT_LE(answered(bodies, false), near) << bodies;
    }
    EXPECT_GE(answered(1, false), 40);
    EXPECT_EQ(answered(5, true), 0) << "more bodies than it is for";
}

// By hand: a block turns about its right corner, at a = (0.5 -1) from its mass centre, so that this moves by
// y = theta (-1 -0.5), and (2 |a|^2 + 0.5) theta = fx ay - fy ax + m.
TEST(ActiveRays, ABlockTurnsAboutItsCorner)
{
    const PlaneConeProgram program = blockOnTwoCorners({1, -2, -1}, 5);
    ConeSolution start = fromNothing(program);
    start.contactForce << 0, 0, 2, -1;
    const auto solution = solveByActiveRays(program, start, tolerance);
    ASSERT_TRUE(solution);
    EXPECT_EQ(solution->iterations, 1);
    EXPECT_LE((solution->displacement - Eigen::Vector3d(1. / 3, 1. / 6, -1. / 3)).norm(), 1e-14);
    EXPECT_LE((solution->contactForce - Eigen::Vector4d(0, 0, 7. / 3, -1. / 3)).norm(), 1e-14);
}

TEST(ActiveRays, WithoutFrictionOnlyTheNormalCarries)
{
    const PlaneConeProgram program = blockOnTwoCorners({1, -2, 0}, 0);
    const auto solution = solveByActiveRays(program, fromNothing(program), tolerance);
    ASSERT_TRUE(solution);
    EXPECT_NEAR(solution->displacement[0], 0.5, 1e-15);
    EXPECT_NEAR(solution->displacement[1], 0, 1e-15);
    EXPECT_EQ(solution->contactForce[1], 0);
    EXPECT_EQ(solution->contactForce[3], 0);
    EXPECT_NEAR(solution->contactForce[0] + solution->contactForce[2], 2, 1e-15);
}

TEST(ActiveRays, ForcesThatAreNotUniqueAreLeftToOthers)
{
    const PlaneConeProgram program = blockOnTwoCorners({0, -2, 0}, 0.5);
    ConeSolution start = fromNothing(program);
    start.contactForce << 1, 0, 1, 0;
    EXPECT_FALSE(solveByActiveRays(program, start, tolerance));
}

} // namespace
} // namespace drystone
