// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Which blocks of a sparse system and of its factor are not zero: what every factorisation has to know
/// first.
#pragma once

#include <array>
#include <vector>

namespace drystone
{

/// Which bodies touch which: pairs of distinct bodies, in any order, repeats allowed.
using Coupling = std::array<int, 2>;

/// Lower triangle by columns of blocks, the diagonal block first, rows ascending. An upper triangle of the
/// same pattern is kept transposed.
struct BlockPattern
{
    std::vector<int> columnStart; ///< bodies + 1
    std::vector<int> row;         ///< of each block

    int columns() const { return static_cast<int>(columnStart.size()) - 1; }

    /// Position of the block of a pair of bodies. \throws std::out_of_range for a pair not in the pattern
    int slot(int first, int second) const;
};

/// \param couplings pairs (a, b), a != b, of bodies numbered in elimination order
BlockPattern makeBlockPattern(int bodies, const std::vector<Coupling>& couplings);

/// The pattern of a triangular factor, and which of its blocks meet where.
struct FactorPattern
{
    BlockPattern factor;
    std::vector<int> updateStart;    ///< per column j: the columns k < j with L_jk != 0 ...
    std::vector<int> updatePosition; ///< ... as the position of L_jk
    std::vector<int> columnOf;       ///< column of each update's block

    /// Multiplications of a symmetric factorisation with blocks of so many rows.
    double operations(int rows) const;
};

/// Symbolic factorisation without permutation.
FactorPattern makeFactorPattern(const BlockPattern& matrix);

} // namespace drystone
