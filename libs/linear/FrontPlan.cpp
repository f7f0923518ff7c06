// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// From supernodes to fronts, their rows in their parents, a schedule for threads, and places for updates.
#include "linear/FrontPlan.h"

#include "linear/FrontKernel.h"
#include "linear/Supernodes.h"
#include "linear/UpdatePool.h"

#include <algorithm>

namespace drystone
{

template<int Rows>
double Front<Rows>::operations() const
{
    const double columnsOfFront = width();
    const double rowsBelow = below();
    return columnsOfFront
           * (columnsOfFront * columnsOfFront / 6 + rowsBelow * columnsOfFront / 2
              + rowsBelow * rowsBelow / 2);
}

namespace
{

template<int Rows>
void findFronts(FrontPlan<Rows>& plan, const BlockPattern& matrix, const BlockPattern& factor)
{
    std::vector<int> frontOf(matrix.columns());
    std::size_t size = 0;
    for (const Supernode& supernode : supernodes(factor, Rows))
    {
        Front<Rows> front;
        front.firstBody = supernode.firstBody;
        front.lastBody = supernode.lastBody;
        // What the last column has below the diagonal, all columns of the front have or get.
        front.firstRow = static_cast<int>(plan.rows.size());
        plan.rows.insert(plan.rows.end(), factor.row.begin() + factor.columnStart[front.lastBody - 1] + 1,
                         factor.row.begin() + factor.columnStart[front.lastBody]);
        front.lastRow = front.outerRow = static_cast<int>(plan.rows.size());
        front.columns = size;
        // Tiles reach beyond its end, where another thread has its front.
        size += static_cast<std::size_t>(front.width()) * front.height() + frontKernel::lanes;
        plan.highest = std::max(plan.highest, front.height());
        std::fill(frontOf.begin() + front.firstBody, frontOf.begin() + front.lastBody,
                  static_cast<int>(plan.fronts.size()));
        plan.fronts.push_back(std::move(front));
    }
    for (std::size_t index = 0; index < plan.fronts.size(); ++index)
    {
        if (const Front<Rows>& front = plan.fronts[index]; front.lastRow > front.firstRow)
        {
            plan.fronts[frontOf[plan.rows[front.firstRow]]].children.push_back(static_cast<int>(index));
        }
    }
    plan.factorSize = size;
}

/// Where rows of the matrix and of the children are in each front.
template<int Rows>
void placeRows(FrontPlan<Rows>& plan, const BlockPattern& matrix)
{
    std::vector<int> place(matrix.columns());
    plan.inParent.resize(plan.rows.size());
    plan.inFront.resize(matrix.row.size());
    for (const Front<Rows>& front : plan.fronts)
    {
        for (int body = front.firstBody; body < front.lastBody; ++body)
        {
            place[body] = body - front.firstBody;
        }
        for (int row = front.firstRow; row < front.lastRow; ++row)
        {
            place[plan.rows[row]] = front.lastBody - front.firstBody + row - front.firstRow;
        }
        for (int entry = matrix.columnStart[front.firstBody]; entry < matrix.columnStart[front.lastBody];
             ++entry)
        {
            plan.inFront[entry] = place[matrix.row[entry]];
        }
        for (const int child : front.children)
        {
            for (int row = plan.fronts[child].firstRow; row < plan.fronts[child].lastRow; ++row)
            {
                plan.inParent[row] = place[plan.rows[row]];
            }
        }
    }
}

template<int Rows>
void makeSchedule(FrontPlan<Rows>& plan)
{
    std::vector<int> parent(plan.fronts.size(), -1);
    std::vector<double> operations;
    operations.reserve(plan.fronts.size());
    for (std::size_t index = 0; index < plan.fronts.size(); ++index)
    {
        operations.push_back(plan.fronts[index].operations());
        for (const int child : plan.fronts[index].children)
        {
            parent[child] = static_cast<int>(index);
        }
    }
    plan.schedule = scheduleFronts(parent, operations);

    plan.outerPlace.resize(plan.rows.size());
    std::vector<int> place(plan.fronts.empty() ? 0 : plan.fronts.back().lastBody, -1);
    for (const std::vector<int>& subtree : plan.schedule.subtrees)
    {
        const Front<Rows>& root = plan.fronts[subtree.back()];
        for (int row = root.firstRow; row < root.lastRow; ++row)
        {
            place[plan.rows[row]] = row - root.firstRow;
        }
        for (const int index : subtree)
        {
            // The rows of a front are on the way to the root of the tree: once outside, they stay there.
            Front<Rows>& front = plan.fronts[index];
            front.isOfTask = true;
            front.outerRow = front.lastRow;
            while (front.outerRow > front.firstRow && place[plan.rows[front.outerRow - 1]] >= 0)
            {
                --front.outerRow;
                plan.outerPlace[front.outerRow] = place[plan.rows[front.outerRow]];
            }
        }
        for (int row = root.firstRow; row < root.lastRow; ++row)
        {
            place[plan.rows[row]] = -1;
        }
    }
}

/// Each U gets its place until the parent has taken it: whatever the order, few wait at a time.
template<int Rows>
void placeUpdates(FrontPlan<Rows>& plan)
{
    const auto sizeOf = [](const Front<Rows>& front)
    { return static_cast<std::size_t>(front.updateStride()) * front.below() + frontKernel::overhang; };
    UpdatePool waiting;
    const auto take = [&](Front<Rows>& front, UpdatePool& pool)
    {
        if (front.below() > 0)
        {
            front.update = pool.take(sizeOf(front));
        }
    };
    const auto giveBack = [&](const Front<Rows>& front, UpdatePool& pool)
    {
        for (const int child : front.children)
        {
            pool.giveBack(plan.fronts[child].update, sizeOf(plan.fronts[child]));
        }
    };
    for (const FrontSchedule::Step& step : plan.schedule.steps)
    {
        for (int task = step.firstSubtree; task < step.lastSubtree; ++task)
        {
            const std::vector<int>& subtree = plan.schedule.subtrees[task];
            UpdatePool own;
            for (const int index : subtree)
            {
                take(plan.fronts[index], index == subtree.back() ? waiting : own);
                giveBack(plan.fronts[index], own);
            }
            plan.updatesOfTask = std::max(plan.updatesOfTask, own.size());
            plan.fronts[subtree.back()].isOfTask = false;
        }
        if (step.isFront())
        {
            take(plan.fronts[step.front], waiting);
            giveBack(plan.fronts[step.front], waiting);
        }
    }
    plan.updatesWaiting = waiting.size();
}

} // namespace

template<int Rows>
FrontPlan<Rows> planFronts(const BlockPattern& matrix, const BlockPattern& factor)
{
    FrontPlan<Rows> plan;
    findFronts(plan, matrix, factor);
    placeRows(plan, matrix);
    makeSchedule(plan);
    placeUpdates(plan);
    return plan;
}

template struct Front<3>;
template FrontPlan<3> planFronts(const BlockPattern& matrix, const BlockPattern& factor);
template struct Front<6>;
template FrontPlan<6> planFronts(const BlockPattern& matrix, const BlockPattern& factor);

} // namespace drystone
