// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Sparse Cholesky factorisation of matrices made of small dense blocks: the factor for large systems.
#pragma once

#include "linear/BlockPattern.h"

#include <Eigen/Core>

#include <array>
#include <vector>

namespace drystone
{

struct DenseUpdate;

/// S = L L' by fronts (Duff & Reid 1983). Columns of L with nearly the same rows form a front, a dense matrix
///
///     [ L11     ]   columns of the front
///     [ L21  U  ]   rows below them
///
/// in which L11 and L21 are found at once, and U = -L21 L21' is what these columns take from later ones. It
/// is added to the front of the first of them, the parent: a sum of dense matrices from the leaves of a tree
/// to its root.
///
/// Memory: L and at most as much for the U that wait for their parents. Not thread-safe.
template<int Rows>
class FrontalCholesky
{
public:
    using Block = Eigen::Matrix<double, Rows, Rows>;

    /// Symbolic analysis; nothing is permuted. \param factor the pattern of L
    FrontalCholesky(const BlockPattern& matrix, const BlockPattern& factor);

    /// Numeric factorisation of values on the pattern of the analysis. \return false at a pivot that is not
    /// positive
    bool factorise(const BlockPattern& matrix, const Block* values);

    /// Solves in place.
    void solve(Eigen::Ref<Eigen::VectorXd> x);
    /// Likewise for two right sides at once.
    void solve(Eigen::Ref<Eigen::VectorXd> one, Eigen::Ref<Eigen::VectorXd> other);
    /// Likewise with L rounded to single precision where that is quicker: half as much has to be fetched from
    /// memory.
    void solveRoughly(Eigen::Ref<Eigen::VectorXd> x);

private:
    struct Front
    {
        int firstBody = 0;       ///< of its columns
        int lastBody = 0;        ///< one past
        int firstRow = 0;        ///< of its rows below the columns, in `rows`
        int lastRow = 0;         ///< one past
        std::size_t columns = 0; ///< where L11 and L21 are in `lower`
        std::size_t update = 0;  ///< where U is in `updates`, until the parent has taken it
        std::vector<int> children;

        int width() const { return Rows * (lastBody - firstBody); }
        int below() const { return Rows * (lastRow - firstRow); }
        /// Rows of the whole, with empty ones up to whole vector registers.
        int height() const { return (width() + below() + 3) / 4 * 4; }
        /// From one column of U to the next, in whole vector registers.
        int updateStride() const { return (below() + 3) / 4 * 4; }
    };

    /// Part of a front.
    enum class Into
    {
        columns,
        update
    };
    /// Rows of a child that stand together in its parent's front, too.
    struct Run
    {
        int end;   ///< one past its last body below the child's columns
        int shift; ///< from the child's bodies to the parent's
    };

    void placeUpdates();
    void assembleColumns(const Front& front, const BlockPattern& matrix, const Block* values);
    void addUpdates(const Front& front, Into into);
    bool eliminateColumns(const Front& front);
    void updateBelow(const Front& front);
    void updateDensely(const DenseUpdate& task);
    template<int Sides, class Scalar>
    void solveFor(const std::array<double*, Sides>& x, const Scalar* factor);

    std::vector<Front> fronts; ///< children before their parents
    std::vector<int> rows;     ///< bodies
    std::vector<int> inParent; ///< of each of `rows`: the place of that body in the parent's front
    std::vector<int> inFront;  ///< of each block of the matrix: the place of its row in its column's front
    std::vector<double> lower;
    std::vector<float> rounded; ///< L in single precision, once it was needed
    std::vector<double> updates;
    std::vector<Run> runs;      ///< work of `addUpdates`
    std::vector<double> work;   ///< of solves: one front's part of each right side
    std::vector<double> packed; ///< work of the dense kernel, once it was needed
    int highest = 0;
};

extern template class FrontalCholesky<3>;
extern template class FrontalCholesky<6>;

} // namespace drystone
