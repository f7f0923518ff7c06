// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
#include "linear/FrontalCholesky.h"

#include "linear/DenseKernel.h"
#include "linear/FrontKernel.h"
#include "linear/PivotBlock.h"
#include "linear/Supernodes.h"

#include <algorithm>
#include <array>
#include <cstdint>

namespace drystone
{
namespace
{

using namespace frontKernel;

/// Columns eliminated together by the kernel below. In wider fronts the dense kernel does what is between
/// such panels.
constexpr int panelWidth = 48;

/// Columns of a front from which on the packing of the dense kernel pays for its U. Measured on walls of 40
/// and 160 units: 1.27 and 52.6 ms with 12, 1.36 and 56 with 24, 1.5 and 60 with 48.
constexpr int denseFrom = 12;

/// Numbers in a factor from which it is worth rounding: 8 MB, more than caches hold. A solve takes 0.8 ms
/// instead of 2.4 at 6,440 blocks and 8 instead of 13 at 25,680; their limit analyses 0.78 and 0.95 of the
/// time.
constexpr std::size_t roundedFrom = 1'000'000;

/// Numbers in a factor up to which it may be rounded: what that leaves of the balance grows with it. Limit
/// analyses of 102,560 blocks with a friction of 0.65 and 1 or 2% more or less took 31 to 38 factorisations
/// without, 36 to 40 with it, and one took 246 with 10 correctors, 27 without (now 24 without).
constexpr std::size_t roundedUpTo = 10'000'000;

/// A pool whose pieces are handed out where they fit first.
class Pool
{
public:
    std::size_t take(std::size_t size)
    {
        const auto fits = std::find_if(unused.begin(), unused.end(),
                                       [size](const Piece& piece) { return piece.size >= size; });
        if (fits == unused.end())
        {
            end += size;
            return end - size;
        }
        const std::size_t begin = fits->begin;
        fits->begin += size;
        fits->size -= size;
        if (fits->size == 0)
        {
            unused.erase(fits);
        }
        return begin;
    }

    void giveBack(std::size_t begin, std::size_t size)
    {
        auto next = std::find_if(unused.begin(), unused.end(),
                                 [begin](const Piece& piece) { return piece.begin > begin; });
        next = unused.insert(next, {begin, size});
        if (next + 1 != unused.end() && begin + size == (next + 1)->begin)
        {
            next->size += (next + 1)->size;
            unused.erase(next + 1);
        }
        if (next != unused.begin() && (next - 1)->begin + (next - 1)->size == begin)
        {
            (next - 1)->size += next->size;
            unused.erase(next);
        }
    }

    std::size_t size() const { return end; }

private:
    struct Piece
    {
        std::size_t begin;
        std::size_t size;
    };
    std::vector<Piece> unused; ///< in order, none next to another
    std::size_t end = 0;
};

} // namespace

template<int Rows>
FrontalCholesky<Rows>::FrontalCholesky(const BlockPattern& matrix, const BlockPattern& factor)
{
    static_assert(Rows % columnsAtOnce == 0);
    std::vector<int> frontOf(matrix.columns());
    std::size_t size = 0;
    for (const Supernode& supernode : supernodes(factor, Rows))
    {
        Front front;
        front.firstBody = supernode.firstBody;
        front.lastBody = supernode.lastBody;
        // What the last column has below the diagonal, all columns of the front have or get.
        front.firstRow = static_cast<int>(rows.size());
        rows.insert(rows.end(), factor.row.begin() + factor.columnStart[front.lastBody - 1] + 1,
                    factor.row.begin() + factor.columnStart[front.lastBody]);
        front.lastRow = static_cast<int>(rows.size());
        front.columns = size;
        size += static_cast<std::size_t>(front.width()) * front.height();
        highest = std::max(highest, front.height());
        std::fill(frontOf.begin() + front.firstBody, frontOf.begin() + front.lastBody,
                  static_cast<int>(fronts.size()));
        fronts.push_back(std::move(front));
    }
    lower.assign(size + overhang, 0);

    std::vector<int> place(matrix.columns());
    inParent.resize(rows.size());
    inFront.resize(matrix.row.size());
    for (std::size_t index = 0; index < fronts.size(); ++index)
    {
        Front& front = fronts[index];
        if (front.lastRow > front.firstRow)
        {
            fronts[frontOf[rows[front.firstRow]]].children.push_back(static_cast<int>(index));
        }
        for (int body = front.firstBody; body < front.lastBody; ++body)
        {
            place[body] = body - front.firstBody;
        }
        for (int row = front.firstRow; row < front.lastRow; ++row)
        {
            place[rows[row]] = front.lastBody - front.firstBody + row - front.firstRow;
        }
        for (int entry = matrix.columnStart[front.firstBody]; entry < matrix.columnStart[front.lastBody];
             ++entry)
        {
            inFront[entry] = place[matrix.row[entry]];
        }
        for (const int child : front.children)
        {
            for (int row = fronts[child].firstRow; row < fronts[child].lastRow; ++row)
            {
                inParent[row] = place[rows[row]];
            }
        }
    }
    placeUpdates();
}

/// Each U gets its place until the parent has taken it: whatever the order, few wait at a time.
template<int Rows>
void FrontalCholesky<Rows>::placeUpdates()
{
    Pool pool;
    const auto sizeOf = [](const Front& front)
    { return static_cast<std::size_t>(front.updateStride()) * front.below() + overhang; };
    for (Front& front : fronts)
    {
        if (front.below() > 0)
        {
            front.update = pool.take(sizeOf(front));
        }
        for (const int child : front.children)
        {
            pool.giveBack(fronts[child].update, sizeOf(fronts[child]));
        }
    }
    updates.assign(pool.size(), 0);
}

/// The columns of S that are the front's.
template<int Rows>
void FrontalCholesky<Rows>::assembleColumns(const Front& front, const BlockPattern& matrix,
                                            const Block* values)
{
    double* columns = lower.data() + front.columns;
    const Index stride = front.height();
    std::fill(columns, columns + stride * front.width(), 0.0);
    for (int body = front.firstBody; body < front.lastBody; ++body)
    {
        for (int entry = matrix.columnStart[body]; entry < matrix.columnStart[body + 1]; ++entry)
        {
            double* to = columns + Rows * (body - front.firstBody) * stride + Rows * inFront[entry];
            Eigen::Map<Block, 0, Eigen::OuterStride<>>(to, Eigen::OuterStride<>(stride)) = values[entry];
        }
    }
}

/// Adds those parts of the children's U that belong into the columns of the front, or into its own U.
template<int Rows>
void FrontalCholesky<Rows>::addUpdates(const Front& front, Into into)
{
    const int ownBodies = front.lastBody - front.firstBody;
    const bool isIntoColumns = into == Into::columns;
    const Index stride = isIntoColumns ? front.height() : front.updateStride();
    double* values = (isIntoColumns ? lower : updates).data();
    // Where in `values` the first row and column of the front are, or would be if U had them too.
    const Index corner = isIntoColumns ? static_cast<Index>(front.columns)
                                       : static_cast<Index>(front.update) - (stride + 1) * Rows * ownBodies;
    for (const int index : front.children)
    {
        const Front& child = fronts[index];
        const int bodies = child.lastRow - child.firstRow;
        const int* place = inParent.data() + child.firstRow;
        const double* update = updates.data() + child.update;
        runs.clear();
        for (int body = 0; body < bodies; ++body)
        {
            if (body == 0 || place[body] != place[body - 1] + 1)
            {
                runs.push_back({body, place[body] - body});
            }
            runs.back().end = body + 1;
        }
        // Places ascend: those among the front's columns come first.
        const int split = static_cast<int>(std::lower_bound(place, place + bodies, ownBodies) - place);
        const int end = isIntoColumns ? split : bodies;
        std::size_t first = 0;
        for (int body = isIntoColumns ? 0 : split; body < end; ++body)
        {
            while (body >= runs[first].end)
            {
                ++first;
            }
            for (int part = 0; part < Rows; ++part)
            {
                const double* from = update + (Rows * body + part) * Index{child.updateStride()};
                const Index to = corner + (Rows * place[body] + part) * stride;
                int row = Rows * body;
                for (std::size_t run = first; run < runs.size(); ++run)
                {
                    const int endOfRun = Rows * runs[run].end;
                    for (Index shifted = to + Rows * runs[run].shift; row < endOfRun; ++row)
                    {
                        values[shifted + row] += from[row];
                    }
                }
            }
        }
    }
}

template<int Rows>
void FrontalCholesky<Rows>::updateDensely(const DenseUpdate& task)
{
    denseKernel().update(task, alignedWork(packed));
}

/// L11 and L21 from the columns of the front, panel by panel: the columns of a panel are freed of those
/// before it by the dense kernel, then three at a time by the kernel. Diagonal blocks of three rows are kept
/// inverted.
template<int Rows>
bool FrontalCholesky<Rows>::eliminateColumns(const Front& front)
{
    double* columns = lower.data() + front.columns;
    const int width = front.width();
    const int height = front.height();
    for (int panel = 0; panel < width; panel += panelWidth)
    {
        const int end = std::min(width, panel + panelWidth);
        double* corner = columns + panel * Index{height} + panel;
        if (panel > 0)
        {
            const double* before = columns + panel;
            updateDensely({.target = DenseUpdate::Target::subtract,
                           .rows = height - panel,
                           .columns = end - panel,
                           .depth = panel,
                           .a = before,
                           .aStride = height,
                           .c = corner,
                           .cStride = height});
        }
        for (int column = panel; column < end; column += columnsAtOnce)
        {
            const double* before = columns + panel * Index{height} + column;
            double* block = columns + column * Index{height} + column;
            multiply<Target::subtract>(before, height, before, height, column - panel, block, height,
                                       height - column);
            Eigen::Map<Eigen::Matrix3d, 0, Eigen::OuterStride<>> diagonal(block,
                                                                          Eigen::OuterStride<>(height));
            Eigen::Matrix3d factor = diagonal;
            Eigen::Matrix3d scale;
            if (!invertFactor<3, double>(factor, scale))
            {
                return false;
            }
            diagonal = scale;
            double* one = block;
            double* two = one + height;
            double* three = two + height;
            for (int row = columnsAtOnce; row < height - column; ++row)
            {
                three[row] = one[row] * scale(2, 0) + two[row] * scale(2, 1) + three[row] * scale(2, 2);
                two[row] = one[row] * scale(1, 0) + two[row] * scale(1, 1);
                one[row] *= scale(0, 0);
            }
        }
    }
    // Tiles that reached beyond the end of a column have left numbers at the top of the next, above its
    // diagonal. Solves multiply them with zero: they must be finite, and in ill-conditioned fronts they grow
    // from column to column beyond what a double holds.
    for (int column = 1; column < width; ++column)
    {
        std::fill_n(columns + column * Index{height}, std::min(column, lanes - 1), 0.0);
    }
    return true;
}

/// U = -L21 L21', its lower triangle.
template<int Rows>
void FrontalCholesky<Rows>::updateBelow(const Front& front)
{
    const int below = front.below();
    if (below == 0)
    {
        return;
    }
    const int height = front.height();
    const int stride = front.updateStride();
    const double* lower21 = lower.data() + front.columns + front.width();
    double* update = updates.data() + front.update;
    if (front.width() > denseFrom)
    {
        updateDensely({.target = DenseUpdate::Target::set,
                       .rows = below,
                       .columns = below,
                       .depth = front.width(),
                       .a = lower21,
                       .aStride = height,
                       .c = update,
                       .cStride = stride});
        return;
    }
    for (int column = 0; column < below; column += columnsAtOnce)
    {
        multiply<Target::set>(lower21 + column, height, lower21 + column, height, front.width(),
                              update + column * Index{stride} + column, stride, below - column);
    }
}

template<int Rows>
bool FrontalCholesky<Rows>::factorise(const BlockPattern& matrix, const Block* values)
{
    rounded.clear();
    for (const Front& front : fronts)
    {
        assembleColumns(front, matrix, values);
        addUpdates(front, Into::columns);
        if (!eliminateColumns(front))
        {
            return false;
        }
        updateBelow(front);
        addUpdates(front, Into::update);
    }
    return true;
}

template<int Rows>
template<int Sides, class Scalar>
void FrontalCholesky<Rows>::solveFor(const std::array<double*, Sides>& x, const Scalar* factor)
{
    constexpr int atOnce = columnsOfSolve<Sides>;
    // One front's part of each right side, its own rows and those below, one after the other as in the front.
    const std::size_t size = highest + overhang;
    work.assign(Sides * size, 0);
    const auto part = [&](int row)
    {
        std::array<double*, Sides> parts;
        for (int side = 0; side < Sides; ++side)
        {
            parts[side] = work.data() + side * size + row;
        }
        return parts;
    };
    for (const Front& front : fronts)
    {
        const int width = front.width();
        const int height = front.height();
        const Scalar* columns = factor + front.columns;
        for (int side = 0; side < Sides; ++side)
        {
            double* to = part(0)[side];
            std::copy_n(x[side] + Rows * front.firstBody, width, to);
            std::fill(to + width, to + height, 0.0);
        }
        int column = 0;
        for (; column + atOnce <= width; column += atOnce)
        {
            substituteForward<atOnce, Sides>(columns + column * Index{height} + column, height,
                                             height - column, part(column));
        }
        for (; column < width; column += columnsAtOnce)
        {
            substituteForward<columnsAtOnce, Sides>(columns + column * Index{height} + column, height,
                                                    height - column, part(column));
        }
        for (int side = 0; side < Sides; ++side)
        {
            const double* from = part(0)[side];
            std::copy_n(from, width, x[side] + Rows * front.firstBody);
            from += width;
            for (int row = front.firstRow; row < front.lastRow; ++row, from += Rows)
            {
                for (int i = 0; i < Rows; ++i)
                {
                    x[side][Rows * rows[row] + i] += from[i];
                }
            }
        }
    }
    for (auto front = fronts.rbegin(); front != fronts.rend(); ++front)
    {
        const int width = front->width();
        const int height = front->height();
        const Scalar* columns = factor + front->columns;
        for (int side = 0; side < Sides; ++side)
        {
            double* to = part(0)[side];
            std::copy_n(x[side] + Rows * front->firstBody, width, to);
            to += width;
            for (int row = front->firstRow; row < front->lastRow; ++row, to += Rows)
            {
                std::copy_n(x[side] + Rows * rows[row], Rows, to);
            }
            std::fill(to, part(height)[side] + lanes, 0.0);
        }
        int column = width;
        for (; column % atOnce != 0; column -= columnsAtOnce)
        {
            const int first = column - columnsAtOnce;
            substituteBackward<columnsAtOnce, Sides>(columns + first * Index{height} + first, height,
                                                     height - first, part(first));
        }
        for (; column > 0; column -= atOnce)
        {
            const int first = column - atOnce;
            substituteBackward<atOnce, Sides>(columns + first * Index{height} + first, height, height - first,
                                              part(first));
        }
        for (int side = 0; side < Sides; ++side)
        {
            std::copy_n(part(0)[side], width, x[side] + Rows * front->firstBody);
        }
    }
}

template<int Rows>
void FrontalCholesky<Rows>::solve(Eigen::Ref<Eigen::VectorXd> x)
{
    solveFor<1>({x.data()}, lower.data());
}

template<int Rows>
void FrontalCholesky<Rows>::solve(Eigen::Ref<Eigen::VectorXd> one, Eigen::Ref<Eigen::VectorXd> other)
{
    solveFor<2>({one.data(), other.data()}, lower.data());
}

template<int Rows>
void FrontalCholesky<Rows>::solveRoughly(Eigen::Ref<Eigen::VectorXd> x)
{
    if (lower.size() < roundedFrom || lower.size() > roundedUpTo)
    {
        return solve(x);
    }
    if (rounded.empty())
    {
        rounded.assign(lower.begin(), lower.end());
    }
    solveFor<1>({x.data()}, rounded.data());
}

template class FrontalCholesky<3>;
template class FrontalCholesky<6>;

} // namespace drystone
