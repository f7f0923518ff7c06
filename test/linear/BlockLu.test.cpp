// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The sparse block LU factorisation against dense ones.
#include "linear/BlockLu.h"

#include <Eigen/LU>
#include <gtest/gtest.h>

#include <random>

namespace drystone
{
namespace
{

TEST(BlockLu, SolvesWhatADenseFactorisationSolves)
{
    std::mt19937 random(3);
    std::uniform_real_distribution<double> symmetric(-1, 1);
    const int bodies = 40;
    std::vector<Coupling> couplings;
    for (int pair = 0; pair < 80; ++pair)
    {
        const int a = static_cast<int>(random() % bodies);
        const int b = static_cast<int>(random() % bodies);
        if (a != b)
        {
            couplings.push_back({a, b});
        }
    }
    const BlockPattern pattern = makeBlockPattern(bodies, couplings);
    std::vector<Eigen::Matrix3d> lower(pattern.row.size());
    std::vector<Eigen::Matrix3d> upperTransposed(pattern.row.size());
    Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(3 * bodies, 3 * bodies);
    for (int column = 0; column < bodies; ++column)
    {
        for (int entry = pattern.columnStart[column]; entry < pattern.columnStart[column + 1]; ++entry)
        {
            const int row = pattern.row[entry];
            lower[entry] = Eigen::Matrix3d::NullaryExpr([&] { return symmetric(random); });
            upperTransposed[entry] = Eigen::Matrix3d::NullaryExpr([&] { return symmetric(random); });
            if (row == column)
            {
                lower[entry] += 12 * Eigen::Matrix3d::Identity();
            }
            else
            {
                dense.block<3, 3>(3 * column, 3 * row) = upperTransposed[entry].transpose();
            }
            dense.block<3, 3>(3 * row, 3 * column) = lower[entry];
        }
    }
    BlockLu<3> factor(pattern);
    ASSERT_TRUE(factor.factorise(lower, upperTransposed));
    const Eigen::VectorXd right = Eigen::VectorXd::NullaryExpr(3 * bodies, [&] { return symmetric(random); });
    Eigen::VectorXd x = right;
    factor.solve(x);
    EXPECT_LT((x - dense.partialPivLu().solve(right)).lpNorm<Eigen::Infinity>(), 1e-14);

    // Some columns and rows changed: the same to the last bit as from the beginning.
    const std::vector<int> changed{5, 20};
    for (const int column : changed)
    {
        for (int entry = pattern.columnStart[column]; entry < pattern.columnStart[column + 1]; ++entry)
        {
            lower[entry] *= 1.5;
            upperTransposed[entry] *= 0.5;
        }
    }
    ASSERT_TRUE(factor.refactorise(lower, upperTransposed, changed));
    x = right;
    factor.solve(x);
    BlockLu<3> anew(pattern);
    ASSERT_TRUE(anew.factorise(lower, upperTransposed));
    Eigen::VectorXd y = right;
    anew.solve(y);
    EXPECT_EQ(x, y);
}

TEST(BlockLu, ASingularPivotIsNoticed)
{
    const BlockPattern pattern = makeBlockPattern(1, {});
    BlockLu<3> factor(pattern);
    EXPECT_FALSE(factor.factorise({Eigen::Matrix3d::Zero()}, {Eigen::Matrix3d::Zero()}));
}

TEST(BlockPattern, APairThatIsNotThereIsAnError)
{
    const BlockPattern pattern = makeBlockPattern(3, {{0, 2}, {2, 0}});
    EXPECT_EQ(pattern.slot(2, 0), pattern.slot(0, 2));
    EXPECT_THROW(pattern.slot(0, 1), std::out_of_range);
}

} // namespace
} // namespace drystone
