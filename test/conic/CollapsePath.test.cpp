// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Paths to collapse of towers whose ends are known in closed form, what such an end is, and what a path
/// refuses.
#include "conic/coulomb/CollapsePath.h"

#include "Towers.h"
#include "conic/InteriorPoint.h"

#include <gtest/gtest.h>

namespace drystone
{
namespace
{

/// Forces that carry the dead load.
template<int Rows, int Forces>
Eigen::VectorXd resting(ConeProgram<Rows, Forces> program)
{
    program.liveLoad.resize(0);
    return solveInteriorPoint(program).contactForce;
}

/// The end is a pair by the words of the header.
template<int Rows, int Forces>
void expectPair(const ConeProgram<Rows, Forces>& program, const CollapsePair& pair)
{
    const double largest = pair.contactForce.template lpNorm<Eigen::Infinity>();
    const Eigen::VectorXd load = program.load + pair.multiplier * program.liveLoad;
    EXPECT_LE((applyEquilibrium(program, pair.contactForce) - load).template lpNorm<Eigen::Infinity>(),
              1e-9 * largest);
    const Eigen::VectorXd closing = applyTransposed(program, pair.mechanism);
    const double rate = closing.template lpNorm<Eigen::Infinity>();
    for (int point = 0; point < program.points(); ++point)
    {
        const double normal = pair.contactForce[Forces * point];
        const auto shear = pair.contactForce.template segment<Forces - 1>(Forces * point + 1);
        const double limit = program.friction[static_cast<std::size_t>(point)] * normal;
        const double opening = -closing[Forces * point];
        const auto slip = closing.template segment<Forces - 1>(Forces * point + 1);
        EXPECT_GE(normal, -1e-9 * largest);
        EXPECT_LE(shear.norm(), limit + 1e-9 * largest);
        EXPECT_GE(opening, -1e-7 * rate);
        EXPECT_LE(std::min(opening / rate, normal / largest), 1e-6);
        EXPECT_NEAR(shear.dot(slip), limit * slip.norm(), 1e-6 * largest * rate);
    }
}

/// Boxes 1 wide and 0.5 high: they slide at mu where that is less than what overturns the whole.
template<typename Program>
void expectTowersToCollapse(Program (*programOf)(const Tower&), int most)
{
    for (int boxes = 1; boxes <= most; ++boxes)
    {
        for (const double mu : {0.1, 0.3, 0.7})
        {
            SCOPED_TRACE(testing::Message() << boxes << " boxes, friction " << mu);
            const Program program = programOf(evenTower(boxes, 1, mu));
            const CollapsePair pair = followCollapsePath(program, resting(program), 0);
            ASSERT_EQ(pair.end, PathEnd::collapse);
            EXPECT_NEAR(pair.multiplier, std::min(mu, 2.0 / boxes), 1e-7);
            EXPECT_NEAR(program.liveLoad.dot(pair.mechanism), 1, 1e-9);
            expectPair(program, pair);
        }
    }
}

} // namespace

TEST(CollapsePath, EndsWhereTowersOfThePlaneSlideOrOverturn)
{
    expectTowersToCollapse(planeLimitAnalysis, 5);
}

TEST(CollapsePath, EndsWhereTowersOfSpaceSlideOrOverturn)
{
    expectTowersToCollapse(spaceLimitAnalysis, 2);
}

TEST(CollapsePath, WhatCarriesAnyLoadDoesNotCollapse)
{
    // Pushed straight down, a box presses the ground: nothing but elasticity moves.
    PlaneConeProgram program = planeLimitAnalysis(evenTower(1));
    program.liveLoad = program.load;
    EXPECT_EQ(followCollapsePath(program, resting(program), 0).end, PathEnd::unfinished);
}

TEST(CollapsePath, RefusesWhatIsNotDeadAndLiveLoadAlone)
{
    const PlaneConeProgram program = planeLimitAnalysis(evenTower(2));
    const Eigen::VectorXd forces = resting(program);
    PlaneConeProgram other = program;
    other.gap = Eigen::VectorXd::Zero(2 * program.points());
    EXPECT_THROW(followCollapsePath(other, forces, 0), std::invalid_argument);
    other = program;
    other.liveLoad.resize(0);
    EXPECT_THROW(followCollapsePath(other, forces, 0), std::invalid_argument);
    other = program;
    other.inertia.assign(2, Eigen::Matrix3d::Identity());
    EXPECT_THROW(followCollapsePath(other, forces, 0), std::invalid_argument);
    other = program;
    other.compliance = Eigen::VectorXd::Ones(2 * program.points());
    EXPECT_THROW(followCollapsePath(other, forces, 0), std::invalid_argument);
}

TEST(CollapsePath, ElasticityHasNoPartInAnEndThatIsUnique)
{
    const PlaneConeProgram program = planeLimitAnalysis(evenTower(3, 0.5, 0.4));
    const Eigen::VectorXd forces = resting(program);
    const double alpha = followCollapsePath(program, forces, 0).multiplier;
    for (unsigned seed = 1; seed <= 5; ++seed)
    {
        const CollapsePair pair =
            followCollapsePath(program, forces, 0, {.stiffnessSpread = 2, .seed = seed});
        ASSERT_EQ(pair.end, PathEnd::collapse);
        EXPECT_NEAR(pair.multiplier, alpha, 1e-9);
    }
}

TEST(CollapsePath, EndsWhereItIsAskedTo)
{
    const PlaneConeProgram program = planeLimitAnalysis(evenTower(3, 0.5, 0.4));
    const Eigen::VectorXd forces = resting(program);
    const CollapsePair whole = followCollapsePath(program, forces, 0);
    ASSERT_EQ(whole.end, PathEnd::collapse);
    ASSERT_GT(whole.pieces, 2);
    for (int pieces = 0; pieces <= whole.pieces + 1; ++pieces)
    {
        int asked = 0;
        CollapsePathSettings settings;
        settings.isOver = [&] { return asked++ == pieces; };
        const CollapsePair pair = followCollapsePath(program, forces, 0, settings);
        EXPECT_EQ(pair.end, pieces <= whole.pieces ? PathEnd::stopped : PathEnd::collapse) << pieces;
        EXPECT_EQ(pair.pieces, std::min(pieces, whole.pieces));
        EXPECT_LE(pair.factorisations, whole.factorisations);
    }
}

TEST(CollapsePath, DilatancyOpensWhatSlidesAndCanBeTakenAwayAgain)
{
    const double mu = 0.3;
    const PlaneConeProgram program = planeLimitAnalysis(evenTower(1, 1, mu));
    const Eigen::VectorXd forces = resting(program);
    const CollapsePair dilating =
        followCollapsePath(program, forces, 0, {.dilatancy = mu, .finalDilatancy = mu});
    ASSERT_EQ(dilating.end, PathEnd::collapse);
    const Eigen::VectorXd closing = applyTransposed(program, dilating.mechanism);
    EXPECT_NEAR(-closing[0], mu * std::abs(closing[1]), 1e-9);
    const CollapsePair pair = followCollapsePath(program, forces, 0, {.dilatancy = mu});
    ASSERT_EQ(pair.end, PathEnd::collapse);
    EXPECT_NEAR(applyTransposed(program, pair.mechanism)[0], 0, 1e-9);
    EXPECT_NEAR(pair.multiplier, mu, 1e-9);
}

} // namespace drystone
