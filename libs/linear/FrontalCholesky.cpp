// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
#include "linear/FrontalCholesky.h"

#include "linear/DenseKernel.h"
#include "linear/PivotBlock.h"

#include <algorithm>
#include <array>
#include <cstdint>

namespace drystone
{
namespace
{

using Eigen::Index;

/// Columns of L that a front may have are chosen as in CHOLMOD (Chen, Davis, Hager & Rajamanickam 2008): a
/// child is taken into its parent's front while that is narrow enough for the share of zeros it brings.
/// Measured on walls of 20 to 160 units: 12, 24 and 48 columns of any, 30% and 10% zeros cost the same
/// within 10%.
struct Amalgamation
{
    int columns;
    double zeros; ///< share of L
};
constexpr std::array<Amalgamation, 4> amalgamations{{{8, 1}, {24, 0.8}, {64, 0.2}, {1 << 30, 0.1}}};

/// Columns eliminated together by the kernel below. In wider fronts the dense kernel does what is between
/// such panels.
constexpr int panelWidth = 48;

/// Columns of a front from which on the packing of the dense kernel pays for its U. Measured on walls of 40
/// and 160 units: 1.27 and 52.6 ms with 12, 1.36 and 56 with 24, 1.5 and 60 with 48.
constexpr int denseFrom = 12;

/// The kernel works on three columns at once, of one body or half a body of six rows, and on registers of
/// four rows.
constexpr int columnsAtOnce = 3;
constexpr int lanes = 4;
using Lanes = Eigen::Array<double, lanes, 1>;

/// Numbers in a factor from which it is worth rounding: 8 MB, more than caches hold. A solve takes 0.8 ms
/// instead of 2.4 at 6,440 blocks and 8 instead of 13 at 25,680; their limit analyses 0.78 and 0.95 of the
/// time.
constexpr std::size_t roundedFrom = 1'000'000;

/// Numbers in a factor up to which it may be rounded: what that leaves of the balance grows with it. Limit
/// analyses of 102,560 blocks with a friction of 0.65 and 1 or 2% more or less took 31 to 38 factorisations
/// without, 36 to 40 with it, and one took 246 with 10 correctors, 27 without (now 24 without).
constexpr std::size_t roundedUpTo = 10'000'000;

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
Lanes lanesOf(const double* values)
{
    return Eigen::Map<const Lanes>(values);
}
Lanes lanesOf(const float* values)
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

/// Bodies whose columns are eliminated together.
struct Supernode
{
    int firstBody;
    int lastBody;     ///< one past
    int bodies;       ///< in the first column of L, its own included
    double zeros = 0; ///< blocks of L that are there for being together only
};

/// The supernodes of a factor, in the order of their bodies.
std::vector<Supernode> supernodes(const BlockPattern& factor, int rowsOfBlock)
{
    const std::vector<int>& start = factor.columnStart;
    std::vector<Supernode> found;
    for (int body = 0; body < factor.columns(); ++body)
    {
        found.push_back({body, body + 1, start[body + 1] - start[body]});
        while (found.size() > 1)
        {
            // The parent of the supernode before is this one if the first row below its columns says so.
            const Supernode& child = found[found.size() - 2];
            const Supernode& parent = found.back();
            const int last = child.lastBody - 1;
            if (start[last + 1] - start[last] < 2 || factor.row[start[last] + 1] >= parent.lastBody)
            {
                break;
            }
            const double width = child.lastBody - child.firstBody;
            const double together = width + parent.lastBody - parent.firstBody;
            const double bodies = width + parent.bodies;
            const double zeros = child.zeros + parent.zeros + width * (bodies - child.bodies);
            const double share = zeros / (together * (together + 1) / 2 + together * (bodies - together));
            const bool pays = std::any_of(amalgamations.begin(), amalgamations.end(),
                                          [&](const Amalgamation& amalgamation) {
                                              return rowsOfBlock * together <= amalgamation.columns
                                                     && share <= amalgamation.zeros;
                                          });
            if (!pays)
            {
                break;
            }
            const Supernode merged{child.firstBody, parent.lastBody, static_cast<int>(bodies), zeros};
            found.pop_back();
            found.back() = merged;
        }
    }
    return found;
}

/// A pool whose pieces are handed out where they fit first.
class Pool
{
public:
    std::size_t take(std::size_t size)
    {
        const auto fits = std::find_if(free_.begin(), free_.end(),
                                       [size](const Piece& piece) { return piece.size >= size; });
        if (fits == free_.end())
        {
            end_ += size;
            return end_ - size;
        }
        const std::size_t begin = fits->begin;
        fits->begin += size;
        fits->size -= size;
        if (fits->size == 0)
        {
            free_.erase(fits);
        }
        return begin;
    }

    void giveBack(std::size_t begin, std::size_t size)
    {
        auto next = std::find_if(free_.begin(), free_.end(),
                                 [begin](const Piece& piece) { return piece.begin > begin; });
        next = free_.insert(next, {begin, size});
        if (next + 1 != free_.end() && begin + size == (next + 1)->begin)
        {
            next->size += (next + 1)->size;
            free_.erase(next + 1);
        }
        if (next != free_.begin() && (next - 1)->begin + (next - 1)->size == begin)
        {
            (next - 1)->size += next->size;
            free_.erase(next);
        }
    }

    std::size_t size() const { return end_; }

private:
    struct Piece
    {
        std::size_t begin;
        std::size_t size;
    };
    std::vector<Piece> free_; ///< in order, none next to another
    std::size_t end_ = 0;
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
        front.firstRow = static_cast<int>(rows_.size());
        rows_.insert(rows_.end(), factor.row.begin() + factor.columnStart[front.lastBody - 1] + 1,
                     factor.row.begin() + factor.columnStart[front.lastBody]);
        front.lastRow = static_cast<int>(rows_.size());
        front.columns = size;
        size += static_cast<std::size_t>(front.width()) * front.height();
        highest_ = std::max(highest_, front.height());
        std::fill(frontOf.begin() + front.firstBody, frontOf.begin() + front.lastBody,
                  static_cast<int>(fronts_.size()));
        fronts_.push_back(std::move(front));
    }
    factor_.assign(size + overhang, 0);

    std::vector<int> place(matrix.columns());
    inParent_.resize(rows_.size());
    inFront_.resize(matrix.row.size());
    for (std::size_t index = 0; index < fronts_.size(); ++index)
    {
        Front& front = fronts_[index];
        if (front.lastRow > front.firstRow)
        {
            fronts_[frontOf[rows_[front.firstRow]]].children.push_back(static_cast<int>(index));
        }
        for (int body = front.firstBody; body < front.lastBody; ++body)
        {
            place[body] = body - front.firstBody;
        }
        for (int row = front.firstRow; row < front.lastRow; ++row)
        {
            place[rows_[row]] = front.lastBody - front.firstBody + row - front.firstRow;
        }
        for (int entry = matrix.columnStart[front.firstBody]; entry < matrix.columnStart[front.lastBody];
             ++entry)
        {
            inFront_[entry] = place[matrix.row[entry]];
        }
        for (const int child : front.children)
        {
            for (int row = fronts_[child].firstRow; row < fronts_[child].lastRow; ++row)
            {
                inParent_[row] = place[rows_[row]];
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
    for (Front& front : fronts_)
    {
        if (front.below() > 0)
        {
            front.update = pool.take(sizeOf(front));
        }
        for (const int child : front.children)
        {
            pool.giveBack(fronts_[child].update, sizeOf(fronts_[child]));
        }
    }
    updates_.assign(pool.size(), 0);
}

/// The columns of S that are the front's.
template<int Rows>
void FrontalCholesky<Rows>::assembleColumns(const Front& front, const BlockPattern& matrix,
                                            const Block* values)
{
    double* columns = factor_.data() + front.columns;
    const Index stride = front.height();
    std::fill(columns, columns + stride * front.width(), 0.0);
    for (int body = front.firstBody; body < front.lastBody; ++body)
    {
        for (int entry = matrix.columnStart[body]; entry < matrix.columnStart[body + 1]; ++entry)
        {
            double* to = columns + Rows * (body - front.firstBody) * stride + Rows * inFront_[entry];
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
    double* values = (isIntoColumns ? factor_ : updates_).data();
    // Where in `values` the first row and column of the front are, or would be if U had them too.
    const Index corner = isIntoColumns ? static_cast<Index>(front.columns)
                                       : static_cast<Index>(front.update) - (stride + 1) * Rows * ownBodies;
    for (const int index : front.children)
    {
        const Front& child = fronts_[index];
        const int bodies = child.lastRow - child.firstRow;
        const int* place = inParent_.data() + child.firstRow;
        const double* update = updates_.data() + child.update;
        runs_.clear();
        for (int body = 0; body < bodies; ++body)
        {
            if (body == 0 || place[body] != place[body - 1] + 1)
            {
                runs_.push_back({body, place[body] - body});
            }
            runs_.back().end = body + 1;
        }
        // Places ascend: those among the front's columns come first.
        const int split = static_cast<int>(std::lower_bound(place, place + bodies, ownBodies) - place);
        const int end = isIntoColumns ? split : bodies;
        std::size_t first = 0;
        for (int body = isIntoColumns ? 0 : split; body < end; ++body)
        {
            while (body >= runs_[first].end)
            {
                ++first;
            }
            for (int part = 0; part < Rows; ++part)
            {
                const double* from = update + (Rows * body + part) * Index{child.updateStride()};
                const Index to = corner + (Rows * place[body] + part) * stride;
                int row = Rows * body;
                for (std::size_t run = first; run < runs_.size(); ++run)
                {
                    const int endOfRun = Rows * runs_[run].end;
                    for (Index shifted = to + Rows * runs_[run].shift; row < endOfRun; ++row)
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
    denseKernel().update(task, alignedWork(packed_));
}

/// L11 and L21 from the columns of the front, panel by panel: the columns of a panel are freed of those
/// before it by the dense kernel, then three at a time by the kernel. Diagonal blocks of three rows are kept
/// inverted.
template<int Rows>
bool FrontalCholesky<Rows>::eliminateColumns(const Front& front)
{
    double* columns = factor_.data() + front.columns;
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
            Eigen::Matrix3d scale;
            if (!invertFactor<3, double>(diagonal, scale))
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
    const double* rows = factor_.data() + front.columns + front.width();
    double* update = updates_.data() + front.update;
    if (front.width() > denseFrom)
    {
        updateDensely({.target = DenseUpdate::Target::set,
                       .rows = below,
                       .columns = below,
                       .depth = front.width(),
                       .a = rows,
                       .aStride = height,
                       .c = update,
                       .cStride = stride});
        return;
    }
    for (int column = 0; column < below; column += columnsAtOnce)
    {
        multiply<Target::set>(rows + column, height, rows + column, height, front.width(),
                              update + column * Index{stride} + column, stride, below - column);
    }
}

template<int Rows>
bool FrontalCholesky<Rows>::factorise(const BlockPattern& matrix, const Block* values)
{
    rounded_.clear();
    for (const Front& front : fronts_)
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
    const std::size_t size = highest_ + overhang;
    work_.assign(Sides * size, 0);
    const auto part = [&](int row)
    {
        std::array<double*, Sides> parts;
        for (int side = 0; side < Sides; ++side)
        {
            parts[side] = work_.data() + side * size + row;
        }
        return parts;
    };
    for (const Front& front : fronts_)
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
                    x[side][Rows * rows_[row] + i] += from[i];
                }
            }
        }
    }
    for (auto front = fronts_.rbegin(); front != fronts_.rend(); ++front)
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
                std::copy_n(x[side] + Rows * rows_[row], Rows, to);
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
    solveFor<1>({x.data()}, factor_.data());
}

template<int Rows>
void FrontalCholesky<Rows>::solve(Eigen::Ref<Eigen::VectorXd> one, Eigen::Ref<Eigen::VectorXd> other)
{
    solveFor<2>({one.data(), other.data()}, factor_.data());
}

template<int Rows>
void FrontalCholesky<Rows>::solveRoughly(Eigen::Ref<Eigen::VectorXd> x)
{
    if (factor_.size() < roundedFrom || factor_.size() > roundedUpTo)
    {
        return solve(x);
    }
    if (rounded_.empty())
    {
        rounded_.assign(factor_.begin(), factor_.end());
    }
    solveFor<1>({x.data()}, rounded_.data());
}

template class FrontalCholesky<3>;
template class FrontalCholesky<6>;

} // namespace drystone
