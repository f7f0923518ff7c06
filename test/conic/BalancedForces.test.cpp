// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Forces near known ones that balance a load, on one body whose forces are known in closed form.
#include "conic/BalancedForces.h"

#include "conic/Certificate.h"
#include "conic/form/Form.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

using namespace drystone;

namespace
{

constexpr double mu = 0.5;

/// A body on the ground at points (-1, -1) and (1, -1) from its mass centre, under a load.
PlaneConeProgram bodyOnTwoPoints(const Eigen::Vector3d& load)
{
    PlaneConeProgram program;
    program.bodies = 1;
    program.load = load;
    for (const double x : {-1.0, 1.0})
    {
        ConeColumns<3, 2> columns;
        columns.first = 0;
        // A c balances the load: the ground pushes up, and along x.
        columns.onFirst << 0, -1, -1, 0, -x, -1;
        program.contacts.push_back(columns);
        program.friction.push_back(mu);
    }
    return program;
}

Eigen::VectorXd evenForces()
{
    return Eigen::Vector4d(0.5, 0, 0.5, 0);
}

/// The nearest forces where they leave the margin at all points; else empty.
template<class Program>
Eigen::VectorXd balancedForces(const Program& program, const Eigen::VectorXd& near, double margin,
                               SymbolicAnalysis& symbolic)
{
    const Eigen::VectorXd forces = nearestForces(program, near, 1e-12, symbolic);
    EXPECT_EQ(forces.size(), near.size());
    return pointsOutside(program, near, forces, margin).empty() ? forces : Eigen::VectorXd();
}

/// Bodies each on two points of its own, the first under a push of its own.
PlaneConeProgram bodiesInARow(int count, double push)
{
    PlaneConeProgram program;
    program.bodies = count;
    program.load.resize(3 * count);
    for (int body = 0; body < count; ++body)
    {
        const PlaneConeProgram one = bodyOnTwoPoints({body == 0 ? push : 0, -1, 0});
        program.load.segment<3>(3 * body) = one.load;
        for (std::size_t point = 0; point < one.contacts.size(); ++point)
        {
            program.contacts.push_back(one.contacts[point]);
            program.contacts.back().first = body;
            program.friction.push_back(mu);
        }
    }
    return program;
}

/// Forces that balance the loads of a row, the first two beyond friction.
Eigen::VectorXd forcesBeyondFriction(int count, double push)
{
    Eigen::VectorXd forces = evenForces().replicate(count, 1);
    forces.head<4>() << 0.5 - push / 2, 0.4 - push / 2, 0.5 + push / 2, -0.4 - push / 2;
    return forces;
}

} // namespace

TEST(ForceChanges, BalanceOneLoadAfterAnotherAsTheNearestForcesDo)
{
    PlaneConeProgram program = bodiesInARow(3, 0);
    const Eigen::VectorXd near = evenForces().replicate(3, 1);
    ForceChanges<3, 2> changes(program, near);
    Eigen::VectorXd push = Eigen::VectorXd::Zero(9);
    push.segment<3>(3) << 0.1, 0, 0.05;
    const Eigen::VectorXd change = changes.under(push, 1e-12);
    ASSERT_EQ(change.size(), near.size());
    EXPECT_LE((applyEquilibrium(program, change) - push).lpNorm<Eigen::Infinity>(), 1e-12);
    EXPECT_LE((changes.under(2 * push, 1e-12) - 2 * change).lpNorm<Eigen::Infinity>(), 1e-12);
    program.load += push;
    SymbolicAnalysis symbolic;
    EXPECT_LE((nearestForces(program, near, 1e-12, symbolic) - near - change).lpNorm<Eigen::Infinity>(),
              1e-11);
    // Nothing presses a body down to the ground: a lift is not balanced.
    PlaneConeProgram lifted = program;
    lifted.contacts.clear();
    lifted.friction.clear();
    EXPECT_EQ((ForceChanges<3, 2>(lifted, Eigen::VectorXd()).under(push, 1e-12).size()), 0);
}

TEST(BalancedForces, TheyBalanceTheLoadInsideTheCones)
{
    for (const double push : {0.0, 0.1, -0.2, 0.3})
    {
        const PlaneConeProgram program = bodyOnTwoPoints({push, -1, 0});
        SymbolicAnalysis symbolic;
        const Eigen::VectorXd forces = balancedForces(program, evenForces(), 0, symbolic);
        ASSERT_EQ(forces.size(), 4) << push;
        EXPECT_LT((applyEquilibrium(program, forces) - program.load).norm(), 1e-11);
        EXPECT_NEAR(forces[0] + forces[2], 1, 1e-11); // what the points carry together
        EXPECT_NEAR(forces[2] - forces[0], push, 1e-11) << "the push at the mass centre, 1 above the points";
        for (const int point : {0, 1})
        {
            EXPECT_LE(std::abs(forces[2 * point + 1]), mu * forces[2 * point]);
        }
    }
}

TEST(BalancedForces, ThePointsOutsideAreNamed)
{
    const PlaneConeProgram program = bodyOnTwoPoints({0, -1, 0});
    EXPECT_EQ(pointsOutside(program, evenForces(), Eigen::Vector4d(0.5, 0.2, 0.5, -0.3), 0),
              (std::vector<std::size_t>{1}));
    EXPECT_EQ(pointsOutside(program, evenForces(), Eigen::Vector4d(0.5, 0.2, 0.5, -0.3), 0.5),
              (std::vector<std::size_t>{0, 1}));
}

// Beyond mu = 0.5 there are none; near it the margin is used up.
TEST(BalancedForces, NoneAreFoundOutsideTheConesNorInTheMargin)
{
    SymbolicAnalysis symbolic;
    EXPECT_EQ(balancedForces(bodyOnTwoPoints({0.6, -1, 0}), evenForces(), 0, symbolic).size(), 0);
    EXPECT_EQ(balancedForces(bodyOnTwoPoints({0.05, 1, 0}), evenForces(), 0, symbolic).size(), 0);
    const PlaneConeProgram nearly = bodyOnTwoPoints({0.3, -1, 0});
    EXPECT_EQ(balancedForces(nearly, evenForces(), 0, symbolic).size(), 4);
    EXPECT_EQ(balancedForces(nearly, evenForces(), 0.9, symbolic).size(), 0);
}

TEST(BalancedForces, ForcesThatBalanceTheLoadStayAsTheyAre)
{
    SymbolicAnalysis symbolic;
    const Eigen::VectorXd forces = balancedForces(bodyOnTwoPoints({0, -1, 0}), evenForces(), 0.5, symbolic);
    ASSERT_EQ(forces.size(), 4);
    EXPECT_LT((forces - evenForces()).norm(), 1e-14);
}

TEST(BalancedForces, RoundConesOfSpaceLikewise)
{
    SpaceConeProgram program;
    program.bodies = 1;
    program.load.resize(6);
    program.load << 0.2, 0.1, -1, 0, 0, 0;
    Eigen::VectorXd known = Eigen::VectorXd::Zero(12);
    for (int corner = 0; corner < 4; ++corner)
    {
        const Eigen::Vector3d arm(corner < 2 ? -1 : 1, corner % 2 ? -1 : 1, -0.5);
        ConeColumns<6, 3> columns;
        columns.first = 0;
        const Eigen::Matrix3d axes = (Eigen::Matrix3d() << 0, 1, 0, 0, 0, 1, 1, 0, 0).finished();
        for (int column = 0; column < 3; ++column)
        {
            columns.onFirst.col(column) << -axes.col(column), -arm.cross(Eigen::Vector3d(axes.col(column)));
        }
        program.contacts.push_back(columns);
        program.friction.push_back(mu);
        known[3 * corner] = 0.25;
    }
    SymbolicAnalysis symbolic;
    const Eigen::VectorXd forces = balancedForces(program, known, 0, symbolic);
    ASSERT_EQ(forces.size(), 12);
    EXPECT_LT((applyEquilibrium(program, forces) - program.load).norm(), 1e-11);
    for (int point = 0; point < 4; ++point)
    {
        EXPECT_LE(forces.segment<2>(3 * point + 1).norm(), mu * forces[3 * point]);
    }
}

TEST(BalancedForces, ForcesOutsideTheConesAreRepairedAndOthersStay)
{
    const PlaneConeProgram program = bodiesInARow(20, 0.2);
    const Eigen::VectorXd forces = forcesBeyondFriction(20, 0.2);
    ASSERT_LT((applyEquilibrium(program, forces) - program.load).norm(), 1e-15);
    const std::vector<std::size_t> outside = pointsOutside(program, forces, forces, 0);
    ASSERT_EQ(outside, (std::vector<std::size_t>{0, 1}));
    int factorisations = 0;
    const Eigen::VectorXd repaired = repairedForces(program, forces, outside, 1e-11, factorisations);
    ASSERT_EQ(repaired.size(), forces.size());
    EXPECT_EQ(repaired.tail(76), forces.tail(76));
    EXPECT_GT(factorisations, 0);
    ConeSolution rest;
    rest.contactForce = repaired;
    rest.displacement = Eigen::VectorXd::Zero(program.load.size());
    EXPECT_LE(certifyOptimal(program, rest).worst(), 1e-11);
}

// A push of 0.6 is beyond the friction of 0.5. The others of the row have nothing to do with it: the search
// for more neighbours ends.
TEST(BalancedForces, NoForcesAreRepairedWhereThereAreNone)
{
    const PlaneConeProgram program = bodiesInARow(20, 0.6);
    int factorisations = 0;
    EXPECT_EQ(repairedForces(program, forcesBeyondFriction(20, 0.6), {1}, 1e-11, factorisations).size(), 0);
}

// Where half of the bodies and more would have to be found anew, a program of all is as good.
TEST(BalancedForces, OfALargePartNoneAreRepaired)
{
    const PlaneConeProgram program = bodiesInARow(1, 0.2);
    int factorisations = 0;
    EXPECT_EQ(repairedForces(program, forcesBeyondFriction(1, 0.2), {1}, 1e-11, factorisations).size(), 0);
    EXPECT_EQ(factorisations, 0);
}
