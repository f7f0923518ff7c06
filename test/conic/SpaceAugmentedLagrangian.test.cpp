// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The augmented Lagrangian on round cones: against the interior point, and warm-started.
#include "conic/AugmentedLagrangian.h"
#include "conic/Certificate.h"
#include "conic/InteriorPoint.h"

#include "Towers.h"

#include <gtest/gtest.h>

#include <random>

namespace drystone
{
namespace
{

/// A tower whose boxes are pushed and turned at random, some faces open.
SpaceConeProgram shakenTower(int boxes, unsigned seed)
{
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> symmetric(-1, 1);
    SpaceConeProgram program = spaceStep(evenTower(boxes, 1, 0.5), 0);
    for (Eigen::Index row = 0; row < program.load.size(); ++row)
    {
        program.load[row] += (row % 6 < 3 ? 5 : 1) * symmetric(random);
    }
    for (Eigen::Index row = 0; row < program.gap.size(); row += 3)
    {
        program.gap[row] = 1e-5 * std::max(0.0, symmetric(random));
    }
    return program;
}

TEST(SpaceAugmentedLagrangian, AgreesWithTheInteriorPoint)
{
    for (unsigned seed = 1; seed <= 20; ++seed)
    {
        const SpaceConeProgram program = shakenTower(6, seed);
        const ConeSolution reference = solveInteriorPoint(program, {.tolerance = 1e-10});
        ASSERT_EQ(reference.status, SolveStatus::optimal)
            << seed << ", certificate " << certifyOptimal(program, reference).worst();
        const ConeSolution solution =
            solveAugmentedLagrangian(program, {}, {.tolerance = 1e-11, .maximumIterations = 200});
        ASSERT_EQ(solution.status, SolveStatus::optimal)
            << seed << ", certificate " << certifyOptimal(program, solution).worst();
        EXPECT_LT((solution.displacement - reference.displacement).lpNorm<Eigen::Infinity>(),
                  1e-4 * reference.displacement.lpNorm<Eigen::Infinity>())
            << seed;
    }
}

TEST(SpaceAugmentedLagrangian, StartedFromTheSolutionItNeedsAStepOrTwo)
{
    const SpaceConeProgram program = shakenTower(6, 3);
    const ConeSolution cold = solveAugmentedLagrangian(program, {}, {.tolerance = 1e-11});
    ASSERT_EQ(cold.status, SolveStatus::optimal);
    const ConeSolution warm = solveAugmentedLagrangian(program, cold, {.tolerance = 1e-9});
    EXPECT_EQ(warm.status, SolveStatus::optimal);
    EXPECT_LE(warm.factorisations, 2);
    EXPECT_GT(cold.factorisations, 4);
}

TEST(SpaceAugmentedLagrangian, ABoxInTheAirFallsFreely)
{
    SpaceConeProgram program = spaceStep(evenTower(1), 0.2);
    program.gap[0] = program.gap[3] = program.gap[6] = program.gap[9] = 0.1;
    const ConeSolution solution = solveAugmentedLagrangian(program, {}, {.tolerance = 1e-12});
    ASSERT_EQ(solution.status, SolveStatus::optimal);
    EXPECT_NEAR(solution.displacement[2], -9.81 * 0.002 * 0.002, 1e-16);
    EXPECT_EQ(solution.contactForce.lpNorm<Eigen::Infinity>(), 0);
}

TEST(SpaceAugmentedLagrangian, SaysSoWhenTheStepsAreTooFew)
{
    const ConeSolution solution =
        solveAugmentedLagrangian(shakenTower(6, 3), {}, {.tolerance = 1e-11, .maximumIterations = 1});
    EXPECT_EQ(solution.status, SolveStatus::notConverged);
}

TEST(SpaceAugmentedLagrangian, RefusesLimitAnalysis)
{
    EXPECT_THROW(solveAugmentedLagrangian(spaceLimitAnalysis(evenTower(1)), {}), std::invalid_argument);
}

} // namespace
} // namespace drystone
