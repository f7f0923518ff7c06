// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Forces of bodies that touch like a tree are those that one factorisation of all of them finds.
#include "conic/TreeBalance.h"

#include "Towers.h"
#include "conic/BalancedForces.h"
#include "conic/InteriorPoint.h"
#include "conic/form/Form.h"

#include <gtest/gtest.h>

using namespace drystone;

namespace
{

/// \param near forces with which the tower carries its weight
template<int Rows, int Forces>
void expectNearestForces(ConeProgram<Rows, Forces> program, const Eigen::VectorXd& push)
{
    program.liveLoad.resize(0);
    const ConeSolution standing = solveInteriorPoint(program, {});
    ASSERT_EQ(standing.status, SolveStatus::optimal);
    program.load += push;
    const auto branches = branchesOfTree(program);
    ASSERT_TRUE(branches);
    EXPECT_EQ(branches->size(), static_cast<std::size_t>(program.bodies));
    const Eigen::VectorXd forces = nearestForcesInTree(program, *branches, standing.contactForce, 1e-12);
    ASSERT_EQ(forces.size(), standing.contactForce.size());
    const double size = program.load.template lpNorm<Eigen::Infinity>();
    EXPECT_LE((applyEquilibrium(program, forces) - program.load).template lpNorm<Eigen::Infinity>(),
              1e-11 * size);
    SymbolicAnalysis symbolic;
    const Eigen::VectorXd ofAll = nearestForces(program, standing.contactForce, 1e-12, symbolic);
    ASSERT_EQ(ofAll.size(), forces.size());
    EXPECT_LE((forces - ofAll).template lpNorm<Eigen::Infinity>(), 1e-9 * size);
}

/// Bodies in the plane, each of which presses upon the next, or the ground, at one point below its middle.
PlaneConeProgram bodiesWithPairs(int bodies, const std::vector<std::pair<int, int>>& pairs)
{
    PlaneConeProgram program;
    program.bodies = bodies;
    program.load = Eigen::VectorXd::Zero(3 * bodies);
    for (const auto& [first, second] : pairs)
    {
        ConeColumns<3, 2> columns;
        columns.first = first;
        columns.second = second;
        columns.onFirst << 0, -1, -1, 0, 0, -1;
        columns.onSecond << 0, 1, 1, 0, 0, -1;
        program.contacts.push_back(columns);
        program.friction.push_back(0.5);
    }
    return program;
}

} // namespace

TEST(TreeBalance, FindsTheNearestForcesOfTowers)
{
    for (const int boxes : {1, 2, 7, 20})
    {
        const Tower tower = evenTower(boxes, 0.3);
        Eigen::VectorXd inPlane = Eigen::VectorXd::Zero(3 * boxes);
        Eigen::VectorXd inSpace = Eigen::VectorXd::Zero(6 * boxes);
        for (int box = 0; box < boxes; ++box)
        {
            inPlane.segment<3>(3 * box) << 0.02, 0.3, 0.01;
            inSpace.segment<6>(6 * box) << 0.02, -0.01, 0.3, 0.01, 0.005, -0.003;
        }
        expectNearestForces(planeLimitAnalysis(tower), inPlane);
        expectNearestForces(spaceLimitAnalysis(tower), inSpace);
    }
}

TEST(TreeBalance, TellsTreesFromRings)
{
    const auto isTree = [](int bodies, const std::vector<std::pair<int, int>>& pairs)
    { return branchesOfTree(bodiesWithPairs(bodies, pairs)).has_value(); };
    EXPECT_TRUE(isTree(3, {}));
    EXPECT_TRUE(isTree(3, {{0, -1}, {0, 1}, {1, 2}}));
    EXPECT_TRUE(isTree(3, {{0, 1}, {1, 2}})); // of a body in flight
    EXPECT_TRUE(isTree(4, {{0, 1}, {0, 2}, {0, 3}, {-1, 0}}));
    EXPECT_TRUE(isTree(2, {{0, -1}, {-1, 1}}));  // two apart on the ground
    EXPECT_TRUE(isTree(1, {{-1, -1}, {0, -1}})); // and what is fixed itself
    EXPECT_FALSE(isTree(3, {{0, 1}, {1, 2}, {0, 2}}));
    EXPECT_FALSE(isTree(2, {{0, -1}, {0, 1}, {1, -1}}));        // through the ground
    EXPECT_FALSE(isTree(4, {{0, -1}, {1, 2}, {1, 3}, {2, 3}})); // one of two
}

TEST(TreeBalance, FollowsEachBranchFromItsLeavesInwards)
{
    const PlaneConeProgram program = bodiesWithPairs(4, {{0, 1}, {1, 2}, {1, 3}, {3, -1}});
    const auto branches = branchesOfTree(program);
    ASSERT_TRUE(branches);
    std::vector<char> isDone(4, false);
    for (const TreeBranch& branch : *branches)
    {
        EXPECT_FALSE(isDone[static_cast<std::size_t>(branch.body)]);
        isDone[static_cast<std::size_t>(branch.body)] = true;
        EXPECT_TRUE(branch.other < 0 || !isDone[static_cast<std::size_t>(branch.other)]);
    }
    EXPECT_EQ(branches->size(), 4u);
}

TEST(TreeBalance, SaysWhereNoForcesBalance)
{
    // One point below the middle holds no moment.
    PlaneConeProgram program = bodiesWithPairs(1, {{0, -1}});
    program.load << 0, -1, 0.1;
    const auto branches = branchesOfTree(program);
    ASSERT_TRUE(branches);
    EXPECT_EQ(nearestForcesInTree(program, *branches, Eigen::Vector2d(1, 0), 1e-9).size(), 0);
    program.load[2] = 0;
    EXPECT_EQ(nearestForcesInTree(program, *branches, Eigen::Vector2d(1, 0), 1e-9), Eigen::Vector2d(1, 0));
}
