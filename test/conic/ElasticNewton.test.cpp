// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Steps whose points all give way: by hand, in the limit of rigid points, and what it is not for.
#include "conic/ElasticNewton.h"

#include "Stacks.h"
#include "conic/AugmentedLagrangian.h"
#include "conic/Certificate.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace drystone
{
namespace
{

PlaneConeProgram yielding(PlaneConeProgram program, double compliance)
{
    program.compliance = Eigen::VectorXd::Constant(2 * program.points(), compliance);
    return program;
}

TEST(ElasticNewton, ABlockSinksUntilItsPointsCarryIt)
{
    // Mbar y + 2 y / C = -w for the rise y of the mass centre: Mbar = 2 and two points.
    constexpr double compliance = 1e-3;
    constexpr double weight = 10;
    const PlaneConeProgram program = yielding(lowBlock(0, weight, 0.5), compliance);
    const ConeSolution solution = solveElasticNewton(program, {}, {1e-12, 50});
    ASSERT_EQ(solution.status, SolveStatus::optimal);
    const double sunk = weight / (2 + 2 / compliance);
    EXPECT_NEAR(solution.displacement[1], -sunk, 1e-14);
    EXPECT_NEAR(solution.contactForce[0], sunk / compliance, 1e-10);
    EXPECT_NEAR(solution.contactForce[2], sunk / compliance, 1e-10);
    EXPECT_NEAR(solution.contactForce[1], 0, 1e-10);
}

TEST(ElasticNewton, ABlockThatIsPushedTooHardSlides)
{
    const PlaneConeProgram program = yielding(lowBlock(8, 10, 0.3), 1e-6);
    const ConeSolution solution = solveElasticNewton(program, {}, {1e-11, 50});
    ASSERT_EQ(solution.status, SolveStatus::optimal);
    for (const int point : {0, 1})
    {
        const double normal = solution.contactForce[2 * point];
        EXPECT_NEAR(std::abs(solution.contactForce[2 * point + 1]), 0.3 * normal, 1e-8) << point;
    }
    EXPECT_GT(std::abs(solution.displacement[0]), 0.1);
}

TEST(ElasticNewton, ABlockThatIsLiftedTouchesNothing)
{
    const PlaneConeProgram program = yielding(lowBlock(0, -4, 0.3), 1e-6);
    const ConeSolution solution = solveElasticNewton(program, {}, {1e-11, 50});
    ASSERT_EQ(solution.status, SolveStatus::optimal);
    EXPECT_TRUE(solution.contactForce.isZero(0));
    EXPECT_NEAR(solution.displacement[1], 2, 1e-12);
}

/// Hard: forces are overlaps over the compliance, so that rounding leaves 1e-16 / C of them, and Newton's
/// steps from afar pass through many sets of points that touch.
TEST(ElasticNewton, PointsThatHardlyGiveWayAreNearlyRigid)
{
    constexpr double compliance = 1e-6;
    for (unsigned seed = 1; seed <= 30; ++seed)
    {
        const PlaneConeProgram rigid = randomStack(6, seed);
        const ConeSolution other = solveAugmentedLagrangian(rigid, {}, exactSettings(200));
        ASSERT_EQ(other.status, SolveStatus::optimal) << seed;
        const PlaneConeProgram program = yielding(rigid, compliance);
        ConeSolution far;
        far.displacement = Eigen::VectorXd::Constant(program.load.size(), 5);
        for (const ConeSolution& start : {ConeSolution(), far})
        {
            const ConeSolution solution = solveElasticNewton(program, start, {1e-9, 500});
            ASSERT_EQ(solution.status, SolveStatus::optimal) << seed;
            EXPECT_LE(certifyOptimal(program, solution).worst(), 1e-9) << seed;
            // Forces are of the order of ten loads of one.
            EXPECT_LE((solution.displacement - other.displacement).lpNorm<Eigen::Infinity>(),
                      100 * compliance)
                << seed;
        }
    }
}

TEST(ElasticNewton, EndsWithTheLastIterateWhenStepsAreUsedUp)
{
    const ConeSolution solution = solveElasticNewton(yielding(lowBlock(8, 10, 0.3), 1e-6), {}, {1e-11, 0});
    EXPECT_EQ(solution.status, SolveStatus::notConverged);
    EXPECT_EQ(solution.displacement.size(), 3);
    EXPECT_EQ(solution.contactForce.size(), 4);
}

TEST(ElasticNewton, RefusesWhatIsNotElastic)
{
    const PlaneConeProgram rigid = lowBlock(0, 1, 0.5);
    EXPECT_THROW(solveElasticNewton(rigid, {}), std::invalid_argument);
    PlaneConeProgram partly = yielding(rigid, 1e-3);
    partly.compliance[3] = 0;
    EXPECT_THROW(solveElasticNewton(partly, {}), std::invalid_argument);
    PlaneConeProgram atRest = yielding(rigid, 1e-3);
    atRest.inertia.clear();
    EXPECT_THROW(solveElasticNewton(atRest, {}), std::invalid_argument);
    PlaneConeProgram bonded = yielding(rigid, 1e-3);
    bonded.strength.resize(2);
    EXPECT_THROW(solveElasticNewton(bonded, {}), std::invalid_argument);
}

} // namespace
} // namespace drystone
