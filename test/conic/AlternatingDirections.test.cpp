// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Alternating directions against motions that are known.
#include "conic/coulomb/AlternatingDirections.h"

#include "conic/form/Form.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

namespace drystone
{
namespace
{

constexpr double g = 9.81;
constexpr double length = 0.01; // of the step [s]

/// A body of a kilogram and a radius of 1 m that touches fixed ones, for a step from rest.
SpaceConeProgram bodyUnder(const Eigen::Vector3d& force)
{
    SpaceConeProgram program;
    program.bodies = 1;
    program.load = Eigen::VectorXd::Zero(6);
    program.load.head<3>() = force;
    program.inertia.push_back(Eigen::Matrix<double, 6, 6>::Identity() / (length * length));
    program.gap.resize(0);
    return program;
}

/// \param at place of the point from the middle of the body \param normal into the body
void touch(SpaceConeProgram& program, const Eigen::Vector3d& at, const Eigen::Vector3d& normal, double mu)
{
    const Eigen::Vector3d other =
        std::abs(normal.z()) < 0.5 ? Eigen::Vector3d::UnitZ() : Eigen::Vector3d::UnitX();
    Eigen::Matrix3d frame;
    frame << normal, normal.cross(other), normal.cross(normal.cross(other));
    ConeColumns<6, 3> columns;
    columns.first = 0;
    // A c is what has to be balanced: minus the force on the body.
    columns.onFirst.topRows<3>() = -frame;
    for (int component = 0; component < 3; ++component)
    {
        columns.onFirst.col(component).tail<3>() = -at.cross(frame.col(component));
    }
    program.contacts.push_back(columns);
    program.friction.push_back(mu);
    program.gap.conservativeResize(3 * program.points());
    program.gap.tail<3>().setZero();
}

ConeSolution solved(const SpaceConeProgram& program, const Eigen::VectorXd& expected)
{
    SymbolicAnalysis symbolic;
    return solveAlternatingDirections(program, expected, {.tolerance = 1e-9, .maximumIterations = 1000},
                                      symbolic);
}

ConeSolution solved(const SpaceConeProgram& program)
{
    return solved(program, Eigen::VectorXd::Zero(6));
}

SpaceConeProgram onAPlate(double horizontal, double mu)
{
    SpaceConeProgram program = bodyUnder({horizontal * std::cos(0.3), horizontal * std::sin(0.3), -g});
    for (const double x : {-1.0, 1.0})
    {
        for (const double y : {-1.0, 1.0})
        {
            touch(program, {x, y, -0.1}, Eigen::Vector3d::UnitZ(), mu);
        }
    }
    return program;
}

TEST(AlternatingDirections, SlideABodyWithoutOpeningItsJoint)
{
    for (const double mu : {0.0, 0.3, 0.6})
    {
        const ConeSolution solution = solved(onAPlate(8, mu));
        EXPECT_EQ(solution.status, SolveStatus::optimal) << mu;
        const double way = (8 - mu * g) * length * length;
        EXPECT_NEAR(solution.displacement[0], way * std::cos(0.3), 1e-3 * way) << mu;
        EXPECT_NEAR(solution.displacement[1], way * std::sin(0.3), 1e-3 * way) << mu;
        EXPECT_NEAR(solution.displacement[2], 0, 1e-3 * way) << mu;
    }
}

TEST(AlternatingDirections, LeaveABodyWhereFrictionHoldsIt)
{
    const ConeSolution solution = solved(onAPlate(5, 0.6));
    EXPECT_LE(solution.displacement.lpNorm<Eigen::Infinity>(), 1e-4 * 5 * length * length);
}

// Between two fixed faces any pressure above m g / (2 mu) would hold it: the least is none.
TEST(AlternatingDirections, DropABodyThatOnlyAPressureOfItsOwnWouldHold)
{
    SpaceConeProgram program = bodyUnder({0, 0, -g});
    touch(program, {1, 0, 0}, -Eigen::Vector3d::UnitX(), 0.6);
    touch(program, {-1, 0, 0}, Eigen::Vector3d::UnitX(), 0.6);
    Eigen::VectorXd falling = Eigen::VectorXd::Zero(6);
    falling[2] = -1e-3; // dt v0
    program.load[2] -= 1e-3 / (length * length);
    const ConeSolution solution = solved(program, falling);
    const double way = 1e-3 + g * length * length;
    EXPECT_NEAR(solution.displacement[2], -way, 1e-2 * way);
}

TEST(AlternatingDirections, RefuseWhatTheyAreNotMadeFor)
{
    SpaceConeProgram elastic = onAPlate(5, 0.6);
    elastic.compliance = Eigen::VectorXd::Constant(12, 1e-9);
    EXPECT_THROW(solved(elastic), std::invalid_argument);
    SpaceConeProgram bonded = onAPlate(5, 0.6);
    bonded.strength.resize(4);
    EXPECT_THROW(solved(bonded), std::invalid_argument);
    SpaceConeProgram massless = onAPlate(5, 0.6);
    massless.inertia.clear();
    EXPECT_THROW(solved(massless), std::invalid_argument);
}

} // namespace
} // namespace drystone
