// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Products and substitutions of a narrow front, in registers: what DenseKernel does for wide ones. Of
/// FrontalCholesky only, which is compiled with fused multiply-adds.
#pragma once

#include <Eigen/Core>

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

/// Forward substitution with some columns of a front: solves for their own rows of each right side and takes
/// what they do from the rows below. \param block the columns from their diagonal down \param x from the same
/// row down; up to a register beyond its end is touched
template<int Columns, int Sides, class Scalar>
void substituteForward(const Scalar* block, Index stride, int rows, const std::array<double*, Sides>& x)
{
    std::array<std::array<double, Columns>, Sides> solved;
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
        std::copy_n(own, Columns, solved[side].begin());
    }
    for (int row = Columns; row < rows; row += lanes)
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

/// Backward substitution: takes from the rows of some columns what those below do, and solves for them.
/// \param x likewise; zero where it has no rows
template<int Columns, int Sides, class Scalar>
void substituteBackward(const Scalar* block, Index stride, int rows, const std::array<double*, Sides>& x)
{
    std::array<std::array<Lanes, Columns>, Sides> sum;
    for (auto& ofSide : sum)
    {
        ofSide.fill(Lanes::Zero());
    }
    for (int row = Columns; row < rows; row += lanes)
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
    for (int side = 0; side < Sides; ++side)
    {
        double* own = x[side];
        for (int first = Columns - columnsAtOnce; first >= 0; first -= columnsAtOnce)
        {
            const Scalar* one = block + first * stride;
            const Scalar* two = one + stride;
            const Scalar* three = two + stride;
            double a = own[first] - sum[side][first].sum();
            double b = own[first + 1] - sum[side][first + 1].sum();
            double c = own[first + 2] - sum[side][first + 2].sum();
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

} // namespace drystone::frontKernel
