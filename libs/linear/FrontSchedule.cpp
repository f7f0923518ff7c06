// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The schedule of the fronts.
#include "linear/FrontSchedule.h"

#include <algorithm>
#include <numeric>

namespace drystone
{
namespace
{

/// Multiplications, half a millisecond, up to which a tree is not divided, or a front: it is done before a
/// thread is awake.
constexpr double serialOperations = 1e7;
constexpr double serialFront = 2e6;

/// Multiplications of the subtrees that are divided into a batch. The updates of all tasks of a batch wait
/// until it is done: in a larger one they would take as much memory as the factor.
constexpr double batchOperations = 8e9;

/// The most that one of a batch's tasks takes of it. With less, more of the fronts are above the tasks.
constexpr double shareOfTask = 1.0 / 24;

constexpr int none = -1;

} // namespace

FrontSchedule scheduleFronts(const std::vector<int>& parent, const std::vector<double>& operations)
{
    const int fronts = static_cast<int>(parent.size());
    std::vector<double> ofSubtree = operations;
    for (int front = 0; front < fronts; ++front)
    {
        if (parent[front] != none)
        {
            ofSubtree[parent[front]] += ofSubtree[front];
        }
    }
    // From the roots down: the root of the divided subtree that each front belongs to, and of its task.
    std::vector<int> divided(fronts, none);
    std::vector<int> task(fronts, none);
    for (int front = fronts; front-- > 0;)
    {
        const int above = parent[front];
        if (above != none && divided[above] != none)
        {
            divided[front] = divided[above];
            task[front] = task[above];
        }
        else if (ofSubtree[front] <= batchOperations)
        {
            divided[front] = front;
        }
        if (divided[front] != none && task[front] == none)
        {
            const double whole = ofSubtree[divided[front]];
            if (divided[front] == front ? whole <= serialOperations : ofSubtree[front] <= shareOfTask * whole)
            {
                task[front] = front;
            }
        }
    }

    std::vector<std::vector<int>> ofTask(fronts);  // by its root
    std::vector<std::vector<int>> tasksOf(fronts); // by the root of the divided subtree
    for (int front = 0; front < fronts; ++front)
    {
        if (task[front] != none)
        {
            ofTask[task[front]].push_back(front);
            if (task[front] == front)
            {
                tasksOf[divided[front]].push_back(front);
            }
        }
    }

    FrontSchedule schedule;
    int begun = 0;
    double ofBatch = 0;
    const auto add = [&](int root)
    {
        for (const int each : tasksOf[root])
        {
            schedule.subtrees.push_back(std::move(ofTask[each]));
            ofBatch += ofSubtree[each];
        }
        tasksOf[root].clear();
    };
    const auto close = [&]
    {
        const int end = static_cast<int>(schedule.subtrees.size());
        if (end > begun)
        {
            schedule.steps.push_back({begun, end, none, ofBatch > serialOperations});
            begun = end;
            ofBatch = 0;
        }
    };
    for (int front = 0; front < fronts; ++front)
    {
        // What is divided goes with its first front; what is too small for that waits for others.
        if (divided[front] != none)
        {
            add(divided[front]);
        }
        if (task[front] == none)
        {
            close();
            schedule.steps.push_back({0, 0, front, operations[front] > serialFront});
        }
    }
    close();
    return schedule;
}

} // namespace drystone
