// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The symmetric positive definite systems that all solvers spend their time in: S = Mbar + sum_k A_k D_k
/// A_k', one small dense block a body and one a pair of touching bodies.
#pragma once

#include "linear/BlockCholesky.h"
#include "linear/EliminationOrder.h"
#include "linear/FrontalCholesky.h"

#include <Eigen/Core>

#include <optional>
#include <vector>

namespace drystone
{

/// A block-sparse symmetric matrix and its Cholesky factor. The pattern is analysed once, in the constructor;
/// then any number of times: setZero, add, factorise, solve. Bodies are expected in elimination order:
/// nothing is permuted here.
///
/// Memory: the factor and at most as much again; for a wall of N x N bodies about 31 N^2 log2 N blocks. Not
/// thread-safe.
template<int Rows, class Scalar = double>
class SchurSystem
{
public:
    using Block = Eigen::Matrix<Scalar, Rows, Rows>;
    using Vector = Eigen::Matrix<Scalar, Eigen::Dynamic, 1>;

    /// \param couplings pairs (a, b), a != b, of bodies numbered in elimination order
    SchurSystem(int bodies, const std::vector<Coupling>& couplings);

    int bodies() const { return bodyCount; }

    /// Multiplications of a factorisation.
    double operations() const { return operationCount; }

    /// The same over those of a solve.
    double factorisationOverSolve() const { return costOverSolve; }

    /// Where the block of a pair is kept, for `coupling`. \throws std::out_of_range for a pair not in the
    /// pattern
    int slot(int first, int second) const { return pattern.slot(first, second); }

    void setZero();
    /// Diagonal block of a body.
    Block& diagonal(int body) { return values[pattern.columnStart[body]]; }
    /// Block with the rows of the later and the columns of the earlier body of a pair.
    Block& coupling(int slot) { return values[slot]; }

    /// Factorises S as it stands. \return false when S is not numerically positive definite
    bool factorise();

    /// Solves S x = x in place, Rows * bodies entries.
    void solve(Eigen::Ref<Vector> x);
    /// Solves for two right sides at once, which takes little longer than for one: most of the time goes into
    /// fetching the factor.
    void solve(Eigen::Ref<Vector> one, Eigen::Ref<Vector> other);
    /// Solves in place as well as a factor in single precision does, which takes half the time in systems of
    /// some thousand bodies; smaller and larger ones are solved as by `solve`.
    void solveRoughly(Eigen::Ref<Vector> x);

private:
    int bodyCount = 0;
    double operationCount = 0;
    double costOverSolve = 0;
    BlockPattern pattern;
    std::vector<Block, Eigen::aligned_allocator<Block>> values;
    std::optional<BlockCholesky<Rows, Scalar>> small; ///< this factor,
    std::optional<FrontalCholesky<Rows>> large;       ///< or this one, of doubles only
};

extern template class SchurSystem<3>;
extern template class SchurSystem<6>;
extern template class SchurSystem<3, DoubleDouble>;
extern template class SchurSystem<6, DoubleDouble>;

} // namespace drystone
