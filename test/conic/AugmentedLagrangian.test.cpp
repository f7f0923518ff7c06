// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The augmented Lagrangian against the interior point and against closed forms, on programs with inertia.
#include "conic/AugmentedLagrangian.h"

#include "Stacks.h"
#include "conic/Certificate.h"
#include "conic/InteriorPoint.h"

#include <gtest/gtest.h>

namespace drystone
{
namespace
{

TEST(AugmentedLagrangian, ABlockThatIsPressedDownStays)
{
    const PlaneConeProgram program = blockOnTwoCorners({0.1, -1, 0}, 0.6);
    const ConeSolution solution = solveAugmentedLagrangian(program, {}, {.tolerance = 1e-12});
    ASSERT_EQ(solution.status, SolveStatus::optimal);
    EXPECT_LT(solution.displacement.lpNorm<Eigen::Infinity>(), 1e-12);
    EXPECT_NEAR(solution.contactForce[0] + solution.contactForce[2], 1, 1e-11);
}

TEST(AugmentedLagrangian, ABlockThatIsLiftedFliesFreely)
{
    const PlaneConeProgram program = blockOnTwoCorners({0.1, 1, 0}, 0.6);
    const ConeSolution solution = solveAugmentedLagrangian(program, {}, {.tolerance = 1e-12});
    ASSERT_EQ(solution.status, SolveStatus::optimal);
    EXPECT_NEAR(solution.displacement[0], 0.05, 1e-13);
    EXPECT_NEAR(solution.displacement[1], 0.5, 1e-13);
    EXPECT_EQ(solution.contactForce.lpNorm<Eigen::Infinity>(), 0);
}

TEST(AugmentedLagrangian, AgreesWithTheInteriorPointOnStacks)
{
    for (unsigned seed = 1; seed <= 20; ++seed)
    {
        const PlaneConeProgram program = randomStack(12, seed);
        // A gap of e bounds the displacements' error by the square root of 2 e, in the norm of inertia.
        const ConeSolution reference = solveInteriorPoint(program, {.tolerance = 1e-11});
        ASSERT_EQ(reference.status, SolveStatus::optimal) << seed;
        const ConeSolution solution = solveAugmentedLagrangian(program, {}, {.tolerance = 1e-11});
        ASSERT_EQ(solution.status, SolveStatus::optimal)
            << seed << ", certificate " << certifyOptimal(program, solution).worst();
        // The displacements are unique, the forces need not be.
        EXPECT_LT((solution.displacement - reference.displacement).lpNorm<Eigen::Infinity>(),
                  1e-5 * reference.displacement.lpNorm<Eigen::Infinity>())
            << seed;
    }
}

TEST(AugmentedLagrangian, StartedFromTheSolutionItNeedsAStepOrTwo)
{
    const PlaneConeProgram program = randomStack(12, 3);
    const ConeSolution cold = solveAugmentedLagrangian(program, {}, {.tolerance = 1e-11});
    ASSERT_EQ(cold.status, SolveStatus::optimal);
    const ConeSolution warm = solveAugmentedLagrangian(program, cold, {.tolerance = 1e-10});
    EXPECT_EQ(warm.status, SolveStatus::optimal);
    EXPECT_LE(warm.factorisations, 2);
    EXPECT_GT(cold.factorisations, 2);
}

TEST(AugmentedLagrangian, UnitsChangeNothing)
{
    PlaneConeProgram program = randomStack(12, 5);
    const ConeSolution solution = solveAugmentedLagrangian(program, {}, {.tolerance = 1e-10});
    program.load *= 1e6;
    for (auto& inertia : program.inertia)
    {
        inertia *= 1e6;
    }
    const ConeSolution scaled = solveAugmentedLagrangian(program, {}, {.tolerance = 1e-10});
    ASSERT_EQ(scaled.status, SolveStatus::optimal);
    EXPECT_LT((solution.displacement - scaled.displacement).lpNorm<Eigen::Infinity>(), 1e-8);
}

TEST(AugmentedLagrangian, SaysSoWhenTheStepsAreTooFew)
{
    const PlaneConeProgram program = randomStack(12, 3);
    const ConeSolution solution =
        solveAugmentedLagrangian(program, {}, {.tolerance = 1e-11, .maximumIterations = 1});
    EXPECT_EQ(solution.status, SolveStatus::notConverged);
}

TEST(AugmentedLagrangian, RefusesAProgramWithoutInertia)
{
    PlaneConeProgram program = blockOnTwoCorners({0.1, -1, 0}, 0.6);
    program.inertia.clear();
    EXPECT_THROW(solveAugmentedLagrangian(program, {}), std::invalid_argument);
}

} // namespace
} // namespace drystone
