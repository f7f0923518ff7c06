// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The text of the lane kernels, first part: numbers of several lanes, the factor of the Schur system, and
/// solutions with it. For files that are compiled for one kind of processor each: nothing of other headers
/// that is inline may be used here, see DenseKernelText.h.
#pragma once

#include "conic/lanes/LaneTask.h"

namespace drystone
{
namespace
{

/// A vector register, and what comparisons of two leave.
template<int lanes>
struct LaneTypes;
template<>
struct LaneTypes<8>
{
    typedef double Number __attribute__((vector_size(64), may_alias));
    typedef long Mask __attribute__((vector_size(64)));
};
template<>
struct LaneTypes<4>
{
    typedef double Number __attribute__((vector_size(32), may_alias));
    typedef long Mask __attribute__((vector_size(32)));
};
template<>
struct LaneTypes<2>
{
    typedef double Number __attribute__((vector_size(16), may_alias));
    typedef long Mask __attribute__((vector_size(16)));
};

/// Arithmetic on as many numbers at once as a register has; each operation works on every lane by itself.
template<int lanes>
struct LaneArithmetic
{
    using Number = typename LaneTypes<lanes>::Number;
    using Mask = typename LaneTypes<lanes>::Mask;

    static Number& at(double* numbers, long index) { return *(Number*)(numbers + lanes * index); }
    static const Number& at(const double* numbers, long index)
    {
        return *(const Number*)(numbers + lanes * index);
    }
    static Number all(double value) { return Number{} + value; }
    static Mask every() { return Mask{} - 1; }
    static Number larger(Number a, Number b) { return a > b ? a : b; }
    static Number smaller(Number a, Number b) { return a < b ? a : b; }
    static Number sizeOf(Number a) { return larger(a, -a); }
    static Number rootOf(Number a)
    {
        Number root;
        for (int lane = 0; lane < lanes; ++lane)
        {
            root[lane] = __builtin_sqrt(a[lane]);
        }
        return root;
    }
    /// 1 / sqrt(a) to 0.2%: a step of Newton's from an estimate by the exponent.
    static Number roughInverseRoot(Number a)
    {
        Number root = (Number)(0x5fe6eb50c7b537a9L - ((Mask)a >> 1));
        return root * (1.5 - 0.5 * a * root * root);
    }
    static bool any(Mask mask)
    {
        long bits = 0;
        for (int lane = 0; lane < lanes; ++lane)
        {
            bits |= mask[lane];
        }
        return bits != 0;
    }
};

/// S = L L' by blocks of 3 x 3, each block at once with all products that it takes away.
template<int lanes>
struct LaneFactor : LaneArithmetic<lanes>
{
    using Base = LaneArithmetic<lanes>;
    using Base::all;
    using Base::any;
    using Base::at;
    using Base::rootOf;
    using typename Base::Mask;
    using typename Base::Number;

    explicit LaneFactor(LaneTask& ofTask)
        : task(ofTask), graph(ofTask.graph), blocks(ofTask.numbers.blocks), rows(3L * ofTask.graph.bodies)
    {
    }

    static double* blockAt(double* blocks, long place) { return blocks + 9 * lanes * place; }

    /// Factorises what stands in the blocks, of the diagonal ones the lower triangles, raised by a share.
    /// \return lanes with a pivot that is not positive
    Mask factorise(Number raised)
    {
        Mask failed = Mask{};
        for (int column = 0; column < graph.bodies; ++column)
        {
            const int begin = graph.columnStart[column];
            const int end = graph.columnStart[column + 1];
            factoriseDiagonal(begin, 1 + raised, failed);
            for (int place = begin + 1; place < end; ++place)
            {
                factoriseBlock(place, blockAt(blocks, begin));
            }
        }
        return failed;
    }

    /// x = S^-1 x, rows; those of the ground become zero.
    template<int sides>
    void solve(double* const (&x)[sides])
    {
        for (int body = 0; body < graph.bodies; ++body)
        {
            forwards(body, x);
        }
        for (int body = graph.bodies; body-- > 0;)
        {
            backwards(body, x);
        }
        for (int side = 0; side < sides; ++side)
        {
            for (int row = 0; row < 3; ++row)
            {
                at(x[side], rows + row) = Number{};
            }
        }
    }

    Number product(const double* a, const double* b) const
    {
        Number sum[3] = {}; // a sum waits for the one before
        for (long row = 0; row < rows; row += 3)
        {
            for (int k = 0; k < 3; ++k)
            {
                sum[k] += at(a, row + k) * at(b, row + k);
            }
        }
        return sum[0] + sum[1] + sum[2];
    }

    Number largest(const double* a) const
    {
        Number most = Number{};
        for (long row = 0; row < rows; ++row)
        {
            most = Base::larger(most, Base::sizeOf(at(a, row)));
        }
        return most;
    }

    LaneTask& task;
    const LaneGraph graph;
    double* const blocks;
    const long rows;

private:
    /// The inverse of the triangle, in its place. A pivot that is not positive becomes 1.
    void factoriseDiagonal(int place, Number raise, Mask& failed)
    {
        double* block = blockAt(blocks, place);
        Number a00 = at(block, 0) * raise;
        Number a10 = at(block, 1);
        Number a20 = at(block, 2);
        Number a11 = at(block, 4) * raise;
        Number a21 = at(block, 5);
        Number a22 = at(block, 8) * raise;
        for (int product = graph.productStart[place]; product < graph.productStart[place + 1]; ++product)
        {
            const double* left = blockAt(blocks, graph.product[product].left);
            for (int k = 0; k < 3; ++k)
            {
                const Number l0 = at(left, 3 * k);
                const Number l1 = at(left, 3 * k + 1);
                const Number l2 = at(left, 3 * k + 2);
                a00 -= l0 * l0;
                a10 -= l1 * l0;
                a20 -= l2 * l0;
                a11 -= l1 * l1;
                a21 -= l2 * l1;
                a22 -= l2 * l2;
            }
        }
        const auto inverse = [&failed](Number pivot)
        {
            const Mask isPositive = pivot > 0;
            failed |= ~isPositive;
            return 1 / rootOf(isPositive ? pivot : all(1));
        };
        const Number i00 = inverse(a00);
        const Number l10 = a10 * i00;
        const Number l20 = a20 * i00;
        const Number i11 = inverse(a11 - l10 * l10);
        const Number l21 = (a21 - l20 * l10) * i11;
        const Number i22 = inverse(a22 - l20 * l20 - l21 * l21);
        const Number i10 = -l10 * i00 * i11;
        at(block, 0) = i00;
        at(block, 1) = i10;
        at(block, 2) = -(l20 * i00 + l21 * i10) * i22;
        at(block, 4) = i11;
        at(block, 5) = -l21 * i11 * i22;
        at(block, 8) = i22;
    }

    /// \param inverse of the triangle above
    void factoriseBlock(int place, const double* inverse)
    {
        double* block = blockAt(blocks, place);
        Number c[3][3];
        for (int k = 0; k < 9; ++k)
        {
            c[k / 3][k % 3] = at(block, k);
        }
        for (int product = graph.productStart[place]; product < graph.productStart[place + 1]; ++product)
        {
            const double* left = blockAt(blocks, graph.product[product].left);
            const double* right = blockAt(blocks, graph.product[product].right);
            for (int k = 0; k < 3; ++k)
            {
                const Number l0 = at(left, 3 * k);
                const Number l1 = at(left, 3 * k + 1);
                const Number l2 = at(left, 3 * k + 2);
                for (int column = 0; column < 3; ++column)
                {
                    const Number r = at(right, 3 * k + column);
                    c[column][0] -= l0 * r;
                    c[column][1] -= l1 * r;
                    c[column][2] -= l2 * r;
                }
            }
        }
        const Number i00 = at(inverse, 0);
        const Number i10 = at(inverse, 1);
        const Number i20 = at(inverse, 2);
        const Number i11 = at(inverse, 4);
        const Number i21 = at(inverse, 5);
        const Number i22 = at(inverse, 8);
        for (int row = 0; row < 3; ++row)
        {
            at(block, row) = c[0][row] * i00;
            at(block, 3 + row) = c[0][row] * i10 + c[1][row] * i11;
            at(block, 6 + row) = c[0][row] * i20 + c[1][row] * i21 + c[2][row] * i22;
        }
    }

    template<int sides>
    void forwards(int body, double* const (&x)[sides])
    {
        Number b[sides][3];
        load(body, x, b);
        for (int update = graph.updateStart[body]; update < graph.updateStart[body + 1]; ++update)
        {
            const double* block = blockAt(blocks, graph.updatePosition[update]);
            const long from = 3L * graph.updateColumn[update];
            for (int k = 0; k < 3; ++k)
            {
                for (int side = 0; side < sides; ++side)
                {
                    const Number known = at(x[side], from + k);
                    b[side][0] -= at(block, 3 * k) * known;
                    b[side][1] -= at(block, 3 * k + 1) * known;
                    b[side][2] -= at(block, 3 * k + 2) * known;
                }
            }
        }
        const double* inverse = blockAt(blocks, graph.columnStart[body]);
        for (int side = 0; side < sides; ++side)
        {
            const Number* of = b[side];
            at(x[side], 3L * body) = at(inverse, 0) * of[0];
            at(x[side], 3L * body + 1) = at(inverse, 1) * of[0] + at(inverse, 4) * of[1];
            at(x[side], 3L * body + 2) =
                at(inverse, 2) * of[0] + at(inverse, 5) * of[1] + at(inverse, 8) * of[2];
        }
    }

    template<int sides>
    void backwards(int body, double* const (&x)[sides])
    {
        Number b[sides][3];
        load(body, x, b);
        for (int place = graph.columnStart[body] + 1; place < graph.columnStart[body + 1]; ++place)
        {
            const double* block = blockAt(blocks, place);
            const long from = 3L * graph.row[place];
            for (int side = 0; side < sides; ++side)
            {
                const Number k0 = at(x[side], from);
                const Number k1 = at(x[side], from + 1);
                const Number k2 = at(x[side], from + 2);
                for (int k = 0; k < 3; ++k)
                {
                    b[side][k] -= at(block, 3 * k) * k0;
                    b[side][k] -= at(block, 3 * k + 1) * k1;
                    b[side][k] -= at(block, 3 * k + 2) * k2;
                }
            }
        }
        const double* inverse = blockAt(blocks, graph.columnStart[body]);
        for (int side = 0; side < sides; ++side)
        {
            const Number* of = b[side];
            at(x[side], 3L * body) = at(inverse, 0) * of[0] + at(inverse, 1) * of[1] + at(inverse, 2) * of[2];
            at(x[side], 3L * body + 1) = at(inverse, 4) * of[1] + at(inverse, 5) * of[2];
            at(x[side], 3L * body + 2) = at(inverse, 8) * of[2];
        }
    }

    template<int sides>
    static void load(int body, double* const (&x)[sides], Number (&b)[sides][3])
    {
        for (int side = 0; side < sides; ++side)
        {
            for (int row = 0; row < 3; ++row)
            {
                b[side][row] = at(x[side], 3L * body + row);
            }
        }
    }
};

} // namespace
} // namespace drystone
