// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Sparse Cholesky factorisation of matrices made of small dense blocks: the factor for small systems.
#pragma once

#include "linear/BlockPattern.h"
#include "linear/DoubleDouble.h"

#include <Eigen/Core>

#include <type_traits>
#include <vector>

namespace drystone
{

/// S = L L' by columns of blocks, left-looking. All arithmetic is on fixed-size blocks held in registers, so
/// that it runs several times faster than a scalar sparse code; beyond some hundred bodies FrontalCholesky
/// wins.
template<int Rows, class Scalar = double>
class BlockCholesky
{
public:
    /// Rows padded to whole vector registers, of numbers that such registers take.
    static constexpr int paddedRows = std::is_same_v<Scalar, double> ? (Rows + 3) / 4 * 4 : Rows;
    using Block = Eigen::Matrix<Scalar, Rows, Rows>;
    using PaddedBlock = Eigen::Matrix<Scalar, paddedRows, Rows>;
    using Vector = Eigen::Matrix<Scalar, Eigen::Dynamic, 1>;

    /// \param pattern of the matrix that will be factorised; nothing is permuted
    explicit BlockCholesky(FactorPattern pattern);

    /// Numeric factorisation of values on the pattern that was analysed. \return false at a pivot that is not
    /// positive
    bool factorise(const BlockPattern& matrix, const Block* values);

    /// Solves in place.
    void solve(Eigen::Ref<Vector> x) const;
    /// Likewise for two right sides at once.
    void solve(Eigen::Ref<Vector> one, Eigen::Ref<Vector> other) const;

private:
    FactorPattern factorPattern;
    std::vector<int> place; ///< work: place of a block row within the column in hand
    std::vector<PaddedBlock, Eigen::aligned_allocator<PaddedBlock>>
        blocks; ///< L; on the diagonal its inverse
};

extern template class BlockCholesky<3>;
extern template class BlockCholesky<6>;
extern template class BlockCholesky<3, DoubleDouble>;
extern template class BlockCholesky<6, DoubleDouble>;

} // namespace drystone
