// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Forces followed from those of a start: the pieces of the joint laws, closed forms, stacks whose answers
/// are judged by the laws themselves, and what a warm start costs.
#include "conic/coulomb/ContactPath.h"

#include "Stacks.h"
#include "conic/InteriorPoint.h"

#include <Eigen/LU>
#include <gtest/gtest.h>

#include <random>

namespace drystone
{
namespace
{

ConeSolution nothing(const PlaneConeProgram& program)
{
    ConeSolution start;
    start.displacement = Eigen::VectorXd::Zero(program.load.size());
    start.contactForce = Eigen::VectorXd::Zero(2 * program.points());
    return start;
}

/// What the equations of motion and the laws leave, from the laws' own words: equations relative to the
/// weight 1, forces by which points with w = k (A'y - g) miss their law.
double errorOf(const PlaneConeProgram& program, Sliding sliding, double stiffness, const Eigen::VectorXd& y,
               const Eigen::VectorXd& c)
{
    double error =
        (applyInertia(program, y) + applyEquilibrium(program, c) - program.load).lpNorm<Eigen::Infinity>();
    const Eigen::VectorXd w = stiffness * (applyTransposed(program, y) - program.gap);
    for (int point = 0; point < program.points(); ++point)
    {
        const double mu = program.friction[static_cast<std::size_t>(point)];
        const double n = w[2 * point];
        const double t = w[2 * point + 1];
        Eigen::Vector2d law(std::max(0.0, n), 0);
        if (sliding == Sliding::coulomb)
        {
            law[1] = std::clamp(t, -mu * law[0], mu * law[0]);
        }
        else if (std::abs(t) <= mu * n)
        {
            law[1] = t;
        }
        else
        {
            const Eigen::Vector2d edge(1, t < 0 ? -mu : mu);
            law = std::max(0.0, edge.dot(w.segment<2>(2 * point)) / edge.squaredNorm()) * edge;
        }
        error = std::max(error, (c.segment<2>(2 * point) - law).lpNorm<Eigen::Infinity>());
    }
    return error;
}

TEST(SlidingLaw, IsContinuousAcrossTheSidesOfItsPieces)
{
    std::mt19937 random(5);
    std::uniform_real_distribution<double> symmetric(-1, 1);
    for (int trial = 0; trial < 2000; ++trial)
    {
        const bool isAssociative = trial % 2 == 0;
        const double mu = 0.1 + std::abs(symmetric(random));
        const double tension = isAssociative || trial % 4 == 1 ? 0 : std::abs(symmetric(random));
        const SlidingLaw law{isAssociative ? Sliding::associative : Sliding::coulomb, mu,
                             tension > 0 ? (mu + 0.1) * tension : 0, tension};
        const Eigen::Vector2d w(symmetric(random), symmetric(random));
        const PointState<2> state = stateOf<2>(law, w);
        const PieceSides<2> sides = sidesOf<2>(law, state);
        for (int i = 0; i < sides.count; ++i)
        {
            const PieceSide<2>& side = sides.side[static_cast<std::size_t>(i)];
            const double inside = side.normal.dot(w) + side.offset;
            EXPECT_LE(inside, 1e-15) << "trial " << trial;
            // The nearest point on the side: both pieces have the same force there, if it is on the piece.
            const Eigen::Vector2d on = w - inside / side.normal.squaredNorm() * side.normal;
            bool isOnPiece = true;
            for (int j = 0; j < sides.count; ++j)
            {
                const PieceSide<2>& other = sides.side[static_cast<std::size_t>(j)];
                isOnPiece = isOnPiece && other.normal.dot(on) + other.offset <= 1e-12;
            }
            if (isOnPiece && (law.cohesion > 0 || isAssociative || state.presses()))
            {
                const Eigen::Vector2d here = forceOn<2>(law, state, on).force;
                const Eigen::Vector2d beyond = forceOn<2>(law, side.beyond, on).force;
                EXPECT_LT((here - beyond).norm(), 1e-12) << "trial " << trial << " side " << i;
            }
        }
    }
}

TEST(ContactPath, ABlockPushedHarderThanFrictionSlidesWithoutRising)
{
    for (const double push : {0.6, -0.6})
    {
        for (const double stiffness : {1e4, 1e8})
        {
            const PlaneConeProgram program = lowBlock(push, 1, 0.4);
            SymbolicAnalysis symbolic;
            ContactPath<3, 2> path(program, nothing(program), {Sliding::coulomb, stiffness, 1e-14, 100},
                                   symbolic);
            ASSERT_TRUE(path.follow(program));
            EXPECT_NEAR(path.displacement()[0], (push > 0 ? 0.2 : -0.2) / 2, 2 / stiffness);
            EXPECT_NEAR(path.displacement()[1], 0, 2 / stiffness);
            EXPECT_NEAR(path.contactForce()[0] + path.contactForce()[2], 1, 1e-3);
            EXPECT_LT(errorOf(program, Sliding::coulomb, stiffness, path.displacement(), path.contactForce()),
                      1e-7);
        }
    }
}

TEST(ContactPath, FollowsRandomStacksByEitherLaw)
{
    constexpr double stiffness = 1e7;
    for (const Sliding sliding : {Sliding::coulomb, Sliding::associative})
    {
        std::mt19937 random(11);
        int solved = 0;
        for (int trial = 0; trial < 200; ++trial)
        {
            const PlaneConeProgram program = pushedStack(6, random);
            const ConeSolution near = solveInteriorPoint(program, {1e-9, 100, 3});
            ASSERT_EQ(near.status, SolveStatus::optimal);
            SymbolicAnalysis symbolic;
            ContactPath<3, 2> path(program, near, {sliding, stiffness, 1e-12, 1000}, symbolic);
            if (!path.follow(program))
            {
                continue;
            }
            ++solved;
            const Eigen::VectorXd y = path.displacement();
            EXPECT_LT(errorOf(program, sliding, stiffness, y, path.contactForce()), 1e-6)
                << "stack " << trial;
            if (sliding == Sliding::associative)
            {
                // Displacements of rigid points are unique: those of stiff ones are as near as 1/k.
                EXPECT_LT((y - near.displacement).lpNorm<Eigen::Infinity>(), 1e-5) << "stack " << trial;
            }
        }
        EXPECT_GE(solved, 198) << "of 200";
    }
}

// From points of 0.6 N/m, whose forces are those of one solution.
TEST(ContactPath, StiffensRandomStacksGraduallyToTheForcesOfStiffPoints)
{
    constexpr double stiffness = 1e7;
    constexpr double soft = stiffness / 16777216;
    std::mt19937 random(11);
    int alike = 0;
    for (int trial = 0; trial < 200; ++trial)
    {
        const PlaneConeProgram program = pushedStack(6, random);
        SymbolicAnalysis symbolic;
        const ConeSolution near = solveInteriorPoint(program, {1e-9, 100, 3});
        ContactPath<3, 2> path(program, near, {Sliding::coulomb, soft, 1e-12, 1000}, symbolic);
        ASSERT_TRUE(path.follow(program)) << "stack " << trial;
        EXPECT_LT(errorOf(program, Sliding::coulomb, soft, path.displacement(), path.contactForce()), 1e-9);
        ASSERT_TRUE(path.stiffen(stiffness)) << "stack " << trial;
        ASSERT_TRUE(path.follow(program)) << "stack " << trial;
        EXPECT_LT(errorOf(program, Sliding::coulomb, stiffness, path.displacement(), path.contactForce()),
                  1e-6)
            << "stack " << trial;
        ContactPath<3, 2> direct(program, near, {Sliding::coulomb, stiffness, 1e-12, 1000}, symbolic);
        alike += direct.follow(program)
                 && (direct.displacement() - path.displacement()).lpNorm<Eigen::Infinity>() < 1e-9;
    }
    EXPECT_GE(alike, 190) << "of 200: by Coulomb's law there may be several solutions";
}

TEST(ContactPath, DoesNotStiffenBeyondTheChangesOfStateAllowed)
{
    std::mt19937 random(11);
    const PlaneConeProgram program = pushedStack(6, random);
    SymbolicAnalysis symbolic;
    const ConeSolution near = solveInteriorPoint(program, {1e-9, 100, 3});
    ContactPathSettings settings{Sliding::coulomb, 0.6, 1e-12, 1000};
    settings.maximumFactorisations = 3;
    ContactPath<3, 2> path(program, near, settings, symbolic);
    EXPECT_FALSE(path.follow(program) && path.stiffen(1e7));
}

TEST(ContactPath, GoesOnFromItsOwnForcesByOneFactorisation)
{
    std::mt19937 random(3);
    PlaneConeProgram program = pushedStack(8, random);
    const ConeSolution near = solveInteriorPoint(program, {1e-9, 100, 3});
    SymbolicAnalysis symbolic;
    const ContactPathSettings settings{Sliding::coulomb, 1e6, 1e-12, 1000};
    ContactPath<3, 2> first(program, near, settings, symbolic);
    ASSERT_TRUE(first.follow(program));
    program.load *= 1 + 1e-9;
    ConeSolution last;
    last.contactForce = first.contactForce();
    last.displacement = first.displacement();
    ContactPath<3, 2> second(program, last, settings, symbolic);
    ASSERT_TRUE(second.follow(program));
    EXPECT_EQ(second.factorisations(), 1);
    EXPECT_EQ(second.pivots, 0);
    // Nor do gaps that are a little different take another one.
    program.gap.array() += 1e-12;
    ASSERT_TRUE(second.follow(program));
    EXPECT_EQ(second.factorisations(), 1);
    EXPECT_LT(
        errorOf(program, Sliding::coulomb, settings.stiffness, second.displacement(), second.contactForce()),
        1e-7);
}

TEST(ContactPath, IsNotReachedWhereItsTimeIsOver)
{
    std::mt19937 random(3);
    const PlaneConeProgram program = pushedStack(8, random);
    SymbolicAnalysis symbolic;
    ContactPathSettings settings{Sliding::coulomb, 1e4, 1e-12, 1000};
    ContactPath<3, 2> whole(program, nothing(program), settings, symbolic);
    ASSERT_TRUE(whole.follow(program));
    ASSERT_GT(whole.pivots, 3);
    int asked = 0;
    settings.isOver = [&asked] { return ++asked == 3; };
    ContactPath<3, 2> ended(program, nothing(program), settings, symbolic);
    EXPECT_FALSE(ended.follow(program));
    EXPECT_EQ(ended.pivots, 3);
}

TEST(ContactPath, WhatItCannotTakeIsRefused)
{
    PlaneConeProgram program = lowBlock(0.3, 1, 0.4);
    SymbolicAnalysis symbolic;
    EXPECT_THROW((ContactPath<3, 2>(program, {}, {}, symbolic)), std::invalid_argument);
    PlaneConeProgram statics = program;
    statics.inertia.clear();
    EXPECT_THROW((ContactPath<3, 2>(statics, nothing(statics), {}, symbolic)), std::invalid_argument);
    program.compliance = Eigen::VectorXd::Constant(4, 1e-3);
    EXPECT_THROW((ContactPath<3, 2>(program, nothing(program), {}, symbolic)), std::invalid_argument);
}

/// S of random round cones in space, by hand.
TEST(ContactSystem, SolvesInSpaceWhatADenseFactorisationSolves)
{
    std::mt19937 random(7);
    std::uniform_real_distribution<double> symmetric(-1, 1);
    for (const Sliding sliding : {Sliding::coulomb, Sliding::associative})
    {
        SpaceConeProgram program;
        program.bodies = 5;
        Eigen::MatrixXd A = Eigen::MatrixXd::Zero(30, 12 * 3);
        Eigen::MatrixXd inertia = Eigen::MatrixXd::Zero(30, 30);
        for (int body = 0; body < program.bodies; ++body)
        {
            const Eigen::Matrix<double, 6, 6> root =
                Eigen::Matrix<double, 6, 6>::NullaryExpr([&] { return symmetric(random); });
            program.inertia.push_back(root * root.transpose() + Eigen::Matrix<double, 6, 6>::Identity());
            inertia.block<6, 6>(6 * body, 6 * body) = program.inertia.back();
        }
        Eigen::MatrixXd D = Eigen::MatrixXd::Zero(36, 36);
        std::vector<PointForce<3>> pieces;
        Eigen::VectorXd rho(12);
        for (int point = 0; point < 12; ++point)
        {
            ConeColumns<6, 3> columns;
            columns.first = point % 5;
            columns.second = point % 4 == 3 ? -1 : (point + 2) % 5;
            columns.onFirst = columns.onFirst.NullaryExpr([&] { return symmetric(random); });
            columns.onSecond = columns.onSecond.NullaryExpr([&] { return symmetric(random); });
            program.contacts.push_back(columns);
            program.friction.push_back(0.5);
            A.block<6, 3>(6 * columns.first, 3 * point) = columns.onFirst;
            if (columns.second >= 0)
            {
                A.block<6, 3>(6 * columns.second, 3 * point) = columns.onSecond;
            }
            const SlidingLaw law{sliding, 0.5, 0, 0};
            const Eigen::Vector3d w(symmetric(random), symmetric(random), symmetric(random));
            pieces.push_back(forceOn<3>(law, stateOf<3>(law, w), w));
            rho[point] = 1 + std::abs(symmetric(random));
            D.block<3, 3>(3 * point, 3 * point) = rho[point] * pieces.back().derivative;
            // The derivative is that of the force.
            for (int i = 0; i < 3; ++i)
            {
                const Eigen::Vector3d moved = w + 1e-7 * Eigen::Vector3d::Unit(i);
                const Eigen::Vector3d change =
                    forceOn<3>(law, stateOf<3>(law, moved), moved).force - pieces.back().force;
                EXPECT_LT((change / 1e-7 - pieces.back().derivative.col(i)).norm(), 1e-4);
            }
        }
        program.load = Eigen::VectorXd::Zero(30);
        SymbolicAnalysis symbolic;
        ContactSystem<6, 3> system(program, sliding, symbolic);
        ASSERT_TRUE(system.factorise(rho, pieces));
        const Eigen::VectorXd right = Eigen::VectorXd::NullaryExpr(30, [&] { return symmetric(random); });
        const Eigen::VectorXd solved = system.displacementOf(system.solve(system.scaledRows(right)));
        const Eigen::MatrixXd whole = inertia + A * D * A.transpose();
        EXPECT_LT((solved - whole.partialPivLu().solve(right)).lpNorm<Eigen::Infinity>(), 1e-12);
    }
}

} // namespace
} // namespace drystone
