// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Solves with a factor by fronts.
#include "core/Threads.h"
#include "linear/FrontKernel.h"
#include "linear/FrontalCholesky.h"

namespace drystone
{
namespace
{

using namespace frontKernel;

/// Numbers in a factor from which it is worth rounding: 8 MB, more than caches hold.
constexpr std::size_t roundedFrom = 1'000'000;

/// Numbers in a factor up to which it may be rounded: what that leaves of the balance grows with it, and
/// costs iterations (TUNING.md).
constexpr std::size_t roundedUpTo = 10'000'000;

/// Numbers of a front above the tasks from which several threads share it: 0.8 MB, some 50 microseconds.
constexpr long sharedFrom = 100'000;

/// Columns of a large front between which threads wait for each other, and rows of it that are one task.
constexpr int panelOfSolve = 96;
constexpr int rowsOfTask = 256;

/// Rows between two columns of the same panel.
template<int Columns, int Sides, class Scalar>
void addProductsWithin(const Scalar* block, Index stride, int rows, const std::array<double*, Sides>& x,
                       OfColumns<Columns, Sides>& products)
{
    for (int side = 0; side < Sides; ++side)
    {
        for (int row = Columns; row < rows; ++row)
        {
            for (int column = 0; column < Columns; ++column)
            {
                products[side][column] += static_cast<double>(block[column * stride + row]) * x[side][row];
            }
        }
    }
}

template<int Rows>
void addRows(const double* from, double* to)
{
    for (int row = 0; row < Rows; ++row)
    {
        to[row] += from[row];
    }
}

/// The parts of each right side from a row on.
template<int Sides>
std::array<double*, Sides> from(std::array<double*, Sides> parts, int row)
{
    for (double*& part : parts)
    {
        part += row;
    }
    return parts;
}

} // namespace

/// One front's part of each right side, its own rows and those below, one after the other as in the front.
template<int Rows>
template<int Sides>
std::array<double*, Sides> FrontalCholesky<Rows>::partsOf(Worker& worker) const
{
    const std::size_t size = plan.highest + overhang;
    if (worker.parts.size() < Sides * size)
    {
        worker.parts.resize(Sides * size);
    }
    std::array<double*, Sides> parts;
    for (int side = 0; side < Sides; ++side)
    {
        parts[side] = worker.parts.data() + side * size;
    }
    return parts;
}

template<int Rows>
template<int Sides, class Scalar>
void FrontalCholesky<Rows>::forward(const Front<Rows>& front, const RightSides<Sides>& to,
                                    const Scalar* factor, Worker& worker)
{
    constexpr int atOnce = columnsOfSolve<Sides>;
    const std::array<double*, Sides> part = partsOf<Sides>(worker);
    const int width = front.width();
    const int height = front.height();
    const Scalar* columns = factor + front.columns;
    for (int side = 0; side < Sides; ++side)
    {
        std::copy_n(to.x[side] + Rows * front.firstBody, width, part[side]);
        std::fill(part[side] + width, part[side] + height + overhang, 0.0);
    }
    if (!front.isOfTask && long{width} * height >= sharedFrom)
    {
        forwardTogether<Sides>(front, columns, part);
    }
    else
    {
        int column = 0;
        for (; column + atOnce <= width; column += atOnce)
        {
            substituteForward<atOnce, Sides>(columns + column * Index{height} + column, height,
                                             height - column, from<Sides>(part, column));
        }
        for (; column < width; column += columnsAtOnce)
        {
            substituteForward<columnsAtOnce, Sides>(columns + column * Index{height} + column, height,
                                                    height - column, from<Sides>(part, column));
        }
    }
    for (int side = 0; side < Sides; ++side)
    {
        const double* next = part[side];
        std::copy_n(next, width, to.x[side] + Rows * front.firstBody);
        next += width;
        for (int row = front.firstRow; row < front.outerRow; ++row, next += Rows)
        {
            addRows<Rows>(next, to.x[side] + Rows * plan.rows[row]);
        }
        for (int row = front.outerRow; row < front.lastRow; ++row, next += Rows)
        {
            addRows<Rows>(next, to.outer[side] + Rows * plan.outerPlace[row]);
        }
    }
}

template<int Rows>
template<int Sides, class Scalar>
void FrontalCholesky<Rows>::forwardTogether(const Front<Rows>& front, const Scalar* columns,
                                            const std::array<double*, Sides>& part)
{
    constexpr int atOnce = columnsOfSolve<Sides>;
    const int width = front.width();
    const Index height = front.height();
    for (int panel = 0; panel < width; panel += panelOfSolve)
    {
        const int end = std::min(width, panel + panelOfSolve);
        for (int column = panel; column < end; column += columnsAtOnce)
        {
            // Row by row: whole registers would take from rows beyond the panel, too.
            const Scalar* block = columns + column * height + column;
            const std::array<double*, Sides> x = from<Sides>(part, column);
            solveOwnRows<columnsAtOnce, Sides>(block, height, x);
            for (int side = 0; side < Sides; ++side)
            {
                for (int row = columnsAtOnce; row < end - column; ++row)
                {
                    x[side][row] -= block[row] * x[side][0] + block[height + row] * x[side][1]
                                    + block[2 * height + row] * x[side][2];
                }
            }
        }
        const int below = static_cast<int>(height) - end;
        carryOut((below + rowsOfTask - 1) / rowsOfTask,
                 [&](int task, int)
                 {
                     const int first = end + task * rowsOfTask;
                     const int last = std::min(first + rowsOfTask, static_cast<int>(height));
                     int column = panel;
                     for (; column + atOnce <= end; column += atOnce)
                     {
                         takeFromRows<atOnce, Sides>(columns + column * height + column, height,
                                                     first - column, last - column,
                                                     from<Sides>(part, column));
                     }
                     for (; column < end; column += columnsAtOnce)
                     {
                         takeFromRows<columnsAtOnce, Sides>(columns + column * height + column, height,
                                                            first - column, last - column,
                                                            from<Sides>(part, column));
                     }
                 });
    }
}

template<int Rows>
template<int Sides, class Scalar>
void FrontalCholesky<Rows>::backward(const Front<Rows>& front, const std::array<double*, Sides>& x,
                                     const Scalar* factor, Worker& worker)
{
    constexpr int atOnce = columnsOfSolve<Sides>;
    const std::array<double*, Sides> part = partsOf<Sides>(worker);
    const int width = front.width();
    const int height = front.height();
    const Scalar* columns = factor + front.columns;
    for (int side = 0; side < Sides; ++side)
    {
        double* to = part[side];
        std::copy_n(x[side] + Rows * front.firstBody, width, to);
        to += width;
        for (int row = front.firstRow; row < front.lastRow; ++row, to += Rows)
        {
            std::copy_n(x[side] + Rows * plan.rows[row], Rows, to);
        }
        std::fill(to, part[side] + height + overhang, 0.0);
    }
    if (!front.isOfTask && long{width} * height >= sharedFrom)
    {
        backwardTogether<Sides>(front, columns, part);
    }
    else
    {
        int column = width;
        for (; column % atOnce != 0; column -= columnsAtOnce)
        {
            const int first = column - columnsAtOnce;
            substituteBackward<columnsAtOnce, Sides>(columns + first * Index{height} + first, height,
                                                     height - first, from<Sides>(part, first));
        }
        for (; column > 0; column -= atOnce)
        {
            const int first = column - atOnce;
            substituteBackward<atOnce, Sides>(columns + first * Index{height} + first, height, height - first,
                                              from<Sides>(part, first));
        }
    }
    for (int side = 0; side < Sides; ++side)
    {
        std::copy_n(part[side], width, x[side] + Rows * front.firstBody);
    }
}

template<int Rows>
template<int Sides, class Scalar>
void FrontalCholesky<Rows>::backwardTogether(const Front<Rows>& front, const Scalar* columns,
                                             const std::array<double*, Sides>& part)
{
    constexpr int columnsOfTask = 4 * columnsAtOnce;
    std::array<OfColumns<columnsAtOnce, Sides>, panelOfSolve / columnsAtOnce> products;
    const int width = front.width();
    const Index height = front.height();
    for (int panel = (width - 1) / panelOfSolve * panelOfSolve; panel >= 0; panel -= panelOfSolve)
    {
        const int end = std::min(width, panel + panelOfSolve);
        carryOut((end - panel + columnsOfTask - 1) / columnsOfTask,
                 [&](int task, int)
                 {
                     const int first = panel + task * columnsOfTask;
                     for (int column = first; column < std::min(first + columnsOfTask, end);
                          column += columnsAtOnce)
                     {
                         products[(column - panel) / columnsAtOnce] = productsWithRows<columnsAtOnce, Sides>(
                             columns + column * height + column, height, end - column,
                             static_cast<int>(height) - column, from<Sides>(part, column));
                     }
                 });
        for (int column = end - columnsAtOnce; column >= panel; column -= columnsAtOnce)
        {
            const Scalar* block = columns + column * height + column;
            const std::array<double*, Sides> x = from<Sides>(part, column);
            OfColumns<columnsAtOnce, Sides>& ofColumns = products[(column - panel) / columnsAtOnce];
            addProductsWithin<columnsAtOnce, Sides>(block, height, end - column, x, ofColumns);
            solveOwnRowsBackward<columnsAtOnce, Sides>(block, height, ofColumns, x);
        }
    }
}

/// The tasks of a batch add up by themselves what they do to rows above them, and it is added one task after
/// the other.
template<int Rows>
template<int Sides, class Scalar>
void FrontalCholesky<Rows>::forwardBatch(const FrontSchedule::Step& step, const std::array<double*, Sides>& x,
                                         const Scalar* factor)
{
    std::vector<std::size_t> begin{0};
    for (int task = step.firstSubtree; task < step.lastSubtree; ++task)
    {
        begin.push_back(begin.back() + plan.fronts[plan.schedule.subtrees[task].back()].below());
    }
    const std::size_t size = begin.back();
    if (outer.size() < Sides * size)
    {
        outer.resize(Sides * size);
    }
    const auto subtree = [&](int task, int worker)
    {
        RightSides<Sides> to{x, {}};
        for (int side = 0; side < Sides; ++side)
        {
            to.outer[side] = outer.data() + side * size + begin[task];
            std::fill(to.outer[side], outer.data() + side * size + begin[task + 1], 0.0);
        }
        for (const int front : plan.schedule.subtrees[step.firstSubtree + task])
        {
            forward<Sides>(plan.fronts[front], to, factor, workers[worker]);
        }
    };
    const int tasks = step.lastSubtree - step.firstSubtree;
    if (step.isShared)
    {
        carryOut(tasks, subtree);
    }
    else
    {
        for (int task = 0; task < tasks; ++task)
        {
            subtree(task, 0);
        }
    }
    for (int side = 0; side < Sides; ++side)
    {
        const double* from = outer.data() + side * size;
        for (int task = step.firstSubtree; task < step.lastSubtree; ++task)
        {
            const Front<Rows>& root = plan.fronts[plan.schedule.subtrees[task].back()];
            for (int row = root.firstRow; row < root.lastRow; ++row, from += Rows)
            {
                addRows<Rows>(from, x[side] + Rows * plan.rows[row]);
            }
        }
    }
}

template<int Rows>
template<int Sides, class Scalar>
void FrontalCholesky<Rows>::solveFor(const std::array<double*, Sides>& x, const Scalar* factor)
{
    provideWorkers();
    for (const FrontSchedule::Step& step : plan.schedule.steps)
    {
        if (step.isFront())
        {
            forward<Sides>(plan.fronts[step.front], {x, {}}, factor, workers[0]);
        }
        else
        {
            forwardBatch<Sides>(step, x, factor);
        }
    }
    for (auto step = plan.schedule.steps.rbegin(); step != plan.schedule.steps.rend(); ++step)
    {
        if (step->isFront())
        {
            backward<Sides>(plan.fronts[step->front], x, factor, workers[0]);
            continue;
        }
        const auto subtree = [&](int task, int worker)
        {
            const std::vector<int>& ofTask = plan.schedule.subtrees[step->firstSubtree + task];
            for (auto front = ofTask.rbegin(); front != ofTask.rend(); ++front)
            {
                backward<Sides>(plan.fronts[*front], x, factor, workers[worker]);
            }
        };
        const int tasks = step->lastSubtree - step->firstSubtree;
        if (step->isShared)
        {
            carryOut(tasks, subtree);
        }
        else
        {
            for (int task = tasks; task-- > 0;)
            {
                subtree(task, 0);
            }
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
        rounded.resize(lower.size());
        forParts(static_cast<long>(lower.size()), [&](long begin, long end)
                 { std::copy(lower.begin() + begin, lower.begin() + end, rounded.begin() + begin); });
    }
    solveFor<1>({x.data()}, rounded.data());
}

template void FrontalCholesky<3>::solve(Eigen::Ref<Eigen::VectorXd>);
template void FrontalCholesky<6>::solve(Eigen::Ref<Eigen::VectorXd>);
template void FrontalCholesky<3>::solve(Eigen::Ref<Eigen::VectorXd>, Eigen::Ref<Eigen::VectorXd>);
template void FrontalCholesky<6>::solve(Eigen::Ref<Eigen::VectorXd>, Eigen::Ref<Eigen::VectorXd>);
template void FrontalCholesky<3>::solveRoughly(Eigen::Ref<Eigen::VectorXd>);
template void FrontalCholesky<6>::solveRoughly(Eigen::Ref<Eigen::VectorXd>);

} // namespace drystone
