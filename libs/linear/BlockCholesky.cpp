// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Columns of blocks padded to vector registers; the factors of the pivots are kept inverted.
#include "linear/BlockCholesky.h"

#include "linear/PivotBlock.h"

namespace drystone
{

template<int Rows, class Scalar>
BlockCholesky<Rows, Scalar>::BlockCholesky(FactorPattern pattern)
    : factorPattern(std::move(pattern)),
      place(factorPattern.factor.columns(), -1),
      blocks(factorPattern.factor.row.size(), PaddedBlock::Zero())
{
}

namespace
{

/// B = B L' with a lower triangle L, from the last column of B on, since each takes those before it as they
/// were.
template<int column, int Rows, class Scalar, class Block>
void multiplyByTransposed(const Eigen::Matrix<Scalar, Rows, Rows>& lower, Block& block)
{
    const Eigen::Matrix<Scalar, Block::RowsAtCompileTime, 1> sum =
        block.template leftCols<column + 1>().lazyProduct(
            lower.row(column).template head<column + 1>().transpose());
    block.col(column) = sum;
    if constexpr (column > 0)
    {
        multiplyByTransposed<column - 1>(lower, block);
    }
}

} // namespace

template<int Rows, class Scalar>
bool BlockCholesky<Rows, Scalar>::factorise(const BlockPattern& matrix, const Block* values)
{
    const std::vector<int>& start = factorPattern.factor.columnStart;
    const std::vector<int>& row = factorPattern.factor.row;
    for (int column = 0; column < matrix.columns(); ++column)
    {
        const int begin = start[column];
        const int end = start[column + 1];
        for (int entry = begin; entry < end; ++entry)
        {
            place[row[entry]] = entry;
            blocks[entry].setZero();
        }
        for (int entry = matrix.columnStart[column]; entry < matrix.columnStart[column + 1]; ++entry)
        {
            blocks[place[matrix.row[entry]]].template topRows<Rows>() = values[entry];
        }
        // L_ij L_jj' = S_ij - sum_k L_ik L_jk'
        for (int update = factorPattern.updateStart[column]; update < factorPattern.updateStart[column + 1];
             ++update)
        {
            const int first = factorPattern.updatePosition[update];
            const int last = start[factorPattern.columnOf[update] + 1];
            const Block factor = blocks[first].template topRows<Rows>().transpose();
            for (int entry = first; entry < last; ++entry)
            {
                blocks[place[row[entry]]].noalias() -= blocks[entry].lazyProduct(factor);
            }
        }
        Block pivot = blocks[begin].template topRows<Rows>();
        Block inverse;
        if (!invertFactor<Rows, Scalar>(pivot, inverse))
        {
            return false;
        }
        blocks[begin].template topRows<Rows>() = inverse;
        for (int entry = begin + 1; entry < end; ++entry)
        {
            multiplyByTransposed<Rows - 1>(inverse, blocks[entry]);
        }
    }
    return true;
}

template<int Rows, class Scalar>
void BlockCholesky<Rows, Scalar>::solve(Eigen::Ref<Vector> x) const
{
    using Segment = Eigen::Matrix<Scalar, Rows, 1>;
    using Padded = Eigen::Matrix<Scalar, paddedRows, 1>;
    const std::vector<int>& start = factorPattern.factor.columnStart;
    const std::vector<int>& row = factorPattern.factor.row;
    for (int column = 0; column < factorPattern.factor.columns(); ++column)
    {
        const int begin = start[column];
        const Segment value =
            blocks[begin].template topRows<Rows>() * x.template segment<Rows>(Rows * column);
        x.template segment<Rows>(Rows * column) = value;
        for (int entry = begin + 1; entry < start[column + 1]; ++entry)
        {
            const Padded product = blocks[entry].lazyProduct(value);
            x.template segment<Rows>(Rows * row[entry]) -= product.template head<Rows>();
        }
    }
    for (int column = factorPattern.factor.columns() - 1; column >= 0; --column)
    {
        const int begin = start[column];
        Segment value = x.template segment<Rows>(Rows * column);
        for (int entry = begin + 1; entry < start[column + 1]; ++entry)
        {
            value.noalias() -= blocks[entry].template topRows<Rows>().transpose()
                               * x.template segment<Rows>(Rows * row[entry]);
        }
        x.template segment<Rows>(Rows * column).noalias() =
            blocks[begin].template topRows<Rows>().transpose() * value;
    }
}

template<int Rows, class Scalar>
void BlockCholesky<Rows, Scalar>::solve(Eigen::Ref<Vector> one, Eigen::Ref<Vector> other) const
{
    using Segment = Eigen::Matrix<Scalar, Rows, 1>;
    using Padded = Eigen::Matrix<Scalar, paddedRows, 1>;
    const std::vector<int>& start = factorPattern.factor.columnStart;
    const std::vector<int>& row = factorPattern.factor.row;
    for (int column = 0; column < factorPattern.factor.columns(); ++column)
    {
        const int begin = start[column];
        const Block inverse = blocks[begin].template topRows<Rows>();
        const Segment first = inverse * one.template segment<Rows>(Rows * column);
        const Segment second = inverse * other.template segment<Rows>(Rows * column);
        one.template segment<Rows>(Rows * column) = first;
        other.template segment<Rows>(Rows * column) = second;
        for (int entry = begin + 1; entry < start[column + 1]; ++entry)
        {
            const Padded productFirst = blocks[entry].lazyProduct(first);
            const Padded productSecond = blocks[entry].lazyProduct(second);
            one.template segment<Rows>(Rows * row[entry]) -= productFirst.template head<Rows>();
            other.template segment<Rows>(Rows * row[entry]) -= productSecond.template head<Rows>();
        }
    }
    for (int column = factorPattern.factor.columns() - 1; column >= 0; --column)
    {
        const int begin = start[column];
        Segment first = one.template segment<Rows>(Rows * column);
        Segment second = other.template segment<Rows>(Rows * column);
        for (int entry = begin + 1; entry < start[column + 1]; ++entry)
        {
            const Block transposed = blocks[entry].template topRows<Rows>().transpose();
            first.noalias() -= transposed * one.template segment<Rows>(Rows * row[entry]);
            second.noalias() -= transposed * other.template segment<Rows>(Rows * row[entry]);
        }
        const Block inverse = blocks[begin].template topRows<Rows>().transpose();
        one.template segment<Rows>(Rows * column).noalias() = inverse * first;
        other.template segment<Rows>(Rows * column).noalias() = inverse * second;
    }
}

template class BlockCholesky<3>;
template class BlockCholesky<6>;
template class BlockCholesky<3, DoubleDouble>;
template class BlockCholesky<6, DoubleDouble>;

} // namespace drystone
