// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Coulomb's law by Newton's method: closed forms, and its own certificate on random stacks.
#include "conic/CoulombNewton.h"

#include "Stacks.h"
#include "conic/Certificate.h"
#include "conic/InteriorPoint.h"
#include "conic/form/Form.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <array>
#include <random>

namespace drystone
{
namespace
{

template<int Rows, int Forces>
ConeSolution nothing(const ConeProgram<Rows, Forces>& program)
{
    ConeSolution start;
    start.displacement = Eigen::VectorXd::Zero(program.load.size());
    start.contactForce = Eigen::VectorXd::Zero(Forces * program.points());
    return start;
}

template<int Rows, int Forces>
ConeSolution coulombOf(const ConeProgram<Rows, Forces>& program, const ConeSolution& start)
{
    SymbolicAnalysis symbolic;
    return solveCoulombNewton(program, start, {}, symbolic);
}

/// The certificate of the program whose gaps are larger by what the flow opens: that of Coulomb's law.
template<int Rows, int Forces>
double worstOfCoulomb(ConeProgram<Rows, Forces> program, const ConeSolution& solution)
{
    const Eigen::VectorXd slip = applyTransposed(program, solution.displacement) - program.gap;
    for (int point = 0; point < program.points(); ++point)
    {
        program.gap[Forces * point] += program.friction[static_cast<std::size_t>(point)]
                                       * slip.segment<Forces - 1>(Forces * point + 1).norm();
    }
    return certifyOptimal(program, solution).worst();
}

TEST(CoulombNewton, ABlockPushedHarderThanFrictionSlidesWithoutRising)
{
    for (const double push : {0.6, -0.6})
    {
        const PlaneConeProgram program = lowBlock(push, 1, 0.4);
        const ConeSolution solution = coulombOf(program, nothing(program));
        ASSERT_EQ(solution.status, SolveStatus::optimal);
        EXPECT_NEAR(solution.displacement[0], (push > 0 ? 0.2 : -0.2) / 2, 1e-14);
        EXPECT_NEAR(solution.displacement[1], 0, 1e-14);
        EXPECT_NEAR(solution.displacement[2], 0, 1e-14);
        EXPECT_NEAR(solution.contactForce[0] + solution.contactForce[2], 1, 1e-13);
        EXPECT_LT(worstOfCoulomb(program, solution), 1e-12);
    }
}

TEST(CoulombNewton, ABlockPushedLessStandsAndOneThatIsLiftedFlies)
{
    const PlaneConeProgram standing = lowBlock(0.3, 1, 0.4);
    EXPECT_LT(coulombOf(standing, nothing(standing)).displacement.norm(), 1e-12);
    const PlaneConeProgram flying = lowBlock(0.3, -1, 0.4);
    const ConeSolution solution = coulombOf(flying, nothing(flying));
    ASSERT_EQ(solution.status, SolveStatus::optimal);
    EXPECT_LT((solution.displacement - Eigen::Vector3d(0.15, 0.5, 0)).norm(), 1e-14);
}

TEST(CoulombNewton, ASlipThatIsGivenInTheGapIsNoSlip)
{
    // The ground point moves along by the tangential gap: a block carried by 0.01 with it has not slid.
    PlaneConeProgram program = lowBlock(0, 1, 0.4);
    program.gap << 0, -0.01, 0, -0.01;
    const ConeSolution solution = coulombOf(program, nothing(program));
    ASSERT_EQ(solution.status, SolveStatus::optimal);
    EXPECT_NEAR(solution.displacement[0], 0.01, 1e-13);
    EXPECT_NEAR(solution.contactForce[1] + solution.contactForce[3], 0.02, 1e-12);
    EXPECT_LT(worstOfCoulomb(program, solution), 1e-11);
}

TEST(CoulombNewton, RandomStacksFromTheAssociativeSolution)
{
    std::mt19937 random(11);
    int solved = 0;
    for (int trial = 0; trial < 100; ++trial)
    {
        const PlaneConeProgram program = pushedStack(6, random);
        const ConeSolution near = solveInteriorPoint(program, {1e-9, 100, 3});
        ASSERT_EQ(near.status, SolveStatus::optimal);
        const ConeSolution solution = coulombOf(program, near);
        // Whoever says that it has solved it has.
        if (solution.status == SolveStatus::optimal)
        {
            ++solved;
            EXPECT_LT(worstOfCoulomb(program, solution), 1e-10) << "stack " << trial;
        }
    }
    EXPECT_GE(solved, 85) << "of 100";
}

/// Columns of a point at an arm from the mass centre of the body it presses up on, against fixed ground.
ConeColumns<6, 3> standingInSpace(int body, const Eigen::Vector3d& arm)
{
    ConeColumns<6, 3> columns;
    columns.first = body;
    const std::array<Eigen::Vector3d, 3> pushes{-Eigen::Vector3d::UnitZ(), -Eigen::Vector3d::UnitX(),
                                                -Eigen::Vector3d::UnitY()};
    for (int force = 0; force < 3; ++force)
    {
        columns.onFirst.col(force) << pushes[static_cast<std::size_t>(force)],
            arm.cross(pushes[static_cast<std::size_t>(force)]);
    }
    return columns;
}

TEST(CoulombNewton, ABlockInSpaceSlidesWhereItIsPushedWithoutRising)
{
    SpaceConeProgram program;
    program.bodies = 1;
    for (const double x : {-0.5, 0.5})
    {
        for (const double y : {-0.4, 0.4})
        {
            program.contacts.push_back(standingInSpace(0, {x, y, -0.1}));
            program.friction.push_back(0.4);
        }
    }
    const Eigen::Vector2d direction = Eigen::Vector2d(3, 4) / 5;
    program.load = Eigen::VectorXd::Zero(6);
    program.load.head<3>() << 0.6 * direction, -1;
    program.inertia = {Eigen::Matrix<double, 6, 1>(2, 2, 2, 0.5, 0.6, 0.7).asDiagonal()};
    program.gap = Eigen::VectorXd::Zero(12);
    const ConeSolution solution = coulombOf(program, nothing(program));
    ASSERT_EQ(solution.status, SolveStatus::optimal);
    EXPECT_LT((solution.displacement.head<2>() - 0.2 / 2 * direction).norm(), 1e-13);
    EXPECT_LT(solution.displacement.tail<4>().norm(), 1e-13);
    EXPECT_LT(worstOfCoulomb(program, solution), 1e-11);
}

TEST(CoulombNewton, RandomStacksInSpaceFromTheAssociativeSolution)
{
    std::mt19937 random(12);
    std::uniform_real_distribution<double> symmetric(-1, 1);
    int solved = 0;
    for (int trial = 0; trial < 100; ++trial)
    {
        SpaceConeProgram program;
        program.bodies = 4;
        program.load = Eigen::VectorXd::Zero(24);
        for (int body = 0; body < program.bodies; ++body)
        {
            for (const double x : {-0.5, 0.5})
            {
                for (const double y : {-0.4, 0.4})
                {
                    ConeColumns<6, 3> columns = standingInSpace(body, {x, y, -0.5});
                    columns.second = body - 1;
                    columns.onSecond = -standingInSpace(body, {x, y, 0.5}).onFirst;
                    program.contacts.push_back(columns);
                    program.friction.push_back(0.3);
                }
            }
            program.load.segment<3>(6 * body) << symmetric(random), symmetric(random),
                -1 + 0.5 * symmetric(random);
            program.inertia.push_back(Eigen::Matrix<double, 6, 1>(1, 1, 1, 0.2, 0.2, 0.25).asDiagonal());
        }
        program.gap = Eigen::VectorXd::Zero(3 * program.points());
        const ConeSolution near = solveInteriorPoint(program, {1e-9, 100, 3});
        ASSERT_EQ(near.status, SolveStatus::optimal);
        const ConeSolution solution = coulombOf(program, near);
        if (solution.status == SolveStatus::optimal)
        {
            ++solved;
            EXPECT_LT(worstOfCoulomb(program, solution), 1e-10) << "stack " << trial;
        }
    }
    EXPECT_GE(solved, 85) << "of 100";
}

TEST(CoulombNewton, AStartOfAnotherSizeIsRefused)
{
    const PlaneConeProgram program = lowBlock(0.3, 1, 0.4);
    EXPECT_THROW(coulombOf(program, {}), std::invalid_argument);
}

} // namespace
} // namespace drystone
