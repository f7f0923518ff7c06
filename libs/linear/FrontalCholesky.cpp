// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The numeric factorisation: panels and updates of each front, by one thread or shared out among several.
#include "linear/FrontalCholesky.h"

#include "core/Threads.h"
#include "linear/DenseKernel.h"
#include "linear/FrontKernel.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>

namespace drystone
{
namespace
{

using namespace frontKernel;

/// Columns eliminated together by the kernel below. In wider fronts the dense kernel does what is between
/// such panels.
constexpr int panelWidth = 48;

/// Columns of a front from which on the packing of the dense kernel pays for its U.
constexpr int denseFrom = 12;

/// Rows of a front that are one task, in whole registers, and bodies whose columns are one.
constexpr int rowsOfTask = 256;
constexpr int bodiesOfTask = 32;

/// Rows of a slice of the dense kernel: its packing does not pay for less.
constexpr int rowsOfSlice = 192;

} // namespace

template<int Rows>
FrontalCholesky<Rows>::FrontalCholesky(const BlockPattern& matrix, const BlockPattern& factor)
    : plan(planFronts<Rows>(matrix, factor))
{
    static_assert(Rows % columnsAtOnce == 0);
    lower.assign(plan.factorSize + overhang, 0);
    updates.assign(plan.updatesWaiting, 0);
}

template<int Rows>
void FrontalCholesky<Rows>::provideWorkers()
{
    workers.resize(std::max(workers.size(), static_cast<std::size_t>(threads())));
}

template<int Rows>
double* FrontalCholesky<Rows>::updateOf(const Front<Rows>& front, Worker& worker)
{
    return (front.isOfTask ? worker.updates : updates).data() + front.update;
}

/// The columns of S that are these bodies' of the front.
template<int Rows>
void FrontalCholesky<Rows>::assembleColumns(const Front<Rows>& front, Bodies bodies,
                                            const BlockPattern& matrix, const Block* values)
{
    double* columns = lower.data() + front.columns;
    const Index stride = front.height();
    std::fill(columns + Rows * bodies.begin * stride, columns + Rows * bodies.end * stride, 0.0);
    for (int body = bodies.begin; body < bodies.end; ++body)
    {
        const int column = front.firstBody + body;
        for (int entry = matrix.columnStart[column]; entry < matrix.columnStart[column + 1]; ++entry)
        {
            double* to = columns + Rows * body * stride + Rows * plan.inFront[entry];
            Eigen::Map<Block, 0, Eigen::OuterStride<>>(to, Eigen::OuterStride<>(stride)) = values[entry];
        }
    }
}

/// Adds those parts of the children's U that belong into the columns of these bodies of the front, which are
/// all its own, or all below them.
template<int Rows>
void FrontalCholesky<Rows>::addUpdates(const Front<Rows>& front, Bodies into, Worker& worker)
{
    const int ownBodies = front.lastBody - front.firstBody;
    const bool isIntoColumns = into.begin < ownBodies;
    const Index stride = isIntoColumns ? front.height() : front.updateStride();
    // Where the first row and column of the front are, or would be if U had them too.
    double* values = isIntoColumns ? lower.data() + front.columns : updateOf(front, worker);
    const Index corner = isIntoColumns ? 0 : -(stride + 1) * Rows * ownBodies;
    for (const int index : front.children)
    {
        const Front<Rows>& child = plan.fronts[index];
        const int bodies = child.lastRow - child.firstRow;
        const int* place = plan.inParent.data() + child.firstRow;
        // Places ascend.
        const int begin = static_cast<int>(std::lower_bound(place, place + bodies, into.begin) - place);
        const int end = static_cast<int>(std::lower_bound(place + begin, place + bodies, into.end) - place);
        if (begin == end)
        {
            continue;
        }
        const double* update = updateOf(child, worker);
        std::vector<Run>& runs = worker.runs;
        runs.clear();
        for (int body = begin; body < bodies; ++body)
        {
            if (body == begin || place[body] != place[body - 1] + 1)
            {
                runs.push_back({body, place[body] - body});
            }
            runs.back().end = body + 1;
        }
        std::size_t first = 0;
        for (int body = begin; body < end; ++body)
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
void FrontalCholesky<Rows>::updateDensely(const DenseUpdate& task, Worker& worker)
{
    denseKernel().update(task, alignedWork(worker.packed));
}

/// L11 and L21 from the columns of the front, panel by panel: the columns of a panel are freed of those
/// before it by the dense kernel, then three at a time by the kernel. Diagonal blocks of three rows are kept
/// inverted.
template<int Rows>
bool FrontalCholesky<Rows>::eliminateColumns(const Front<Rows>& front, Worker& worker)
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
            updateDensely({.rows = height - panel,
                           .columns = end - panel,
                           .depth = panel,
                           .a = columns + panel,
                           .aStride = height,
                           .c = corner,
                           .cStride = height},
                          worker);
        }
        if (!eliminatePanel(corner, height, end - panel, height - panel))
        {
            return false;
        }
    }
    clearAboveDiagonal(columns, height, width);
    return true;
}

/// Likewise by several threads. The block on the diagonal of a panel is eliminated first, in a place of its
/// own: tiles reach beyond the end of its columns, where there are rows here.
template<int Rows>
bool FrontalCholesky<Rows>::eliminateTogether(const Front<Rows>& front)
{
    constexpr int stride = (panelWidth + lanes) / lanes * lanes;
    std::array<double, panelWidth* stride + overhang> own = {};
    double* columns = lower.data() + front.columns;
    const int width = front.width();
    const Index height = front.height();
    for (int panel = 0; panel < width; panel += panelWidth)
    {
        const int ofPanel = std::min(width - panel, panelWidth);
        double* corner = columns + panel * height + panel;
        const auto update = [&](int from, int to, Worker& worker)
        {
            if (panel > 0)
            {
                updateDensely({.rows = to,
                               .columns = ofPanel,
                               .firstRow = from,
                               .depth = panel,
                               .a = columns + panel,
                               .aStride = height,
                               .c = corner,
                               .cStride = height},
                              worker);
            }
        };
        update(0, ofPanel, workers[0]);
        for (int column = 0; column < ofPanel; ++column)
        {
            std::copy_n(corner + column * height + column, ofPanel - column,
                        own.data() + column * stride + column);
        }
        if (!eliminatePanel(own.data(), stride, ofPanel, ofPanel))
        {
            return false;
        }
        for (int column = 0; column < ofPanel; ++column)
        {
            // With the whole of a diagonal block of three.
            const int first = column / columnsAtOnce * columnsAtOnce;
            std::copy_n(own.data() + column * stride + first, ofPanel - first,
                        corner + column * height + first);
        }
        const int rowsBelow = static_cast<int>(height) - panel - ofPanel;
        carryOut((rowsBelow + rowsOfTask - 1) / rowsOfTask,
                 [&](int task, int worker)
                 {
                     const int from = ofPanel + task * rowsOfTask;
                     const int to = std::min(from + rowsOfTask, ofPanel + rowsBelow);
                     update(from, to, workers[worker]);
                     eliminateRows(corner, height, ofPanel, from, to);
                 });
    }
    clearAboveDiagonal(columns, height, width);
    return true;
}

/// U = -L21 L21', its lower triangle.
template<int Rows>
void FrontalCholesky<Rows>::updateBelow(const Front<Rows>& front, Worker& worker)
{
    const int below = front.below();
    if (below == 0)
    {
        return;
    }
    const int height = front.height();
    const int stride = front.updateStride();
    const double* lower21 = lower.data() + front.columns + front.width();
    double* update = updateOf(front, worker);
    if (front.width() > denseFrom)
    {
        updateDensely({.target = DenseUpdate::Target::set,
                       .rows = below,
                       .columns = below,
                       .depth = front.width(),
                       .a = lower21,
                       .aStride = height,
                       .c = update,
                       .cStride = stride},
                      worker);
        return;
    }
    for (int column = 0; column < below; column += columnsAtOnce)
    {
        multiply<Target::set>(lower21 + column, height, lower21 + column, height, front.width(),
                              update + column * Index{stride} + column, stride, below - column);
    }
}

/// Likewise by several threads, each strip of rows with as many numbers of the triangle as another. Each
/// number comes out the same whichever strip it is in, so that there may be one where there is one thread:
/// each has the rows of B packed.
template<int Rows>
void FrontalCholesky<Rows>::updateTogether(const Front<Rows>& front)
{
    const int below = front.below();
    const int strips = threads() == 1 ? 1 : std::clamp(below / rowsOfSlice, 1, 3 * threads());
    const auto end = [&](int strip)
    { return static_cast<int>(std::lround(below * std::sqrt(static_cast<double>(strip) / strips))); };
    carryOut(strips,
             [&](int strip, int worker)
             {
                 updateDensely({.target = DenseUpdate::Target::set,
                                .rows = end(strip + 1),
                                .columns = end(strip + 1),
                                .firstRow = end(strip),
                                .depth = front.width(),
                                .a = lower.data() + front.columns + front.width(),
                                .aStride = front.height(),
                                .c = updates.data() + front.update,
                                .cStride = front.updateStride()},
                               workers[worker]);
             });
}

template<int Rows>
bool FrontalCholesky<Rows>::factoriseFront(const Front<Rows>& front, const BlockPattern& matrix,
                                           const Block* values, Worker& worker)
{
    const int own = front.lastBody - front.firstBody;
    assembleColumns(front, {0, own}, matrix, values);
    addUpdates(front, {0, own}, worker);
    if (!eliminateColumns(front, worker))
    {
        return false;
    }
    updateBelow(front, worker);
    addUpdates(front, {own, own + front.lastRow - front.firstRow}, worker);
    return true;
}

/// A large front above the tasks, likewise by several threads.
template<int Rows>
bool FrontalCholesky<Rows>::factoriseTogether(const Front<Rows>& front, const BlockPattern& matrix,
                                              const Block* values)
{
    const auto forBodies = [](int begin, int end, const auto& function)
    {
        carryOut((end - begin + bodiesOfTask - 1) / bodiesOfTask,
                 [&](int task, int worker)
                 {
                     const int first = begin + task * bodiesOfTask;
                     function(Bodies{first, std::min(first + bodiesOfTask, end)}, worker);
                 });
    };
    const int own = front.lastBody - front.firstBody;
    forBodies(0, own,
              [&](Bodies bodies, int worker)
              {
                  assembleColumns(front, bodies, matrix, values);
                  addUpdates(front, bodies, workers[worker]);
              });
    if (!eliminateTogether(front))
    {
        return false;
    }
    updateTogether(front);
    forBodies(own, own + front.lastRow - front.firstRow,
              [&](Bodies bodies, int worker) { addUpdates(front, bodies, workers[worker]); });
    return true;
}

template<int Rows>
bool FrontalCholesky<Rows>::factorise(const BlockPattern& matrix, const Block* values)
{
    rounded.clear();
    provideWorkers();
    std::atomic<bool> isDefinite = true;
    const auto subtree = [&](int task, int number)
    {
        Worker& worker = workers[number];
        worker.updates.resize(std::max(worker.updates.size(), plan.updatesOfTask));
        for (const int front : plan.schedule.subtrees[task])
        {
            if (!isDefinite || !factoriseFront(plan.fronts[front], matrix, values, worker))
            {
                isDefinite = false;
                return;
            }
        }
    };
    for (const FrontSchedule::Step& step : plan.schedule.steps)
    {
        const int tasks = step.lastSubtree - step.firstSubtree;
        if (step.isFront())
        {
            const Front<Rows>& front = plan.fronts[step.front];
            if (!(step.isShared ? factoriseTogether(front, matrix, values)
                                : factoriseFront(front, matrix, values, workers[0])))
            {
                return false;
            }
        }
        else if (step.isShared)
        {
            carryOut(tasks, [&](int task, int worker) { subtree(step.firstSubtree + task, worker); });
        }
        else
        {
            for (int task = 0; task < tasks; ++task)
            {
                subtree(step.firstSubtree + task, 0);
            }
        }
        if (!isDefinite)
        {
            return false;
        }
    }
    return true;
}

template class FrontalCholesky<3>;
template class FrontalCholesky<6>;

} // namespace drystone
