// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The exchanges between forces and mechanism, by a block on the ground whose pairs are known by hand.
#include "statics/CoulombExchange.h"
#include "Structures.h"
#include "conic/InteriorPoint.h"
#include "statics/PairRefinement.h"
#include "statics/StepFromRest.h"

#include <gtest/gtest.h>

namespace drystone
{
namespace
{

constexpr double slidingFriction = 0.3;

/// A block 1 x 1 on the ground, pushed to the right with alpha of its weight 1000 N.
PlaneConeProgram pushedBlock(double friction)
{
    Assembly<2> assembly;
    assembly.supports = {{"ground", "ground"}};
    assembly.blocks = {rectangle(0, 0, 1, 1), rectangle(-1, -1, 2, 0, 0)};
    const WeighedStructure structure(std::move(assembly));
    return structure.program(friction, structure.weightLoads());
}

ConeSolution solved(const PlaneConeProgram& program)
{
    return solveInteriorPoint(program);
}

/// The pair of the associative collapse, which for a block on two points is one of Coulomb's law but for the
/// mechanism.
CoulombPair collapseOf(const PlaneConeProgram& program)
{
    const ConeSolution collapse = solveInteriorPoint(program);
    return {collapse.multiplier, collapse.contactForce, collapse.displacement, {}};
}

TEST(CoulombExchange, ForcesAtTheLimitAllowABlockToSlide)
{
    const PlaneConeProgram program = pushedBlock(slidingFriction);
    const CoulombPair collapse = collapseOf(program);
    const auto mechanism = mechanismOf<3, 2>(program, collapse.contactForce, solved);
    ASSERT_TRUE(mechanism);
    EXPECT_NEAR((*mechanism)[0] * 1000, 1, 1e-6) << "unit work of the live load";
    EXPECT_NEAR((*mechanism)[1], 0, 1e-9) << "without opening";
    EXPECT_NEAR((*mechanism)[2], 0, 1e-9);
    EXPECT_LE(coulombResiduals(program, collapse.alpha, collapse.contactForce, *mechanism).worst(), 1e-6);
}

TEST(CoulombExchange, WhatForcesInsideTheirLimitsAreSaidToAllowIsNoPair)
{
    const PlaneConeProgram program = pushedBlock(slidingFriction);
    const Eigen::Vector4d resting(500, 0, 500, 0);
    const auto mechanism = mechanismOf<3, 2>(program, resting, solved);
    if (mechanism)
    {
        EXPECT_GT(coulombResiduals(program, 0, resting, *mechanism).worst(), 1e-2);
    }
}

TEST(CoulombExchange, TheLeastMultiplierOfSlidingIsTheFriction)
{
    const PlaneConeProgram program = pushedBlock(slidingFriction);
    CoulombPair pair = collapseOf(program);
    pair.mechanism = Eigen::Vector3d(1e-3, 0, 0);
    const auto least = leastPair<3, 2>(program, pair, solved);
    ASSERT_TRUE(least);
    EXPECT_NEAR(least->pair.alpha, slidingFriction, 1e-8);
    EXPECT_LE(coulombResiduals(program, least->pair.alpha, least->pair.contactForce, pair.mechanism).worst(),
              1e-6);
    // Backwards it slides at the opposite load: no forces at those limits balance a push that is positive.
    pair.mechanism *= -1;
    const auto backwards = leastPair<3, 2>(program, pair, solved);
    ASSERT_TRUE(backwards);
    EXPECT_NEAR(backwards->pair.alpha, -slidingFriction, 1e-8);
}

TEST(CoulombExchange, RockingIsOneOfItsPairsWhereFrictionIsLarge)
{
    // It turns about its right corner at alpha = 1, at which all of its weight is.
    const PlaneConeProgram program = pushedBlock(2);
    const CoulombPair collapse = collapseOf(program);
    EXPECT_NEAR(collapse.alpha, 1, 1e-8);
    const auto least = leastPair<3, 2>(program, collapse, solved);
    ASSERT_TRUE(least);
    EXPECT_NEAR(least->pair.alpha, 1, 1e-6);
    EXPECT_FALSE((otherMechanism<3, 2>(program, *least, solved))) << "nothing is in the way of a lower one";
}

/// Hard: a pair that is off by a thousandth in all its numbers comes back to its last digits.
TEST(PairRefinement, APairNearbyIsTakenToItsLastDigits)
{
    constexpr double ofRefinement = 1e-10; // ten times the error of the equations at which it ends
    const PlaneConeProgram program = pushedBlock(slidingFriction);
    CoulombPair pair = collapseOf(program);
    pair.mechanism = Eigen::Vector3d(1e-3, 0, 0);
    const CoulombPair exact = *refinedPair(program, pair, 1e-3);
    EXPECT_LE(coulombResiduals(program, exact.alpha, exact.contactForce, exact.mechanism).worst(),
              ofRefinement);
    pair.alpha *= 1.001;
    pair.contactForce *= 0.999;
    pair.mechanism += 1e-6 * Eigen::Vector3d(1, -1, 0.5);
    const auto refined = refinedPair(program, pair, 1e-2);
    ASSERT_TRUE(refined);
    EXPECT_NEAR(refined->alpha, slidingFriction, ofRefinement);
    EXPECT_LE(coulombResiduals(program, refined->alpha, refined->contactForce, refined->mechanism).worst(),
              ofRefinement);
    EXPECT_FALSE(refinedPair(program, pair, 1e-2, [] { return true; }));
}

/// Motion from rest of a block that slides begins at its friction, unless there is no time to find that.
TEST(StepFromRest, EndsWhereItIsAskedTo)
{
    const PlaneConeProgram program = pushedBlock(slidingFriction);
    const Eigen::Vector4d resting(500, 0, 500, 0);
    const auto isPair = [&program](CoulombPair& pair)
    { return coulombResiduals(program, pair.alpha, pair.contactForce, pair.mechanism).worst() <= 1e-6; };
    int whole = 0;
    int asks = 0;
    const auto pair =
        pairFromRest<3, 2>(program, slidingFriction, resting, isPair, whole, [&asks] { return ++asks < 0; });
    ASSERT_TRUE(pair);
    EXPECT_NEAR(pair->alpha, slidingFriction, 1e-6);
    for (int most = 0; most < asks; ++most)
    {
        int asked = 0;
        int factorisations = 0;
        EXPECT_FALSE((pairFromRest<3, 2>(program, slidingFriction, resting, isPair, factorisations,
                                         [&] { return asked++ >= most; })));
        EXPECT_LE(factorisations, most);
        EXPECT_LT(factorisations, whole);
    }
}

} // namespace
} // namespace drystone
