// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Parts of a stack of bodies: with the others held, and under the forces of the others.
#include "conic/ProgramPart.h"

#include <gtest/gtest.h>

using namespace drystone;

namespace
{

/// Bodies of weight 1 on top of each other, each on two points at -1 and 1 of its lower face, with marks that
/// show where numbers came from. The first stands on the ground.
PlaneConeProgram markedStack(int bodies)
{
    PlaneConeProgram program;
    program.bodies = bodies;
    program.load = Eigen::VectorXd::Zero(3 * bodies);
    for (int body = 0; body < bodies; ++body)
    {
        program.load.segment<3>(3 * body) << 0, -1, 0;
        for (const double x : {-1.0, 1.0})
        {
            ConeColumns<3, 2> columns;
            columns.first = body;
            columns.second = body - 1;
            columns.onFirst << 0, -1, -1, 0, -x, -1;
            columns.onSecond << 0, 1, 1, 0, x, -1;
            program.contacts.push_back(columns);
            program.friction.push_back(0.1 * static_cast<double>(program.contacts.size()));
        }
    }
    program.gap = Eigen::VectorXd::LinSpaced(2 * program.points(), 1, 2 * program.points());
    program.liveLoad =
        Eigen::VectorXd::LinSpaced(program.load.size(), 1, static_cast<double>(program.load.size()));
    return program;
}

/// Each joint carries what stands on it, half at each point.
Eigen::VectorXd forcesOfWeight(int bodies)
{
    Eigen::VectorXd forces = Eigen::VectorXd::Zero(4 * bodies);
    for (int body = 0; body < bodies; ++body)
    {
        forces[4 * body] = forces[4 * body + 2] = (bodies - body) / 2.0;
    }
    return forces;
}

const std::vector<char> middle{false, true, true, false};

} // namespace

TEST(ProgramPart, WithOthersHeldHasAllPointsOfItsBodies)
{
    const PlaneConeProgram whole = markedStack(4);
    const ProgramPart<3, 2> part = partWithOthersHeld(whole, middle);
    EXPECT_EQ(part.bodies, (std::vector<int>{1, 2}));
    EXPECT_EQ(part.points, (std::vector<std::size_t>{2, 3, 4, 5, 6, 7}));
    EXPECT_EQ(part.program.bodies, 2);
    EXPECT_EQ(part.program.contacts[0].first, 0);
    EXPECT_EQ(part.program.contacts[0].second, -1); // body 0 is held
    EXPECT_EQ(part.program.contacts[2].second, 0);
    EXPECT_EQ(part.program.contacts[5].first, -1); // as is body 3
    EXPECT_EQ(part.program.contacts[5].second, 1);
    EXPECT_EQ(part.program.friction[5], whole.friction[7]);
    EXPECT_EQ(part.program.gap, whole.gap.segment(4, 12));
    EXPECT_EQ(part.program.load, whole.load.segment(3, 6));
    EXPECT_EQ(part.program.liveLoad, whole.liveLoad.segment(3, 6));
    EXPECT_FALSE(part.program.hasInertia());
}

TEST(ProgramPart, UnderForcesIsBalancedByThoseOfTheWhole)
{
    PlaneConeProgram whole = markedStack(4);
    whole.strength.assign(whole.contacts.size(), {1, 2, 3});
    const Eigen::VectorXd forces = forcesOfWeight(4);
    ASSERT_LE((applyEquilibrium(whole, forces) - whole.load).lpNorm<Eigen::Infinity>(), 1e-15);
    const ProgramPart<3, 2> part = partUnderForces(whole, forces, middle);
    EXPECT_EQ(part.points, (std::vector<std::size_t>{4, 5})); // between the two
    const Eigen::VectorXd own = takenFrom<2>(part.points, forces);
    EXPECT_LE((applyEquilibrium(part.program, own) - part.program.load).lpNorm<Eigen::Infinity>(), 1e-15);
    EXPECT_EQ(part.program.strength.size(), 2u);
    Eigen::VectorXd put = Eigen::VectorXd::Zero(forces.size());
    putInto<2>(part.points, own, put);
    EXPECT_EQ(put.segment(8, 4), forces.segment(8, 4));
    EXPECT_EQ(put.squaredNorm(), own.squaredNorm());
}

TEST(ProgramPart, PointsOnTheGroundStayWithTheirBody)
{
    const PlaneConeProgram whole = markedStack(2);
    const ProgramPart<3, 2> part = partUnderForces(whole, forcesOfWeight(2), {true, false});
    EXPECT_EQ(part.points, (std::vector<std::size_t>{0, 1}));
    EXPECT_DOUBLE_EQ(part.program.load[1], -2); // the other stands on it
}
