// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Sparse Cholesky factorisation of matrices made of small dense blocks: the factor for small and middling
/// systems.
#pragma once

#include <Eigen/Core>

#include <vector>

namespace drystone
{

/// S = L L' by columns of blocks, left-looking. All arithmetic is on fixed-size blocks held in registers, so
/// that it runs several times faster than a scalar sparse code; beyond some thousand bodies a supernodal code
/// on BLAS wins.
template<int Rows>
class BlockCholesky
{
public:
    /// Rows padded to whole vector registers.
    static constexpr int paddedRows = (Rows + 3) / 4 * 4;
    using Block = Eigen::Matrix<double, Rows, Rows>;
    using PaddedBlock = Eigen::Matrix<double, paddedRows, Rows>;

    /// Symbolic analysis. \param columnStart, row lower triangle of S by columns of blocks, the diagonal
    /// first
    BlockCholesky(const std::vector<int>& columnStart, const std::vector<int>& row);

    /// Multiplications of one numeric factorisation.
    double operations() const { return operations_; }

    /// Allocates the factor; needed once before `factorise`.
    void allocate();

    /// Numeric factorisation of values on the pattern of the analysis. \return false at a pivot that is not
    /// positive
    bool factorise(const std::vector<int>& columnStart, const std::vector<int>& row, const Block* values);

    /// Solves in place.
    void solve(Eigen::Ref<Eigen::VectorXd> x) const;

private:
    int size_ = 0;
    double operations_ = 0;
    std::vector<int> start_;          ///< of each column of L, the diagonal block first
    std::vector<int> row_;            ///< block rows of L, ascending in a column
    std::vector<int> updateStart_;    ///< per column j: the columns k < j with L_jk != 0 ...
    std::vector<int> updatePosition_; ///< ... as the position of L_jk in row_/blocks_
    std::vector<int> columnOf_;       ///< column of each update's block
    std::vector<int> place_;          ///< work: place of a block row within the column in hand
    std::vector<PaddedBlock, Eigen::aligned_allocator<PaddedBlock>>
        blocks_; ///< L; on the diagonal its inverse
};

extern template class BlockCholesky<3>;
extern template class BlockCholesky<6>;

} // namespace drystone
