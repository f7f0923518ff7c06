// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The law of one point on a collapse path: its derivative is that of its force, and it is left where the
/// next piece begins.
#include "conic/coulomb/CollapsePiece.h"

#include <gtest/gtest.h>

#include <random>

namespace drystone
{
namespace
{

template<int Forces>
CollapsePiece<Forces> pieceOf(const Strength& strength, double friction, double dilatancy)
{
    CollapsePiece<Forces> piece;
    piece.friction = friction;
    piece.dilatancy = dilatancy;
    piece.strength = strength;
    return piece;
}

template<int Forces>
Eigen::Matrix<double, Forces, 1> drawn(std::mt19937& random)
{
    std::uniform_real_distribution<double> symmetric(-2, 2);
    Eigen::Matrix<double, Forces, 1> force;
    for (double& entry : force)
    {
        entry = symmetric(random);
    }
    return force;
}

/// A piece by its kind, which find() would choose for forces within the limits only.
template<int Forces>
void checkDerivative(CollapsePiece<Forces> piece, const Eigen::Matrix<double, Forces, 1>& w)
{
    constexpr double step = 1e-6;
    const auto derivative = piece.derivative(w);
    for (int i = 0; i < Forces; ++i)
    {
        Eigen::Matrix<double, Forces, 1> ahead = w;
        Eigen::Matrix<double, Forces, 1> behind = w;
        ahead[i] += step;
        behind[i] -= step;
        const Eigen::Matrix<double, Forces, 1> difference =
            (piece.force(ahead) - piece.force(behind)) / (2 * step);
        EXPECT_LE((derivative.col(i) - difference).template lpNorm<Eigen::Infinity>(), 1e-7)
            << "column " << i << " at " << w.transpose();
    }
}

template<int Forces>
void checkDerivatives()
{
    using Piece = CollapsePiece<Forces>;
    std::mt19937 random(1);
    for (int i = 0; i < 200; ++i)
    {
        Piece piece = pieceOf<Forces>({0.5, 0.3, 4}, 0.6, i % 2 == 0 ? 0 : 0.2);
        const auto w = drawn<Forces>(random);
        for (const auto normal : {Piece::Normal::open, Piece::Normal::presses, Piece::Normal::crushes})
        {
            for (const bool isSliding : {false, true})
            {
                piece.normal = normal;
                piece.isSliding = isSliding;
                // Away from where the limit of shear is cut off at zero.
                if (Piece::shearOf(w) > 0.1 && piece.strength.cohesion + 0.6 * piece.normalForce(w) > 0.01)
                {
                    checkDerivative<Forces>(piece, w);
                }
            }
        }
    }
}

TEST(CollapsePiece, DerivativesAreThoseOfTheForce)
{
    checkDerivatives<2>();
    checkDerivatives<3>();
}

TEST(CollapsePiece, SticksUpToTheLimitAndSlidesBeyond)
{
    auto piece = pieceOf<2>({}, 0.5, 0);
    piece.find({2, 0.9});
    EXPECT_FALSE(piece.isSliding);
    EXPECT_EQ(piece.force({2, 0.9}), Eigen::Vector2d(2, 0.9));
    const auto exit = piece.exit({2, 0.9}, {0, 1}, 0);
    EXPECT_EQ(exit.boundary, Boundary::sliding);
    EXPECT_NEAR(exit.distance, 0.1, 1e-15);
    piece.cross(exit.boundary);
    EXPECT_TRUE(piece.isSliding);
    EXPECT_NEAR(piece.force({2, 3})[1], 1, 1e-15);
}

TEST(CollapsePiece, AnOpenPointWithoutCohesionHasNoSay)
{
    auto piece = pieceOf<3>({}, 0.5, 0);
    piece.find({-1, 0.2, 0});
    EXPECT_TRUE(piece.isFree());
    EXPECT_TRUE(piece.force({-1, 0.2, 0}).isZero(1e-15));
    EXPECT_TRUE(piece.derivative({-1, 0.2, 0}).isZero(0));
    const auto exit = piece.exit({-1, 0.2, 0}, {0.5, 0, 0}, 0);
    EXPECT_EQ(exit.boundary, Boundary::opening);
    EXPECT_NEAR(exit.distance, 2, 1e-15);
}

TEST(CollapsePiece, DilatancyPressesByTheSlip)
{
    // c_n = w_n + psi lambda, |c_t| = mu c_n, lambda = |w_t| - |c_t|.
    auto piece = pieceOf<2>({}, 0.5, 0.2);
    piece.isSliding = true;
    const Eigen::Vector2d w(1, 2);
    const Eigen::Vector2d force = piece.force(w);
    const double slip = w[1] - force[1];
    EXPECT_NEAR(force[0], w[0] + 0.2 * slip, 1e-15);
    EXPECT_NEAR(force[1], 0.5 * force[0], 1e-15);
}

/// Hard: through the round cone of space, from everywhere, in and out again.
TEST(CollapsePiece, InSpaceTheExitIsOnTheCone)
{
    std::mt19937 random(3);
    int met = 0;
    for (int i = 0; i < 2000; ++i)
    {
        auto piece = pieceOf<3>({0.4, 0.2, std::numeric_limits<double>::infinity()}, 0.7, 0);
        Eigen::Vector3d w = drawn<3>(random);
        w[0] = std::abs(w[0]);
        piece.find(w);
        const Eigen::Vector3d rate = drawn<3>(random);
        const auto exit = piece.exit(w, rate, 0);
        if (exit.boundary == Boundary::sliding)
        {
            ++met;
            const Eigen::Vector3d there = w + exit.distance * rate;
            EXPECT_NEAR(piece.shearOf(there), piece.slidingLimit(there), 1e-10);
            EXPECT_LT(piece.rateWithin(Boundary::sliding, there, rate), 1e-10);
        }
        else if (exit.boundary == Boundary::opening)
        {
            EXPECT_NEAR((w + exit.distance * rate)[0], -0.2, 1e-10);
        }
    }
    EXPECT_GT(met, 500);
}

} // namespace
} // namespace drystone
