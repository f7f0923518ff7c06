// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
#include "conic/BlockCholesky.h"

#include <algorithm>
#include <cmath>

namespace drystone
{

template<int Rows>
BlockCholesky<Rows>::BlockCholesky(const std::vector<int>& columnStart, const std::vector<int>& row)
    : size_(static_cast<int>(columnStart.size()) - 1), start_(size_ + 1, 0), place_(size_, -1)
{
    // The pattern of column j of L is that of S joined with those of j's children in the elimination tree,
    // less the children themselves; j's parent is the first row below its diagonal.
    std::vector<std::vector<int>> children(size_);
    std::vector<int> mark(size_, -1);
    for (int column = 0; column < size_; ++column)
    {
        const auto begin = static_cast<std::ptrdiff_t>(row_.size());
        mark[column] = column;
        row_.push_back(column);
        const auto join = [&](int candidate)
        {
            if (candidate > column && mark[candidate] != column)
            {
                mark[candidate] = column;
                row_.push_back(candidate);
            }
        };
        for (int entry = columnStart[column]; entry < columnStart[column + 1]; ++entry)
        {
            join(row[entry]);
        }
        for (const int child : children[column])
        {
            for (int entry = start_[child]; entry < start_[child + 1]; ++entry)
            {
                join(row_[entry]);
            }
        }
        std::sort(row_.begin() + begin, row_.end());
        start_[column + 1] = static_cast<int>(row_.size());
        const double below = static_cast<double>(row_.size()) - begin - 1;
        operations_ += Rows * Rows * Rows * (below * (below + 1) / 2 + below + 1.0 / 6);
        if (below > 0)
        {
            children[row_[begin + 1]].push_back(column);
        }
    }

    updateStart_.assign(size_ + 1, 0);
    for (int column = 0; column < size_; ++column)
    {
        for (int entry = start_[column] + 1; entry < start_[column + 1]; ++entry)
        {
            ++updateStart_[row_[entry] + 1];
        }
    }
    for (int column = 0; column < size_; ++column)
    {
        updateStart_[column + 1] += updateStart_[column];
    }
    updatePosition_.resize(updateStart_[size_]);
    columnOf_.resize(updateStart_[size_]);
    std::vector<int> next(updateStart_.begin(), updateStart_.end() - 1);
    for (int column = 0; column < size_; ++column)
    {
        for (int entry = start_[column] + 1; entry < start_[column + 1]; ++entry)
        {
            const int update = next[row_[entry]]++;
            updatePosition_[update] = entry;
            columnOf_[update] = column;
        }
    }
}

template<int Rows>
void BlockCholesky<Rows>::allocate()
{
    blocks_.assign(row_.size(), PaddedBlock::Zero());
}

template<int Rows>
bool BlockCholesky<Rows>::factorise(const std::vector<int>& columnStart, const std::vector<int>& row,
                                    const Block* values)
{
    for (int column = 0; column < size_; ++column)
    {
        const int begin = start_[column];
        const int end = start_[column + 1];
        for (int entry = begin; entry < end; ++entry)
        {
            place_[row_[entry]] = entry;
            blocks_[entry].setZero();
        }
        for (int entry = columnStart[column]; entry < columnStart[column + 1]; ++entry)
        {
            blocks_[place_[row[entry]]].template topRows<Rows>() = values[entry];
        }
        // L_ij L_jj' = S_ij - sum_k L_ik L_jk'
        for (int update = updateStart_[column]; update < updateStart_[column + 1]; ++update)
        {
            const int first = updatePosition_[update];
            const int last = start_[columnOf_[update] + 1];
            const Block factor = blocks_[first].template topRows<Rows>().transpose();
            for (int entry = first; entry < last; ++entry)
            {
                blocks_[place_[row_[entry]]].noalias() -= blocks_[entry].lazyProduct(factor);
            }
        }
        // The diagonal block: its Cholesky factor by hand (the compiler unrolls it), kept as the inverse.
        Block pivot = blocks_[begin].template topRows<Rows>();
        Block inverse = Block::Zero();
        for (int k = 0; k < Rows; ++k)
        {
            double diagonal = pivot(k, k);
            for (int m = 0; m < k; ++m)
            {
                diagonal -= pivot(k, m) * pivot(k, m);
            }
            if (!(diagonal > 0) || !std::isfinite(diagonal))
            {
                return false;
            }
            pivot(k, k) = std::sqrt(diagonal);
            const double scale = 1 / pivot(k, k);
            for (int i = k + 1; i < Rows; ++i)
            {
                double value = pivot(i, k);
                for (int m = 0; m < k; ++m)
                {
                    value -= pivot(i, m) * pivot(k, m);
                }
                pivot(i, k) = value * scale;
            }
            inverse(k, k) = scale;
            for (int j = 0; j < k; ++j)
            {
                double value = 0;
                for (int m = j; m < k; ++m)
                {
                    value -= pivot(k, m) * inverse(m, j);
                }
                inverse(k, j) = value * scale;
            }
        }
        blocks_[begin].template topRows<Rows>() = inverse;
        const Block inverseTransposed = inverse.transpose();
        for (int entry = begin + 1; entry < end; ++entry)
        {
            const PaddedBlock below = blocks_[entry];
            blocks_[entry].noalias() = below.lazyProduct(inverseTransposed);
        }
    }
    return true;
}

template<int Rows>
void BlockCholesky<Rows>::solve(Eigen::Ref<Eigen::VectorXd> x) const
{
    using Segment = Eigen::Matrix<double, Rows, 1>;
    using Padded = Eigen::Matrix<double, paddedRows, 1>;
    for (int column = 0; column < size_; ++column)
    {
        const int begin = start_[column];
        const Segment value =
            blocks_[begin].template topRows<Rows>() * x.template segment<Rows>(Rows * column);
        x.template segment<Rows>(Rows * column) = value;
        for (int entry = begin + 1; entry < start_[column + 1]; ++entry)
        {
            const Padded product = blocks_[entry].lazyProduct(value);
            x.template segment<Rows>(Rows * row_[entry]) -= product.template head<Rows>();
        }
    }
    for (int column = size_ - 1; column >= 0; --column)
    {
        const int begin = start_[column];
        Segment value = x.template segment<Rows>(Rows * column);
        for (int entry = begin + 1; entry < start_[column + 1]; ++entry)
        {
            value.noalias() -= blocks_[entry].template topRows<Rows>().transpose()
                               * x.template segment<Rows>(Rows * row_[entry]);
        }
        x.template segment<Rows>(Rows * column).noalias() =
            blocks_[begin].template topRows<Rows>().transpose() * value;
    }
}

template class BlockCholesky<3>;
template class BlockCholesky<6>;

} // namespace drystone
