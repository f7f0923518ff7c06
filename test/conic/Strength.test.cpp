// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Cones reshaped by cohesion, tension and crushing: closed forms, and the certificate that covers them.
#include "conic/AugmentedLagrangian.h"
#include "conic/Certificate.h"
#include "conic/GaussSeidel.h"
#include "conic/InteriorPoint.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

using namespace drystone;

namespace
{

/// A block of half width b = 1 and weight 2 on fixed ground, its centroid at height h; one point at each end
/// of the base. Live load: a unit horizontal force at the centroid.
PlaneConeProgram standingBlock(double height, double mu, const Strength& strength)
{
    PlaneConeProgram program;
    program.bodies = 1;
    for (const double x : {-1.0, 1.0})
    {
        ConeColumns<3, 2> columns;
        columns.first = 0;
        // Minus the generalised force of n = (0 1) and of t = (1 0) at the arm (x, -h).
        columns.onFirst << 0, -1, -1, 0, -x, -height;
        program.contacts.push_back(columns);
    }
    program.friction = {mu, mu};
    program.strength = {strength, strength};
    program.load = Eigen::Vector3d(0, -2, 0);
    program.liveLoad = Eigen::Vector3d(1, 0, 0);
    return program;
}

double multiplierOf(const PlaneConeProgram& program)
{
    const ConeSolution solution = solveInteriorPoint(program, {.tolerance = 1e-10});
    EXPECT_EQ(solution.status, SolveStatus::optimal);
    EXPECT_LE(certify(program, solution).worst(), 1e-10);
    return solution.multiplier;
}

constexpr double infinite = std::numeric_limits<double>::infinity();

/// Adds a point at x under a body of a tower, with random friction, cohesion and tension.
void addRandomPoint(PlaneConeProgram& program, int body, double x, std::mt19937& random)
{
    std::uniform_real_distribution<double> uniform(0, 1);
    ConeColumns<3, 2> columns;
    columns.first = body;
    columns.onFirst << 0, -1, -1, 0, -x, -0.5;
    if (body > 0)
    {
        columns.second = body - 1;
        columns.onSecond << 0, 1, 1, 0, x, -0.5;
    }
    program.contacts.push_back(columns);
    const double mu = uniform(random) < 0.2 ? 0 : uniform(random);
    const double tension = uniform(random) < 0.5 ? 0 : uniform(random);
    program.friction.push_back(mu);
    program.strength.push_back({mu * tension + (uniform(random) < 0.5 ? 0 : uniform(random)), tension});
}

} // namespace

TEST(Strength, OfNothingLeavesTheCone)
{
    PlaneConeProgram program = standingBlock(2, 0.3, {});
    EXPECT_NEAR(multiplierOf(program), 0.6, 1e-9);
    EXPECT_NEAR(multiplierOf(standingBlock(2, 3, {})), 1, 1e-9);
    program.strength.clear();
    EXPECT_NEAR(multiplierOf(program), 0.6, 1e-9);
}

TEST(Strength, CohesionAddsToTheShearOfABlockThatSlides)
{
    // Sliding: H = mu W + 2 C.
    for (const double mu : {0.0, 1e-12, 1e-3, 0.2})
    {
        EXPECT_NEAR(multiplierOf(standingBlock(1e-3, mu, {.cohesion = 0.7})), 2 * mu + 1.4, 1e-8) << mu;
    }
    // Overturning needs no shear strength: H h = W b.
    EXPECT_NEAR(multiplierOf(standingBlock(10, 0.2, {.cohesion = 0.7})), 0.2, 1e-9);
}

TEST(Strength, TensionHoldsABlockThatOverturns)
{
    // About the far toe: H h = W b + T 2 b.
    for (const double tension : {1e-6, 0.1, 0.5, 20.0})
    {
        EXPECT_NEAR(multiplierOf(standingBlock(10, 0.5, {.cohesion = 100, .tension = tension})),
                    (2 + 2 * tension) / 10, 1e-8);
    }
}

TEST(Strength, CrushingOfTheToeLimitsABlockThatOverturns)
{
    // Two points: the toe carries N at most, the heel the rest: moment about the middle H h = N b - (W - N)
    // b.
    for (const double crushing : {1.001, 1.2, 1.9})
    {
        EXPECT_NEAR(multiplierOf(standingBlock(10, 0.5, {.crushing = crushing})), (2 * crushing - 2) / 10,
                    1e-8);
    }
    for (const double crushing : {2.1, 1e3, 1e6, 1e9})
    {
        EXPECT_NEAR(multiplierOf(standingBlock(10, 0.5, {.crushing = crushing})), 0.2, 1e-8) << crushing;
    }
}

TEST(Strength, OfPointsThatCrushUnderTheDeadLoadIsInfeasible)
{
    const PlaneConeProgram program = standingBlock(10, 0.5, {.crushing = 0.9});
    const ConeSolution solution = solveInteriorPoint(program, {.tolerance = 1e-9});
    EXPECT_EQ(solution.status, SolveStatus::infeasible);
    EXPECT_LE(certify(program, solution).worst(), 1e-9);
}

TEST(Strength, BoundsALoadThatPressesTheBlockDown)
{
    PlaneConeProgram program = standingBlock(1, 0.5, {.crushing = 3});
    program.liveLoad = Eigen::Vector3d(0, -1, 0);
    EXPECT_NEAR(multiplierOf(program), 4, 1e-9);
    for (Strength& strength : program.strength)
    {
        strength.crushing = infinite;
    }
    EXPECT_EQ(solveInteriorPoint(program).status, SolveStatus::unbounded);
}

/// A small stone is crushed by thousands of times its weight. In units of that the forces were not balanced
/// to the tolerance, from some ten thousand times on.
TEST(Strength, OfManyTimesTheWeightIsReached)
{
    for (const double times : {1e3, 1e4, 3e4, 1e5, 3e5, 1e6, 1e7})
    {
        for (const double tolerance : {1e-8, 1e-9, 1e-10})
        {
            SCOPED_TRACE(fmt::format("{} times, to {}", times, tolerance));
            PlaneConeProgram program = standingBlock(1, 0.5, {.crushing = 3 * times});
            program.liveLoad = Eigen::Vector3d(0, -1, 0);
            const ConeSolution crushed = solveInteriorPoint(program, {.tolerance = tolerance});
            EXPECT_EQ(crushed.status, SolveStatus::optimal);
            EXPECT_LE(certify(program, crushed).worst(), tolerance);
            EXPECT_NEAR(crushed.multiplier, 6 * times - 2, 2 * tolerance * 6 * times);

            // Held by its weight alone, before cohesion is needed: h = 0.1, so that it overturns.
            const PlaneConeProgram glued = standingBlock(0.1, 0.5, {.cohesion = times});
            const ConeSolution turned = solveInteriorPoint(glued, {.tolerance = tolerance});
            EXPECT_EQ(turned.status, SolveStatus::optimal);
            EXPECT_LE(certify(glued, turned).worst(), tolerance);
            EXPECT_NEAR(turned.multiplier, 20, 100 * tolerance);
        }
    }
}

TEST(Strength, HoldsAHangingBlockUpToItsTension)
{
    PlaneConeProgram program = standingBlock(1, 0.5, {.cohesion = 5, .tension = 3});
    program.liveLoad = Eigen::Vector3d(0, 1, 0);
    EXPECT_NEAR(multiplierOf(program), 8, 1e-9);
}

TEST(Strength, OfRandomTowersIsCertified)
{
    // Blocks stacked with random strengths: whatever the status, its certificate is there.
    std::mt19937 random(7);
    std::uniform_real_distribution<double> uniform(0, 1);
    int optimal = 0;
    for (int trial = 0; trial < 200; ++trial)
    {
        PlaneConeProgram program;
        program.bodies = 5;
        program.load.setZero(15);
        program.liveLoad.setZero(15);
        for (int body = 0; body < program.bodies; ++body)
        {
            for (const double x : {-1.0, 1.0})
            {
                addRandomPoint(program, body, x, random);
                program.strength.back().crushing = uniform(random) < 0.5 ? infinite : 2 + 4 * uniform(random);
            }
            program.load[3 * body + 1] = -uniform(random);
            program.liveLoad[3 * body] = uniform(random);
        }
        const ConeSolution solution = solveInteriorPoint(program, {.tolerance = 1e-8});
        EXPECT_NE(solution.status, SolveStatus::notConverged) << trial;
        EXPECT_LE(certify(program, solution).worst(), 1e-8) << trial;
        optimal += solution.status == SolveStatus::optimal;
    }
    EXPECT_GT(optimal, 100);
}

TEST(Strength, CertificateSeesAForceBeyondIt)
{
    const PlaneConeProgram program = standingBlock(10, 0.5, {.cohesion = 0.1, .crushing = 1.5});
    const ConeSolution right = solveInteriorPoint(program);
    ASSERT_EQ(right.status, SolveStatus::optimal);
    for (int row = 0; row < 4; ++row)
    {
        ConeSolution wrong = right;
        wrong.contactForce[row] += 0.01;
        EXPECT_GT(certify(program, wrong).worst(), 1e-3);
    }
    ConeSolution wrong = right;
    wrong.displacement *= 1.01;
    EXPECT_GT(certify(program, wrong).worst(), 1e-3);
    wrong = right;
    wrong.multiplier *= 1.01;
    EXPECT_GT(certify(program, wrong).worst(), 1e-3);
}

TEST(Strength, OfStepsInTimeIsTheSameToEverySolver)
{
    std::mt19937 random(11);
    std::uniform_real_distribution<double> uniform(0, 1);
    int moved = 0;
    for (int trial = 0; trial < 100; ++trial)
    {
        PlaneConeProgram program;
        program.bodies = 4;
        program.load.setZero(12);
        for (int body = 0; body < program.bodies; ++body)
        {
            for (const double x : {-1.0, 1.0})
            {
                addRandomPoint(program, body, x, random);
            }
            program.load.segment<3>(3 * body) << 2 * uniform(random) - 1, 2 * uniform(random) - 1.5, 0;
            program.inertia.push_back(Eigen::Vector3d(1, 1, 0.3).asDiagonal());
        }
        const ConeSolution reference = solveInteriorPoint(program, {.tolerance = 1e-9});
        ASSERT_EQ(reference.status, SolveStatus::optimal) << trial;
        const double size = reference.displacement.lpNorm<Eigen::Infinity>();
        moved += size > 1e-3;

        const ConeSolution multipliers = solveAugmentedLagrangian(program, {}, {1e-9});
        ASSERT_EQ(multipliers.status, SolveStatus::optimal) << trial;
        EXPECT_LE(certify(program, multipliers).worst(), 1e-9);
        EXPECT_LE((multipliers.displacement - reference.displacement).lpNorm<Eigen::Infinity>(),
                  1e-4 + 1e-4 * size);
        // From the solution it takes next to nothing.
        const ConeSolution again = solveAugmentedLagrangian(program, multipliers, {1e-9});
        ASSERT_EQ(again.status, SolveStatus::optimal) << trial;
        EXPECT_LE(again.iterations, 3) << trial;

        const ConeSolution sweeps = solveGaussSeidel(program, {}, {1e-6, 20000});
        ASSERT_EQ(sweeps.status, SolveStatus::optimal) << trial;
        EXPECT_LE((sweeps.displacement - reference.displacement).lpNorm<Eigen::Infinity>(),
                  1e-2 + 1e-2 * size);
    }
    EXPECT_GT(moved, 50);
}

TEST(Strength, OfOnePointIsObeyedByTheLeastInItsSet)
{
    // Against a grid over the set.
    std::mt19937 random(3);
    std::uniform_real_distribution<double> uniform(0, 1);
    for (int trial = 0; trial < 50; ++trial)
    {
        const double mu = trial % 5 == 0 ? 0 : uniform(random);
        const double tension = uniform(random);
        const Strength strength{mu * tension + (trial % 3 == 0 ? 0 : uniform(random)), tension,
                                trial % 2 == 0 ? infinite : uniform(random)};
        Eigen::Matrix2d W;
        W << 1 + uniform(random), uniform(random) - 0.5, 0, 1 + uniform(random);
        W(1, 0) = W(0, 1);
        const Eigen::Vector2d b(6 * uniform(random) - 3, 6 * uniform(random) - 3);
        const auto value = [&](const Eigen::Vector2d& c) { return c.dot(0.5 * W * c + b); };
        const Eigen::Vector2d best = leastInSet(W, b, mu, strength);
        EXPECT_GE(best[0], -tension - 1e-12);
        EXPECT_LE(best[0], strength.crushing + 1e-12);
        EXPECT_LE(std::abs(best[1]), strength.cohesion + mu * best[0] + 1e-12);
        const double end = std::min(strength.crushing, 8.0);
        for (int i = 0; i <= 60; ++i)
        {
            const double normal = -tension + (end + tension) * i / 60;
            const double most = std::max(0.0, strength.cohesion + mu * normal);
            for (int j = -20; j <= 20; ++j)
            {
                EXPECT_GE(value({normal, most * j / 20}), value(best) - 1e-12) << trial;
            }
        }
    }
}
