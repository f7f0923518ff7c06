// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
#include "linear/SchurSystem.h"

#include "core/Threads.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace drystone
{
namespace
{

/// A positive definite matrix of blocks, by blocks and as a whole.
template<int Rows>
struct TestMatrix
{
    using Block = Eigen::Matrix<double, Rows, Rows>;

    BlockPattern pattern;
    std::vector<Block> values;
    Eigen::MatrixXd dense;

    TestMatrix(int bodies, const std::vector<Coupling>& couplings, std::mt19937& random)
        : pattern(makeBlockPattern(bodies, couplings)),
          values(pattern.row.size(), Block::Zero()),
          dense(Eigen::MatrixXd::Zero(Rows * bodies, Rows * bodies))
    {
        std::uniform_real_distribution<double> uniform(-1, 1);
        for (int body = 0; body < bodies; ++body)
        {
            for (int entry = pattern.columnStart[body]; entry < pattern.columnStart[body + 1]; ++entry)
            {
                Block& block = values[entry];
                if (pattern.row[entry] == body)
                {
                    block.diagonal().setConstant(9);
                }
                else
                {
                    block = Block::NullaryExpr([&] { return uniform(random) / std::min(bodies, 30); });
                }
                dense.block<Rows, Rows>(Rows * pattern.row[entry], Rows * body) = block;
                dense.block<Rows, Rows>(Rows * body, Rows * pattern.row[entry]) = block.transpose();
            }
        }
    }

    /// By how much a factor's solutions miss two right sides: one after the other, and both at once.
    template<class Factor>
    double error(Factor& factor) const
    {
        const Eigen::VectorXd one = Eigen::VectorXd::Random(dense.rows());
        const Eigen::VectorXd other = Eigen::VectorXd::Random(dense.rows());
        Eigen::VectorXd x = one;
        factor.solve(x);
        double worst = (dense * x - one).norm();
        Eigen::VectorXd y = one;
        Eigen::VectorXd z = other;
        factor.solve(y, z);
        worst = std::max({worst, (dense * y - one).norm(), (dense * z - other).norm()});
        return worst / one.norm();
    }
};

/// Every body on the one before and on one at random, in no good order: the factor is soon full.
std::vector<Coupling> tangled(int bodies, std::mt19937& random)
{
    std::vector<Coupling> couplings;
    for (int body = 1; body < bodies; ++body)
    {
        couplings.push_back({body - 1, body});
        couplings.push_back({static_cast<int>(random() % body), body});
    }
    return couplings;
}

/// A wall of so many blocks each way, in a good order of elimination or by courses.
std::vector<Coupling> wall(int blocks, bool inGoodOrder)
{
    std::vector<Coupling> couplings;
    for (int course = 0; course < blocks; ++course)
    {
        for (int block = 0; block < blocks; ++block)
        {
            const int body = course * blocks + block;
            if (block > 0)
            {
                couplings.push_back({body - 1, body});
            }
            if (course > 0)
            {
                couplings.push_back({body - blocks, body});
            }
        }
    }
    if (inGoodOrder)
    {
        const std::vector<int> order = eliminationOrder(blocks * blocks, couplings);
        std::vector<int> position(order.size());
        for (std::size_t place = 0; place < order.size(); ++place)
        {
            position[order[place]] = static_cast<int>(place);
        }
        for (Coupling& pair : couplings)
        {
            pair = {position[pair[0]], position[pair[1]]};
        }
    }
    return couplings;
}

/// Both factors of one matrix.
template<int Rows>
void expectBothSolve(int bodies, const std::vector<Coupling>& couplings, std::mt19937& random)
{
    SCOPED_TRACE(bodies);
    const TestMatrix<Rows> matrix(bodies, couplings, random);
    const FactorPattern pattern = makeFactorPattern(matrix.pattern);
    BlockCholesky<Rows> blocks(pattern);
    FrontalCholesky<Rows> fronts(matrix.pattern, pattern.factor);
    for (int time = 0; time < 2; ++time) // the second finds what the first has left
    {
        ASSERT_TRUE(blocks.factorise(matrix.pattern, matrix.values.data()));
        EXPECT_LE(matrix.error(blocks), 1e-13);
        ASSERT_TRUE(fronts.factorise(matrix.pattern, matrix.values.data()));
        EXPECT_LE(matrix.error(fronts), 1e-13);
    }
}

TEST(SchurSystem, BothFactorsSolveTangledSystems)
{
    std::mt19937 random(7);
    for (const int bodies : {1, 2, 7, 60, 200})
    {
        expectBothSolve<3>(bodies, tangled(bodies, random), random);
        expectBothSolve<6>(bodies, tangled(bodies, random), random);
    }
}

TEST(SchurSystem, BothFactorsSolveWalls)
{
    std::mt19937 random(8);
    for (const int blocks : {3, 10, 25})
    {
        expectBothSolve<3>(blocks * blocks, wall(blocks, true), random);
        expectBothSolve<3>(blocks * blocks, wall(blocks, false), random);
        expectBothSolve<6>(blocks * blocks, wall(blocks, true), random);
    }
}

// Bodies that nothing couples are trees of their own.
TEST(SchurSystem, BothFactorsSolveSystemsInSeveralParts)
{
    std::mt19937 random(9);
    std::vector<Coupling> couplings = wall(6, false);
    for (const Coupling& pair : wall(5, false))
    {
        couplings.push_back({pair[0] + 40, pair[1] + 40});
    }
    expectBothSolve<3>(70, couplings, random);
}

TEST(SchurSystem, TakesTheFactorThatFitsTheSize)
{
    std::mt19937 random(10);
    for (const int blocks : {4, 30})
    {
        const std::vector<Coupling> couplings = wall(blocks, true);
        const TestMatrix<3> matrix(blocks * blocks, couplings, random);
        SchurSystem<3> system(blocks * blocks, couplings);
        system.setZero();
        for (int body = 0; body < blocks * blocks; ++body)
        {
            system.diagonal(body) = matrix.dense.block<3, 3>(3 * body, 3 * body);
        }
        for (const Coupling& pair : couplings)
        {
            system.coupling(system.slot(pair[0], pair[1])) =
                matrix.dense.block<3, 3>(3 * std::max(pair[0], pair[1]), 3 * std::min(pair[0], pair[1]));
        }
        ASSERT_TRUE(system.factorise());
        EXPECT_LE(matrix.error(system), 1e-13);
    }
}

// Small factors are not rounded, large ones are; a second matrix is not solved with what is left of the
// first.
TEST(SchurSystem, SolvesRoughlyToSinglePrecision)
{
    std::mt19937 random(12);
    for (const int bodies : {60, 600})
    {
        const TestMatrix<3> matrix(bodies, tangled(bodies, random), random);
        FrontalCholesky<3> fronts(matrix.pattern, makeFactorPattern(matrix.pattern).factor);
        for (const double scale : {1.0, 3.0})
        {
            std::vector<Eigen::Matrix3d> values = matrix.values;
            for (Eigen::Matrix3d& block : values)
            {
                block *= scale;
            }
            ASSERT_TRUE(fronts.factorise(matrix.pattern, values.data()));
            const Eigen::VectorXd right = Eigen::VectorXd::Random(3 * bodies);
            Eigen::VectorXd x = right;
            fronts.solveRoughly(x);
            const double error = (scale * matrix.dense * x - right).norm() / right.norm();
            EXPECT_LE(error, 1e-6);
            EXPECT_EQ(error > 1e-12, bodies == 600);
        }
    }
}

/// The solutions of one matrix by so many threads, one after the other, two at once and roughly.
template<int Rows>
Eigen::VectorXd solutionsWith(int count, const TestMatrix<Rows>& matrix, const FactorPattern& pattern)
{
    setThreads(count);
    FrontalCholesky<Rows> fronts(matrix.pattern, pattern.factor);
    EXPECT_TRUE(fronts.factorise(matrix.pattern, matrix.values.data()));
    const auto size = static_cast<Eigen::Index>(Rows) * matrix.pattern.columns();
    Eigen::VectorXd all(4 * size);
    all.head(size) = Eigen::VectorXd::LinSpaced(size, -1, 2);
    all.segment(size, size) = all.head(size);
    all.segment(2 * size, size).setLinSpaced(3, 5);
    all.tail(size) = all.head(size);
    fronts.solve(all.head(size));
    fronts.solve(all.segment(size, size), all.segment(2 * size, size));
    fronts.solveRoughly(all.tail(size));
    setThreads(1);
    return all;
}

// Large enough for tasks and for fronts that several threads share: walls have many of the former, tangled
// systems one of the latter.
template<int Rows>
void expectSameBits(const TestMatrix<Rows>& matrix)
{
    const FactorPattern pattern = makeFactorPattern(matrix.pattern);
    const Eigen::VectorXd alone = solutionsWith(1, matrix, pattern);
    for (const int count : {2, 4, 2})
    {
        EXPECT_TRUE(alone == solutionsWith(count, matrix, pattern)) << count << " threads";
    }
    const Eigen::Index size = alone.size() / 4;
    const Eigen::VectorXd right = Eigen::VectorXd::LinSpaced(size, -1, 2);
    EXPECT_LE((matrix.dense * alone.head(size) - right).norm() / right.norm(), 1e-12);
    EXPECT_LE((matrix.dense * alone.segment(size, size) - right).norm() / right.norm(), 1e-12);
}

TEST(SchurSystem, SolutionsAreTheSameWhateverTheNumberOfThreads)
{
    std::mt19937 random(13);
    expectSameBits(TestMatrix<3>(45 * 45, wall(45, true), random));
    expectSameBits(TestMatrix<3>(700, tangled(700, random), random));
    expectSameBits(TestMatrix<6>(25 * 25, wall(25, true), random));
    expectSameBits(TestMatrix<6>(350, tangled(350, random), random));
}

TEST(SchurSystem, NeitherFactorTakesAMatrixThatIsNotPositiveDefinite)
{
    std::mt19937 random(11);
    TestMatrix<3> matrix(100, wall(10, true), random);
    const FactorPattern pattern = makeFactorPattern(matrix.pattern);
    BlockCholesky<3> blocks(pattern);
    FrontalCholesky<3> fronts(matrix.pattern, pattern.factor);
    for (const int body : {0, 57, 99})
    {
        Eigen::Matrix3d& diagonal = matrix.values[matrix.pattern.columnStart[body]];
        const Eigen::Matrix3d before = diagonal;
        for (const double wrong : {-1.0, 0.0, std::numeric_limits<double>::quiet_NaN()})
        {
            diagonal(1, 1) = wrong;
            EXPECT_FALSE(blocks.factorise(matrix.pattern, matrix.values.data())) << body << ' ' << wrong;
            EXPECT_FALSE(fronts.factorise(matrix.pattern, matrix.values.data())) << body << ' ' << wrong;
        }
        diagonal = before;
    }
    ASSERT_TRUE(fronts.factorise(matrix.pattern, matrix.values.data())); // and none of it is left
    EXPECT_LE(matrix.error(fronts), 1e-13);
}

} // namespace
} // namespace drystone
