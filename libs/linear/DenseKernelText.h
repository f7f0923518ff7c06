// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The text of the dense kernels, for files that are compiled for one kind of processor each. Nothing of
/// other headers that is inline may be used here: the linker keeps one copy of it, perhaps the one for a
/// processor that this machine has not. What is here has a copy in each file.
///
/// The blocking is that of Goto & van de Geijn (2008), "Anatomy of high-performance matrix multiplication": a
/// slice of A so deep and so high is copied once, in the order in which it is read, so that it stays in the
/// second cache, and is multiplied with a slice of B that stays in the third; the innermost loop keeps a tile
/// of C in registers.
#pragma once

#include "linear/DenseKernel.h"

namespace drystone
{
namespace
{

/// \tparam lanes numbers in a register \tparam registers of a column of a tile \tparam width columns of a
/// tile
template<int lanes, int registers, int width>
struct KernelText
{
    typedef double Lanes __attribute__((vector_size(8 * lanes)));
    typedef double Stored __attribute__((vector_size(8 * lanes), may_alias)); ///< Lanes among numbers
    static constexpr int height = lanes * registers;                          ///< rows of a tile
    static constexpr int deep = 256;                                          ///< columns of A in a slice
    static constexpr int high = 192;  ///< rows of A in a slice, of whole tiles
    static constexpr int wide = 2048; ///< rows of B in a slice, of whole tiles
    static_assert(high % height == 0 && wide % width == 0);
    static_assert(long{deep} * (high + wide) <= denseKernelWork);

    /// Rows of A from `first` on, `tileRows` together, those missing from the last as zeros.
    static void pack(const double* a, long stride, int first, int rows, int depth, int tileRows,
                     double* packed)
    {
        for (int begin = 0; begin < rows; begin += tileRows)
        {
            const int here = rows - begin < tileRows ? rows - begin : tileRows;
            const double* from = a + first + begin;
            for (int k = 0; k < depth; ++k, packed += tileRows, from += stride)
            {
                for (int row = 0; row < here; ++row)
                {
                    packed[row] = from[row];
                }
                for (int row = here; row < tileRows; ++row)
                {
                    packed[row] = 0;
                }
            }
        }
    }

    /// The product of a tile of A and one of B, in registers until its end.
    static void multiplyTile(int depth, const double* a, const double* b, double* product)
    {
        Lanes sum[width][registers] = {};
        for (int k = 0; k < depth; ++k, a += height, b += width)
        {
            Lanes rows[registers];
            for (int part = 0; part < registers; ++part)
            {
                rows[part] = *reinterpret_cast<const Stored*>(a + lanes * part);
            }
            for (int column = 0; column < width; ++column)
            {
                for (int part = 0; part < registers; ++part)
                {
                    sum[column][part] += rows[part] * b[column];
                }
            }
        }
        for (int column = 0; column < width; ++column)
        {
            for (int part = 0; part < registers; ++part)
            {
                *reinterpret_cast<Stored*>(product + column * height + lanes * part) = sum[column][part];
            }
        }
    }

    /// Takes a tile's product from C, on and below the diagonal.
    static void take(const double* product, int row, int column, int rows, int columns,
                     DenseUpdate::Target target, double* c, long stride)
    {
        for (int j = 0; j < columns; ++j, product += height)
        {
            double* to = c + (column + j) * stride + row;
            const int onDiagonal = column + j - row;
            if (target == DenseUpdate::Target::set)
            {
                for (int i = onDiagonal > 0 ? onDiagonal : 0; i < rows; ++i)
                {
                    to[i] = -product[i];
                }
            }
            else
            {
                for (int i = onDiagonal > 0 ? onDiagonal : 0; i < rows; ++i)
                {
                    to[i] -= product[i];
                }
            }
        }
    }

    static void update(const DenseUpdate& task, double* work)
    {
        alignas(64) double product[width * height];
        double* const packedB = work;
        double* const packedA = work + long{deep} * wide;
        for (int beginColumn = 0; beginColumn < task.columns; beginColumn += wide)
        {
            const int columns = task.columns - beginColumn < wide ? task.columns - beginColumn : wide;
            for (int beginDepth = 0; beginDepth < task.depth; beginDepth += deep)
            {
                const int depth = task.depth - beginDepth < deep ? task.depth - beginDepth : deep;
                // The first depth writes C where it is to be set, the others subtract from that.
                const DenseUpdate::Target target =
                    beginDepth == 0 ? task.target : DenseUpdate::Target::subtract;
                const double* a = task.a + beginDepth * task.aStride;
                pack(a, task.aStride, beginColumn, columns, depth, width, packedB);
                for (int beginRow = beginColumn > task.firstRow ? beginColumn : task.firstRow;
                     beginRow < task.rows; beginRow += high)
                {
                    const int rows = task.rows - beginRow < high ? task.rows - beginRow : high;
                    pack(a, task.aStride, beginRow, rows, depth, height, packedA);
                    for (int column = 0; column < columns; column += width)
                    {
                        for (int row = 0; row < rows; row += height)
                        {
                            if (beginRow + row + height <= beginColumn + column)
                            {
                                continue; // above the diagonal
                            }
                            multiplyTile(depth, packedA + long{row} * depth, packedB + long{column} * depth,
                                         product);
                            take(product, beginRow + row, beginColumn + column,
                                 rows - row < height ? rows - row : height,
                                 columns - column < width ? columns - column : width, target, task.c,
                                 task.cStride);
                        }
                    }
                }
            }
        }
    }
};

} // namespace
} // namespace drystone
