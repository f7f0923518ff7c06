// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
#include "linear/BlockLu.h"

#include <Eigen/LU>

#include <algorithm>

namespace drystone
{

template<int Rows>
BlockLu<Rows>::BlockLu(const BlockPattern& matrix)
    : matrix_(matrix),
      pattern_(makeFactorPattern(matrix)),
      place_(matrix.columns(), -1),
      lower_(pattern_.factor.row.size()),
      upperTransposed_(pattern_.factor.row.size())
{
}

template<int Rows>
bool BlockLu<Rows>::factoriseColumn(int column, const std::vector<Block>& lower,
                                    const std::vector<Block>& upperTransposed)
{
    const std::vector<int>& start = pattern_.factor.columnStart;
    const std::vector<int>& row = pattern_.factor.row;
    const int begin = start[column];
    const int end = start[column + 1];
    for (int entry = begin; entry < end; ++entry)
    {
        place_[row[entry]] = entry;
        lower_[entry].setZero();
        upperTransposed_[entry].setZero();
    }
    for (int entry = matrix_.columnStart[column]; entry < matrix_.columnStart[column + 1]; ++entry)
    {
        lower_[place_[matrix_.row[entry]]] = lower[entry];
        upperTransposed_[place_[matrix_.row[entry]]] = upperTransposed[entry];
    }
    // L_ij D_j = S_ij - sum_k L_ik U_kj, and U_ji' = S_ji' - sum_k U_ki' L_jk'
    for (int update = pattern_.updateStart[column]; update < pattern_.updateStart[column + 1]; ++update)
    {
        const int first = pattern_.updatePosition[update];
        const int last = start[pattern_.columnOf[update] + 1];
        const Block ofUpper = upperTransposed_[first].transpose();
        const Block ofLower = lower_[first].transpose();
        for (int entry = first; entry < last; ++entry)
        {
            const int place = place_[row[entry]];
            lower_[place].noalias() -= lower_[entry].lazyProduct(ofUpper);
            upperTransposed_[place].noalias() -= upperTransposed_[entry].lazyProduct(ofLower);
        }
    }
    const Block pivot = lower_[begin];
    const Block inverse = pivot.inverse();
    if (!inverse.allFinite())
    {
        return false;
    }
    lower_[begin] = inverse;
    for (int entry = begin + 1; entry < end; ++entry)
    {
        const Block below = lower_[entry];
        lower_[entry].noalias() = below.lazyProduct(inverse);
    }
    return true;
}

template<int Rows>
bool BlockLu<Rows>::factorise(const std::vector<Block>& lower, const std::vector<Block>& upperTransposed)
{
    for (int column = 0; column < matrix_.columns(); ++column)
    {
        if (!factoriseColumn(column, lower, upperTransposed))
        {
            return false;
        }
    }
    return true;
}

template<int Rows>
bool BlockLu<Rows>::refactorise(const std::vector<Block>& lower, const std::vector<Block>& upperTransposed,
                                const std::vector<int>& changed)
{
    isAnew_.assign(static_cast<std::size_t>(matrix_.columns()), 0);
    int from = matrix_.columns();
    for (const int column : changed)
    {
        isAnew_[column] = 1;
        from = std::min(from, column);
    }
    for (int column = from; column < matrix_.columns(); ++column)
    {
        for (int update = pattern_.updateStart[column];
             !isAnew_[column] && update < pattern_.updateStart[column + 1]; ++update)
        {
            isAnew_[column] = isAnew_[pattern_.columnOf[update]];
        }
        if (isAnew_[column] && !factoriseColumn(column, lower, upperTransposed))
        {
            return false;
        }
    }
    return true;
}

template<int Rows>
void BlockLu<Rows>::solve(Eigen::Ref<Eigen::VectorXd> x) const
{
    using Segment = Eigen::Matrix<double, Rows, 1>;
    const std::vector<int>& start = pattern_.factor.columnStart;
    const std::vector<int>& row = pattern_.factor.row;
    for (int column = 0; column < matrix_.columns(); ++column)
    {
        const Segment value = x.template segment<Rows>(Rows * column);
        if (value.isZero(0)) // as most are where few rows are loaded
        {
            continue;
        }
        for (int entry = start[column] + 1; entry < start[column + 1]; ++entry)
        {
            x.template segment<Rows>(Rows * row[entry]) -= lower_[entry].lazyProduct(value);
        }
    }
    for (int column = matrix_.columns() - 1; column >= 0; --column)
    {
        Segment value = x.template segment<Rows>(Rows * column);
        for (int entry = start[column] + 1; entry < start[column + 1]; ++entry)
        {
            value -=
                upperTransposed_[entry].transpose().lazyProduct(x.template segment<Rows>(Rows * row[entry]));
        }
        x.template segment<Rows>(Rows * column) = lower_[start[column]].lazyProduct(value);
    }
}

template class BlockLu<3>;
template class BlockLu<6>;

} // namespace drystone
