// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Forces followed from those of a start in space, where the side of a point that sticks is round and shear
/// turns as it slides: the law's pieces, closed forms, and stacks whose answers are judged by the law itself.
#include "conic/coulomb/ContactPath.h"

#include "conic/InteriorPoint.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <random>

namespace drystone
{
namespace
{

using Eigen::Vector3d;
using Eigen::VectorXd;

/// Columns of a level point at `arm` from the mass centre of the body it presses up on: normal z, shear along
/// x and y.
ConeColumns<6, 3> standingOn(int body, const Vector3d& arm)
{
    ConeColumns<6, 3> columns;
    columns.first = body;
    const std::array<Vector3d, 3> directions{Vector3d::UnitZ(), Vector3d::UnitX(), Vector3d::UnitY()};
    for (int k = 0; k < 3; ++k)
    {
        const Vector3d& along = directions[static_cast<std::size_t>(k)];
        columns.onFirst.col(k) << -along, -arm.cross(along);
    }
    return columns;
}

/// Cubes on top of each other, on their corners.
SpaceConeProgram cubes(int blocks, double mu)
{
    SpaceConeProgram program;
    program.bodies = blocks;
    program.load = VectorXd::Zero(6 * blocks);
    for (int body = 0; body < blocks; ++body)
    {
        for (const auto& [x, y] : {std::pair(-0.5, -0.5), {0.5, -0.5}, {0.5, 0.5}, {-0.5, 0.5}})
        {
            ConeColumns<6, 3> columns = standingOn(body, {x, y, -0.5});
            columns.second = body - 1;
            columns.onSecond = -standingOn(body, {x, y, 0.5}).onFirst;
            program.contacts.push_back(columns);
            program.friction.push_back(mu);
        }
        program.load[6 * body + 2] = -1;
        Eigen::Matrix<double, 6, 1> inertia;
        inertia << 1, 1, 1, 0.17, 0.17, 0.17;
        program.inertia.push_back(inertia.asDiagonal());
    }
    program.gap = VectorXd::Zero(3 * program.points());
    return program;
}

ConeSolution nothing(const SpaceConeProgram& program)
{
    ConeSolution start;
    start.displacement = VectorXd::Zero(program.load.size());
    start.contactForce = VectorXd::Zero(3 * program.points());
    return start;
}

/// What the equations of motion and Coulomb's law leave, in the law's own words.
double errorOf(const SpaceConeProgram& program, double stiffness, const VectorXd& y, const VectorXd& c)
{
    double error =
        (applyInertia(program, y) + applyEquilibrium(program, c) - program.load).lpNorm<Eigen::Infinity>();
    const VectorXd w = stiffness * (applyTransposed(program, y) - program.gap);
    for (int point = 0; point < program.points(); ++point)
    {
        const double normal = std::max(0.0, w[3 * point]);
        const double limit = program.friction[static_cast<std::size_t>(point)] * normal;
        Eigen::Vector2d shear = w.segment<2>(3 * point + 1);
        shear *= shear.norm() > limit ? limit / shear.norm() : 1;
        error = std::max(error, std::abs(c[3 * point] - normal));
        error = std::max(error, (c.segment<2>(3 * point + 1) - shear).norm());
    }
    return error;
}

TEST(SlidingLawInSpace, APointLeavesTheDiscWhereItsShearComesToTheLimit)
{
    std::mt19937 random(7);
    std::uniform_real_distribution<double> symmetric(-1, 1);
    int ends = 0;
    for (int trial = 0; trial < 4000; ++trial)
    {
        const ShearLimit limit{std::abs(symmetric(random)), trial % 2 == 0 ? 0 : 0.3};
        const double normal = 1 + std::abs(symmetric(random));
        const double angle = 3 * symmetric(random);
        const bool isOnIt = trial % 4 > 1;
        const double share = isOnIt ? 1 : 0.9 * std::abs(symmetric(random));
        const auto beyond = [&](const Vector3d& w)
        { return w.tail<2>().norm() - (limit.cohesion + limit.mu * w[0]); };
        const double radius = share * (limit.cohesion + limit.mu * normal);
        const Vector3d w(normal, radius * std::cos(angle), radius * std::sin(angle));
        Vector3d change(symmetric(random), symmetric(random), symmetric(random));
        if (isOnIt && beyond(w + 1e-7 * change) > 0)
        {
            change = -change; // inwards
        }
        if (isOnIt && beyond(w + 1e-7 * change) > 0)
        {
            continue;
        }
        const double length = lengthInDisc(limit, w, change, isOnIt ? DiscPlace::rim : DiscPlace::inside);
        // While the normal force is there, the limit is a cone.
        const double farthest = change[0] < 0 ? -normal / change[0] : 1e3;
        const double end = std::min(length, farthest);
        for (const double part : {0.01, 0.3, 0.7, 0.99})
        {
            EXPECT_LE(beyond(w + part * end * change), 1e-9) << "trial " << trial << " at " << part;
        }
        if (length < farthest)
        {
            ++ends;
            EXPECT_NEAR(beyond(w + length * change), 0, 1e-9) << "trial " << trial;
            EXPECT_GT(beyond(w + 1.001 * length * change + 1e-6 * change), 0) << "trial " << trial;
        }
    }
    EXPECT_GT(ends, 1000);
}

TEST(SlidingLawInSpace, IsContinuousAcrossTheSidesOfItsTangents)
{
    std::mt19937 random(8);
    std::uniform_real_distribution<double> symmetric(-1, 1);
    const SlidingLaw law{Sliding::coulomb, 0.6, 0.4, 0.2};
    for (int trial = 0; trial < 2000; ++trial)
    {
        const double normal = 2 * symmetric(random);
        const double limit = law.cohesion + law.mu * std::max(normal, -law.tension);
        const double angle = 3 * symmetric(random);
        const Vector3d on(normal, limit * std::cos(angle), limit * std::sin(angle));
        PointState<3> sticks = stateOf<3>(law, Vector3d(normal, 0, 0));
        ASSERT_TRUE(sticks.sticks());
        const PieceSide<3> side = roundSide(shearLimit(law, sticks), sticks, on);
        EXPECT_LT((forceOn<3>(law, sticks, on).force - forceOn<3>(law, side.beyond, on).force).norm(), 1e-14);
        // Derivatives differ by a multiple of the side's normal, so that a change of state is one of rank 1.
        const Eigen::Matrix3d jump =
            forceOn<3>(law, side.beyond, on).derivative - forceOn<3>(law, sticks, on).derivative;
        const Eigen::Matrix3d ofNormal =
            jump * side.normal * side.normal.transpose() / side.normal.squaredNorm();
        EXPECT_LT((jump - ofNormal).norm(), 1e-14);
        // The tangent of a point that slides has the law's force and derivative where it touches.
        const Vector3d outside = on + Vector3d(0, on[1], on[2]) * std::abs(symmetric(random));
        const PointState<3> slides = stateOf<3>(law, outside);
        const PointForce<3> tangent = forceOn<3>(law, slides, outside);
        EXPECT_NEAR(tangent.force.tail<2>().norm(), limit, 1e-14);
        for (int i = 0; i < 3; ++i)
        {
            const Vector3d moved = outside + 1e-7 * Vector3d::Unit(i);
            const Vector3d change = forceOn<3>(law, stateOf<3>(law, moved), moved).force - tangent.force;
            if (std::abs(normal + law.tension) > 1e-6 && (outside - on).norm() > 1e-6)
            {
                EXPECT_LT((change / 1e-7 - tangent.derivative.col(i)).norm(), 1e-5) << "trial " << trial;
            }
        }
    }
}

TEST(ContactPathInSpace, ABlockPushedHarderThanFrictionSlidesAlongThePushWithoutRising)
{
    for (const double angle : {0.0, 0.4, 2.0, -2.5})
    {
        for (const double stiffness : {1e4, 1e8})
        {
            SpaceConeProgram program = cubes(1, 0.3);
            const Vector3d push = 0.5 * Vector3d(std::cos(angle), std::sin(angle), 0);
            program.load.head<3>() += push;
            // Where it acts there is no moment about the joint's level: the block does not tilt.
            program.load.segment<3>(3) = -0.5 * Vector3d::UnitZ().cross(0.3 * push.normalized());
            SymbolicAnalysis symbolic;
            const ConeSolution near = solveInteriorPoint(program, {1e-9, 100, 3}); // rises
            ContactPath<6, 3> path(program, near, {Sliding::coulomb, stiffness, 1e-14, 100}, symbolic);
            ASSERT_TRUE(path.follow(program)) << angle;
            const VectorXd y = path.displacement();
            // As it gives way it falls, which takes its inertia from the weight on the joint.
            const double way = 0.2 + 0.3 * 0.25 / stiffness;
            EXPECT_LT((y.head<2>() - way * push.normalized().head<2>()).norm(), 1e-3 / stiffness) << angle;
            EXPECT_NEAR(y[2], -0.25 / stiffness, 2e-3 / stiffness)
                << angle; // each corner gives way under 1/4
            EXPECT_LT(errorOf(program, stiffness, y, path.contactForce()), 1e-6);
        }
    }
}

TEST(ContactPathInSpace, FollowsRandomStacks)
{
    constexpr double stiffness = 1e7;
    std::mt19937 random(11);
    std::uniform_real_distribution<double> symmetric(-1, 1);
    int solved = 0;
    long factorisations = 0;
    for (int trial = 0; trial < 200; ++trial)
    {
        SpaceConeProgram program = cubes(6, 0.3);
        for (int body = 0; body < program.bodies; ++body)
        {
            program.load.segment<3>(6 * body) +=
                Vector3d(0.7 * symmetric(random), 0.7 * symmetric(random), 0.5 * symmetric(random));
            program.load[6 * body + 5] += 0.2 * symmetric(random); // a moment about the vertical
        }
        const ConeSolution near = solveInteriorPoint(program, {1e-9, 100, 3});
        ASSERT_EQ(near.status, SolveStatus::optimal);
        SymbolicAnalysis symbolic;
        ContactPath<6, 3> path(program, near, {Sliding::coulomb, stiffness, 1e-12, 1000}, symbolic);
        if (path.follow(program))
        {
            ++solved;
            factorisations += path.factorisations();
            EXPECT_LT(errorOf(program, stiffness, path.displacement(), path.contactForce()), 1e-6)
                << "stack " << trial;
        }
    }
    RecordProperty("factorisations", std::to_string(factorisations));
    RecordProperty("solved", solved);
    EXPECT_GE(solved, 190) << "of 200";
}

TEST(ContactPathInSpace, TheAssociativeLawIsRefused)
{
    const SpaceConeProgram program = cubes(1, 0.3);
    SymbolicAnalysis symbolic;
    EXPECT_THROW(
        (ContactPath<6, 3>(program, nothing(program), {Sliding::associative, 1e6, 1e-12, 100}, symbolic)),
        std::invalid_argument);
}

} // namespace
} // namespace drystone
