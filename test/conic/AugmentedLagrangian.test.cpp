// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The augmented Lagrangian against the interior point and against closed forms, on programs with inertia.
#include "conic/AugmentedLagrangian.h"
#include "conic/Certificate.h"
#include "conic/InteriorPoint.h"

#include <gtest/gtest.h>

#include <random>

namespace drystone
{
namespace
{

/// Columns of a point at `arm` from the mass centre of the body it presses up on, against fixed ground.
ConeColumns<3, 2> standingOn(int body, double armX, double armY)
{
    ConeColumns<3, 2> columns;
    columns.first = body;
    columns.onFirst << 0, -1, -1, 0, -armX, armY;
    return columns;
}

/// A block on two corners under (fx fy m), its inertia 2, 2 and 0.5.
PlaneConeProgram blockOnTwoCorners(const Eigen::Vector3d& load, double mu)
{
    PlaneConeProgram program;
    program.bodies = 1;
    program.contacts = {standingOn(0, -0.5, -1), standingOn(0, 0.5, -1)};
    program.friction = {mu, mu};
    program.load = load;
    program.inertia = {Eigen::Vector3d(2, 2, 0.5).asDiagonal()};
    program.gap = Eigen::VectorXd::Zero(4);
    return program;
}

/// A stack of bodies, each on two points of the one below, pushed about at random.
PlaneConeProgram randomStack(int bodies, unsigned seed)
{
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> symmetric(-1, 1);
    PlaneConeProgram program;
    program.bodies = bodies;
    program.load = Eigen::VectorXd::Zero(3 * bodies);
    for (int body = 0; body < bodies; ++body)
    {
        for (const double x : {-0.5, 0.5})
        {
            ConeColumns<3, 2> columns = standingOn(body, x, -0.5);
            columns.second = body - 1;
            columns.onSecond = -standingOn(body, x, 0.5).onFirst;
            program.contacts.push_back(columns);
            program.friction.push_back(0.5);
        }
        program.load.segment<3>(3 * body) << symmetric(random), -1 + symmetric(random),
            0.3 * symmetric(random);
        program.inertia.push_back(Eigen::Vector3d(1, 1, 0.2).asDiagonal());
    }
    program.gap = Eigen::VectorXd::Zero(4 * bodies);
    for (Eigen::Index row = 0; row < program.gap.size(); row += 2)
    {
        program.gap[row] = 0.1 * std::max(0.0, symmetric(random));
    }
    return program;
}

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
