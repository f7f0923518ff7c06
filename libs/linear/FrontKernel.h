// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Products and substitutions of a narrow front, in registers: what DenseKernel does for wide ones. Of
/// FrontalCholesky only, which is compiled with fused multiply-adds.
#pragma once

#include "linear/PivotBlock.h"

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cstddef>

namespace drystone::frontKernel
{

using Eigen::Index;

/// The kernel works on three columns at once, of one body or half a body of six rows, and on registers of
/// four rows.
constexpr int columnsAtOnce = 3;
constexpr int lanes = 4;
using Lanes = Eigen::Array<double, lanes, 1>;

/// Tiles may reach so far beyond the end of a matrix, where they find and leave numbers without meaning.
constexpr std::size_t overhang = 2 * lanes;

enum class Target
{
    subtract, ///< C -= A B'
    set       ///< C = -A B'
};

/// One tile, so many registers high and three columns wide, held in registers. All matrices are stored by
/// columns. \param depth columns of A and B
template<Target target, int Registers>
void multiplyTile(const double* a, Index aStride, const double* b, Index bStride, int depth, double* c,
                  Index cStride)
{
    std::array<std::array<Lanes, Registers>, columnsAtOnce> sum;
    for (auto& column : sum)
    {
        column.fill(Lanes::Zero());
    }
    for (int k = 0; k < depth; ++k)
    {
        std::array<Lanes, Registers> rows;
        for (int part = 0; part < Registers; ++part)
        {
            rows[part] = Eigen::Map<const Lanes>(a + k * aStride + lanes * part);
        }
        for (int column = 0; column < columnsAtOnce; ++column)
        {
            const double factor = b[k * bStride + column];
            for (int part = 0; part < Registers; ++part)
            {
                sum[column][part] += rows[part] * factor;
            }
        }
    }
    for (int column = 0; column < columnsAtOnce; ++column)
    {
        for (int part = 0; part < Registers; ++part)
        {
            Eigen::Map<Lanes> out(c + column * cStride + lanes * part);
            if constexpr (target == Target::subtract)
            {
                out -= sum[column][part];
            }
            else
            {
                out = -sum[column][part];
            }
        }
    }
}

/// Likewise for so many rows, rounded up to whole registers.
template<Target target>
void multiply(const double* a, Index aStride, const double* b, Index bStride, int depth, double* c,
              Index cStride, int rows)
{
    int row = 0;
    for (; row + 3 * lanes <= rows; row += 3 * lanes)
    {
        multiplyTile<target, 3>(a + row, aStride, b, bStride, depth, c + row, cStride);
    }
    for (; row + 2 * lanes <= rows; row += 2 * lanes)
    {
        multiplyTile<target, 2>(a + row, aStride, b, bStride, depth, c + row, cStride);
    }
    for (; row < rows; row += lanes)
    {
        multiplyTile<target, 1>(a + row, aStride, b, bStride, depth, c + row, cStride);
    }
}

/// Multiplies rows of three columns by the transposed inverse of their diagonal block.
inline void scaleRows(double* one, Index stride, const Eigen::Matrix3d& scale, int from, int to)
{
    double* two = one + stride;
    double* three = two + stride;
    for (int row = from; row < to; ++row)
    {
        three[row] = one[row] * scale(2, 0) + two[row] * scale(2, 1) + three[row] * scale(2, 2);
        two[row] = one[row] * scale(1, 0) + two[row] * scale(1, 1);
        one[row] *= scale(0, 0);
    }
}

/// The columns of a panel, three at a time, once they are freed of those before it: their part of L, with
/// diagonal blocks of three rows inverted. \param panel from its diagonal down \return false at a pivot that
/// is not positive
inline bool eliminatePanel(double* panel, Index stride, int width, int rows)
{
    for (int column = 0; column < width; column += columnsAtOnce)
    {
        double* block = panel + column * stride + column;
        multiply<Target::subtract>(panel + column, stride, panel + column, stride, column, block, stride,
                                   rows - column);
        Eigen::Map<Eigen::Matrix3d, 0, Eigen::OuterStride<>> diagonal(block, Eigen::OuterStride<>(stride));
        Eigen::Matrix3d factor = diagonal;
        Eigen::Matrix3d scale;
        if (!invertFactor<3, double>(factor, scale))
        {
            return false;
        }
        diagonal = scale;
        scaleRows(block, stride, scale, columnsAtOnce, rows - column);
    }
    return true;
}

/// Likewise some rows below the diagonal of a panel that is eliminated there. \param from, to rows from the
/// panel's first on; a multiple of a register, or up to the end
inline void eliminateRows(double* panel, Index stride, int width, int from, int to)
{
    for (int column = 0; column < width; column += columnsAtOnce)
    {
        double* block = panel + column * stride;
        multiply<Target::subtract>(panel + from, stride, panel + column, stride, column, block + from, stride,
                                   to - from);
        const Eigen::Matrix3d scale = Eigen::Map<const Eigen::Matrix3d, 0, Eigen::OuterStride<>>(
            block + column, Eigen::OuterStride<>(stride));
        scaleRows(block, stride, scale, from, to);
    }
}

/// Tiles that reached beyond the end of a column have left numbers at the top of the next, above its
/// diagonal, and behind the last. Solves multiply them with zero: they must be finite, and in ill-conditioned
/// fronts they grow from column to column beyond what a double holds.
inline void clearAboveDiagonal(double* columns, Index stride, int width)
{
    for (int column = 1; column <= width; ++column)
    {
        std::fill_n(columns + column * stride, std::min(column, lanes - 1), 0.0);
    }
}

/// Columns that a solve takes at once: as many as leave their numbers in registers.
template<int Sides>
constexpr int columnsOfSolve = Sides == 1 ? 2 * columnsAtOnce : columnsAtOnce;

/// Four numbers of the factor, in double precision.
inline Lanes lanesOf(const double* values)
{
    return Eigen::Map<const Lanes>(values);
}
inline Lanes lanesOf(const float* values)
{
    return Eigen::Map<const Eigen::Array<float, lanes, 1>>(values).cast<double>();
}

/// Solves for the rows of some columns of a front themselves, of each right side. \param block the columns
/// from their diagonal down, of which blocks of three rows on the diagonal are inverted \param x from the
/// same row down
template<int Columns, int Sides, class Scalar>
void solveOwnRows(const Scalar* block, Index stride, const std::array<double*, Sides>& x)
{
    for (int side = 0; side < Sides; ++side)
    {
        double* own = x[side];
        for (int first = 0; first < Columns; first += columnsAtOnce)
        {
            const Scalar* one = block + first * stride;
            const Scalar* two = one + stride;
            const Scalar* three = two + stride;
            const double a = own[first];
            const double b = own[first + 1];
            const double c = own[first + 2];
            own[first] = a * one[first];
            own[first + 1] = a * one[first + 1] + b * two[first + 1];
            own[first + 2] = a * one[first + 2] + b * two[first + 2] + c * three[first + 2];
            for (int row = first + columnsAtOnce; row < Columns; ++row)
            {
                own[row] -= one[row] * own[first] + two[row] * own[first + 1] + three[row] * own[first + 2];
            }
        }
    }
}

/// Takes from other rows what the columns do to them, once their own rows are solved for. \param from, to
/// rows from that of the diagonal on, rounded up to whole registers
template<int Columns, int Sides, class Scalar>
void takeFromRows(const Scalar* block, Index stride, int from, int to, const std::array<double*, Sides>& x)
{
    std::array<std::array<double, Columns>, Sides> solved;
    for (int side = 0; side < Sides; ++side)
    {
        std::copy_n(x[side], Columns, solved[side].begin());
    }
    for (int row = from; row < to; row += lanes)
    {
        std::array<Lanes, Columns> values;
        for (int column = 0; column < Columns; ++column)
        {
            values[column] = lanesOf(block + column * stride + row);
        }
        for (int side = 0; side < Sides; ++side)
        {
            Eigen::Map<Lanes> below(x[side] + row);
            Lanes sum = below;
            for (int column = 0; column < Columns; ++column)
            {
                sum -= values[column] * solved[side][column];
            }
            below = sum;
        }
    }
}

/// Forward substitution with some columns of a front. \param x up to a register beyond its end is touched
template<int Columns, int Sides, class Scalar>
void substituteForward(const Scalar* block, Index stride, int rows, const std::array<double*, Sides>& x)
{
    solveOwnRows<Columns, Sides>(block, stride, x);
    takeFromRows<Columns, Sides>(block, stride, Columns, rows, x);
}

/// A number of each of some columns, for each right side.
template<int Columns, int Sides>
using OfColumns = std::array<std::array<double, Columns>, Sides>;

/// Products of columns with rows of x, as above. \param x zero where it has no rows
template<int Columns, int Sides, class Scalar>
OfColumns<Columns, Sides> productsWithRows(const Scalar* block, Index stride, int from, int to,
                                           const std::array<double*, Sides>& x)
{
    std::array<std::array<Lanes, Columns>, Sides> sum;
    for (auto& ofSide : sum)
    {
        ofSide.fill(Lanes::Zero());
    }
    for (int row = from; row < to; row += lanes)
    {
        std::array<Lanes, Sides> below;
        for (int side = 0; side < Sides; ++side)
        {
            below[side] = Eigen::Map<const Lanes>(x[side] + row);
        }
        for (int column = 0; column < Columns; ++column)
        {
            const Lanes values = lanesOf(block + column * stride + row);
            for (int side = 0; side < Sides; ++side)
            {
                sum[side][column] += values * below[side];
            }
        }
    }
    OfColumns<Columns, Sides> products;
    for (int side = 0; side < Sides; ++side)
    {
        for (int column = 0; column < Columns; ++column)
        {
            products[side][column] = sum[side][column].sum();
        }
    }
    return products;
}

/// Solves for the rows of some columns, once what other rows do to them is known.
template<int Columns, int Sides, class Scalar>
void solveOwnRowsBackward(const Scalar* block, Index stride, const OfColumns<Columns, Sides>& products,
                          const std::array<double*, Sides>& x)
{
    for (int side = 0; side < Sides; ++side)
    {
        double* own = x[side];
        for (int first = Columns - columnsAtOnce; first >= 0; first -= columnsAtOnce)
        {
            const Scalar* one = block + first * stride;
            const Scalar* two = one + stride;
            const Scalar* three = two + stride;
            double a = own[first] - products[side][first];
            double b = own[first + 1] - products[side][first + 1];
            double c = own[first + 2] - products[side][first + 2];
            for (int row = first + columnsAtOnce; row < Columns; ++row)
            {
                a -= one[row] * own[row];
                b -= two[row] * own[row];
                c -= three[row] * own[row];
            }
            own[first] = a * one[first] + b * one[first + 1] + c * one[first + 2];
            own[first + 1] = b * two[first + 1] + c * two[first + 2];
            own[first + 2] = c * three[first + 2];
        }
    }
}

/// Backward substitution: takes from the rows of some columns what those below do, and solves for them.
template<int Columns, int Sides, class Scalar>
void substituteBackward(const Scalar* block, Index stride, int rows, const std::array<double*, Sides>& x)
{
    const OfColumns<Columns, Sides> products =
        productsWithRows<Columns, Sides>(block, stride, Columns, rows, x);
    solveOwnRowsBackward<Columns, Sides>(block, stride, products, x);
}

} // namespace drystone::frontKernel
