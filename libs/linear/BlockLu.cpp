// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// L and the transpose of U side by side, column by column; only what depends on a change is done anew.
#include "linear/BlockLu.h"

#include <Eigen/LU>

#include <algorithm>

namespace drystone
{

template<int Rows>
BlockLu<Rows>::BlockLu(const BlockPattern& matrix)
    : matrixPattern(matrix),
      factorPattern(makeFactorPattern(matrix)),
      placeInColumn(matrix.columns(), -1),
      factorLower(factorPattern.factor.row.size()),
      factorUpperTransposed(factorPattern.factor.row.size())
{
}

template<int Rows>
bool BlockLu<Rows>::factoriseColumn(int column, const std::vector<Block>& lower,
                                    const std::vector<Block>& upperTransposed)
{
    const std::vector<int>& start = factorPattern.factor.columnStart;
    const std::vector<int>& row = factorPattern.factor.row;
    const int begin = start[column];
    const int end = start[column + 1];
    for (int entry = begin; entry < end; ++entry)
    {
        placeInColumn[row[entry]] = entry;
        factorLower[entry].setZero();
        factorUpperTransposed[entry].setZero();
    }
    for (int entry = matrixPattern.columnStart[column]; entry < matrixPattern.columnStart[column + 1];
         ++entry)
    {
        factorLower[placeInColumn[matrixPattern.row[entry]]] = lower[entry];
        factorUpperTransposed[placeInColumn[matrixPattern.row[entry]]] = upperTransposed[entry];
    }
    // L_ij D_j = S_ij - sum_k L_ik U_kj, and U_ji' = S_ji' - sum_k U_ki' L_jk'
    for (int update = factorPattern.updateStart[column]; update < factorPattern.updateStart[column + 1];
         ++update)
    {
        const int first = factorPattern.updatePosition[update];
        const int last = start[factorPattern.columnOf[update] + 1];
        const Block ofUpper = factorUpperTransposed[first].transpose();
        const Block ofLower = factorLower[first].transpose();
        for (int entry = first; entry < last; ++entry)
        {
            const int place = placeInColumn[row[entry]];
            factorLower[place].noalias() -= factorLower[entry].lazyProduct(ofUpper);
            factorUpperTransposed[place].noalias() -= factorUpperTransposed[entry].lazyProduct(ofLower);
        }
    }
    const Block pivot = factorLower[begin];
    const Block inverse = pivot.inverse();
    if (!inverse.allFinite())
    {
        return false;
    }
    factorLower[begin] = inverse;
    for (int entry = begin + 1; entry < end; ++entry)
    {
        const Block below = factorLower[entry];
        factorLower[entry].noalias() = below.lazyProduct(inverse);
    }
    return true;
}

template<int Rows>
bool BlockLu<Rows>::factorise(const std::vector<Block>& lower, const std::vector<Block>& upperTransposed)
{
    for (int column = 0; column < matrixPattern.columns(); ++column)
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
    isAnew.assign(static_cast<std::size_t>(matrixPattern.columns()), 0);
    int from = matrixPattern.columns();
    for (const int column : changed)
    {
        isAnew[column] = 1;
        from = std::min(from, column);
    }
    for (int column = from; column < matrixPattern.columns(); ++column)
    {
        for (int update = factorPattern.updateStart[column];
             !isAnew[column] && update < factorPattern.updateStart[column + 1]; ++update)
        {
            isAnew[column] = isAnew[factorPattern.columnOf[update]];
        }
        if (isAnew[column] && !factoriseColumn(column, lower, upperTransposed))
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
    const std::vector<int>& start = factorPattern.factor.columnStart;
    const std::vector<int>& row = factorPattern.factor.row;
    for (int column = 0; column < matrixPattern.columns(); ++column)
    {
        const Segment value = x.template segment<Rows>(Rows * column);
        if (value.isZero(0)) // as most are where few rows are loaded
        {
            continue;
        }
        for (int entry = start[column] + 1; entry < start[column + 1]; ++entry)
        {
            x.template segment<Rows>(Rows * row[entry]) -= factorLower[entry].lazyProduct(value);
        }
    }
    for (int column = matrixPattern.columns() - 1; column >= 0; --column)
    {
        Segment value = x.template segment<Rows>(Rows * column);
        for (int entry = start[column] + 1; entry < start[column + 1]; ++entry)
        {
            value -= factorUpperTransposed[entry].transpose().lazyProduct(
                x.template segment<Rows>(Rows * row[entry]));
        }
        x.template segment<Rows>(Rows * column) = factorLower[start[column]].lazyProduct(value);
    }
}

template class BlockLu<3>;
template class BlockLu<6>;

} // namespace drystone
