// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Sparse LU factorisation of matrices made of small dense blocks, symmetric in pattern but not in value.
#pragma once

#include "linear/BlockPattern.h"

#include <Eigen/Core>

#include <vector>

namespace drystone
{

/// S = L U by columns and rows of blocks, left-looking, pivots within the diagonal blocks only. That is not
/// stable for any matrix: whoever uses it looks at the residual.
template<int Rows>
class BlockLu
{
public:
    using Block = Eigen::Matrix<double, Rows, Rows>;

    /// Symbolic analysis; nothing is permuted.
    explicit BlockLu(const BlockPattern& matrix);

    /// Of the matrix.
    const BlockPattern& pattern() const { return matrixPattern; }

    /// Numeric factorisation on the pattern of the analysis. \param lower blocks (i, j), i >= j
    /// \param upperTransposed transposes of the blocks (j, i) in the same places; those on the diagonal are
    /// not read \return false where a diagonal block cannot be inverted
    bool factorise(const std::vector<Block>& lower, const std::vector<Block>& upperTransposed);

    /// The same after the last factorisation, where only some columns of `lower` and rows of
    /// `upperTransposed` are others: computes these anew and those that depend on them. \param changed
    /// columns
    bool refactorise(const std::vector<Block>& lower, const std::vector<Block>& upperTransposed,
                     const std::vector<int>& changed);

    /// Solves in place.
    void solve(Eigen::Ref<Eigen::VectorXd> x) const;

private:
    bool factoriseColumn(int column, const std::vector<Block>& lower,
                         const std::vector<Block>& upperTransposed);

    BlockPattern matrixPattern;
    FactorPattern factorPattern;
    std::vector<int> placeInColumn;           ///< work: place of a block row within the column in hand
    std::vector<char> isAnew;                 ///< work: columns that are computed anew
    std::vector<Block> factorLower;           ///< L below the diagonal; on it the inverse of the pivot
    std::vector<Block> factorUpperTransposed; ///< U', its diagonal not used
};

extern template class BlockLu<3>;
extern template class BlockLu<6>;

} // namespace drystone
