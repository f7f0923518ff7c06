// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Gauss-Seidel: its local problem against the conditions of an optimum, the whole against exact solvers.
#include "conic/GaussSeidel.h"
#include "conic/AugmentedLagrangian.h"
#include "conic/Certificate.h"
#include "conic/InteriorPoint.h"
#include "conic/SolverChoice.h"

#include <Eigen/Geometry>

#include <gtest/gtest.h>

#include <random>

namespace drystone
{
namespace
{

/// Columns of a point of the plane at (x, y) from the mass centre of the body that it presses up on.
ConeColumns<3, 2> pressingUp(int body, double x, double y)
{
    ConeColumns<3, 2> columns;
    columns.first = body;
    columns.onFirst << 0, -1, -1, 0, -x, y;
    return columns;
}

/// A tower of unit blocks under their weight and a horizontal load of `push` times it, as a step from rest.
PlaneConeProgram tower(int blocks, double push, double mu)
{
    PlaneConeProgram program;
    program.bodies = blocks;
    program.load = Eigen::VectorXd::Zero(3 * blocks);
    for (int body = 0; body < blocks; ++body)
    {
        for (const double x : {-0.5, 0.5})
        {
            ConeColumns<3, 2> columns = pressingUp(body, x, -0.5);
            if (body > 0)
            {
                columns.second = body - 1;
                columns.onSecond = -pressingUp(body, x, 0.5).onFirst;
            }
            program.contacts.push_back(columns);
            program.friction.push_back(mu);
        }
        program.load.segment<2>(3 * body) << push, -1;
        program.inertia.push_back(Eigen::Vector3d(1, 1, 1.0 / 6).asDiagonal());
    }
    return program;
}

/// A body in space on four points of the ground, at the corners of a square of side 1, under (fx fy fz).
SpaceConeProgram blockInSpace(const Eigen::Vector3d& load, double mu)
{
    SpaceConeProgram program;
    program.bodies = 1;
    for (const double x : {-0.5, 0.5})
    {
        for (const double y : {-0.5, 0.5})
        {
            ConeColumns<6, 3> columns;
            columns.first = 0;
            const Eigen::Vector3d arm(x, y, -0.5);
            const Eigen::Vector3d axes[3] = {Eigen::Vector3d::UnitZ(), Eigen::Vector3d::UnitX(),
                                             Eigen::Vector3d::UnitY()};
            for (int column = 0; column < 3; ++column)
            {
                columns.onFirst.col(column) << -axes[column], -arm.cross(axes[column]);
            }
            program.contacts.push_back(columns);
            program.friction.push_back(mu);
        }
    }
    program.load = Eigen::VectorXd::Zero(6);
    program.load.head<3>() = load;
    Eigen::Matrix<double, 6, 1> inertia;
    inertia << 1, 1, 1, 1.0 / 6, 1.0 / 6, 1.0 / 6;
    program.inertia = {inertia.asDiagonal()};
    return program;
}

/// Whether a force is the least of 1/2 c'Wc + b'c in the cone: z = W c + b in the dual cone and c'z = 0, all
/// relative to b.
template<int Forces>
void expectLeast(const Eigen::Matrix<double, Forces, Forces>& W, const Eigen::Matrix<double, Forces, 1>& b,
                 double mu)
{
    const Eigen::Matrix<double, Forces, 1> force = leastInCone(W, b, mu);
    const Eigen::Matrix<double, Forces, 1> z = W * force + b;
    const double scale = b.norm();
    EXPECT_LE(force.template tail<Forces - 1>().norm(), mu * force[0] * (1 + 1e-14) + 1e-300);
    EXPECT_LE(mu * z.template tail<Forces - 1>().norm() - z[0], 1e-12 * scale * (1 + mu));
    EXPECT_LE(std::abs(force.dot(z)), 1e-12 * scale * std::max(1e-300, force.norm()));
}

TEST(GaussSeidel, TheForceOfOnePointIsTheLeastInItsCone)
{
    std::mt19937 random(11);
    std::normal_distribution<double> normal;
    for (int trial = 0; trial < 20000; ++trial)
    {
        const double mu = std::array{0.0, 1e-12, 0.1, 0.65, 3.0}[static_cast<std::size_t>(trial % 5)];
        Eigen::Matrix3d root;
        Eigen::Vector3d b;
        for (double& entry : root.reshaped())
        {
            entry = normal(random);
        }
        for (double& entry : b.reshaped())
        {
            entry = normal(random);
        }
        const Eigen::Matrix3d W = root * root.transpose() + 0.1 * Eigen::Matrix3d::Identity();
        expectLeast<3>(W, b, mu);
        expectLeast<2>(W.topLeftCorner<2, 2>(), b.head<2>(), mu);
    }
}

TEST(GaussSeidel, ABlockInSpaceStaysWhileItsFrictionHolds)
{
    for (const double direction : {0.0, 0.3, 1.0, 2.5, 4.0})
    {
        const Eigen::Vector3d push(std::cos(direction), std::sin(direction), 0);
        const Eigen::Vector3d weight(0, 0, -1);
        const SpaceConeProgram held = blockInSpace(0.29 * push + weight, 0.3);
        const ConeSolution rests = solveGaussSeidel(held, {}, {.tolerance = 1e-9});
        ASSERT_EQ(rests.status, SolveStatus::optimal);
        EXPECT_LT(rests.displacement.norm(), 1e-8);
        // Beyond it the least of the quadratic form: pushed by p, the block moves by (p - mu)/(1 + mu2) along
        // the push and mu times that upwards.
        const SpaceConeProgram pushed = blockInSpace(0.4 * push + weight, 0.3);
        const ConeSolution slides = solveGaussSeidel(pushed, {}, {.tolerance = 1e-9});
        ASSERT_EQ(slides.status, SolveStatus::optimal);
        const double along = 0.1 / 1.09;
        EXPECT_LT((slides.displacement.head<3>() - along * (push - 0.3 * weight)).norm(), 1e-7);
    }
}

TEST(GaussSeidel, AgreesWithTheInteriorPointOnATower)
{
    for (const double push : {0.05, 0.2, 0.9})
    {
        const PlaneConeProgram program = tower(4, push, 0.65);
        const ConeSolution reference = solveInteriorPoint(program, {.tolerance = 1e-10});
        const ConeSolution solution = solveGaussSeidel(program, {}, {.tolerance = 1e-8});
        ASSERT_EQ(reference.status, SolveStatus::optimal) << push;
        ASSERT_EQ(solution.status, SolveStatus::optimal)
            << push << ", certificate " << certifyOptimal(program, solution).worst();
        EXPECT_LT((solution.displacement - reference.displacement).lpNorm<Eigen::Infinity>(), 1e-4) << push;
    }
}

TEST(GaussSeidel, BalanceAndConesHoldWhereverItStops)
{
    const PlaneConeProgram program = tower(40, 0.3, 0.65);
    const ConeSolution solution = solveGaussSeidel(program, {}, {.tolerance = 1e-9, .maximumIterations = 3});
    ASSERT_EQ(solution.status, SolveStatus::notConverged);
    EXPECT_EQ(solution.iterations, 3);
    const Certificate certificate = certifyOptimal(program, solution);
    EXPECT_LT(certificate.primalResidual, 1e-14);
    EXPECT_GT(certificate.dualResidual, 1e-6);
}

TEST(GaussSeidel, FromTheSolutionNothingIsLeftToDo)
{
    const PlaneConeProgram program = tower(4, 0.2, 0.65);
    const ConeSolution cold = solveGaussSeidel(program, {}, {.tolerance = 1e-7});
    const ConeSolution warm = solveGaussSeidel(program, cold, {.tolerance = 1e-7});
    EXPECT_EQ(warm.status, SolveStatus::optimal);
    EXPECT_EQ(warm.iterations, 0);
}

TEST(GaussSeidel, IsChosenInTheDictionary)
{
    const SolverChoice choice = readOptions<SolverChoice>(
        Dictionary::readString("solver gaussSeidel; tolerance 1e-4; maximumSweeps 2;", "solution"));
    EXPECT_EQ(choice.solver, SolverType::gaussSeidel);
    const ConeSolution solution = solveConeProgram(tower(40, 0.3, 0.65), choice);
    EXPECT_EQ(solution.status, SolveStatus::notConverged);
    EXPECT_EQ(solution.iterations, 2);
}

TEST(GaussSeidel, RefusesLimitAnalysis)
{
    PlaneConeProgram program = tower(1, 0, 0.65);
    program.inertia.clear();
    EXPECT_THROW(solveGaussSeidel(program, {}), std::invalid_argument);
}

} // namespace
} // namespace drystone
