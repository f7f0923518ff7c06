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

/// Which fronts are factored together.
struct DividedTree
{
    std::vector<double> ofSubtree; ///< operations of each front and all below it
    std::vector<int> divided; ///< root of the divided subtree that each front belongs to; none: above them
    std::vector<int> task;    ///< root of the task that each front belongs to; none: above them
};

DividedTree divideTree(const std::vector<int>& parent, const std::vector<double>& operations)
{
    const int fronts = static_cast<int>(parent.size());
    DividedTree tree{operations, std::vector<int>(fronts, none), std::vector<int>(fronts, none)};
    auto& [ofSubtree, divided, task] = tree;
    for (int front = 0; front < fronts; ++front)
    {
        if (parent[front] != none)
        {
            ofSubtree[parent[front]] += ofSubtree[front];
        }
    }
    // From the roots down.
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
    return tree;
}

/// Subtrees in the order in which they are reached, cut into batches where a front above them is next.
struct Batches
{
    FrontSchedule schedule;
    int begun = 0;
    double operations = 0; ///< of the batch in hand

    void add(std::vector<int> subtree, double ofSubtree)
    {
        schedule.subtrees.push_back(std::move(subtree));
        operations += ofSubtree;
    }

    void close()
    {
        const int end = static_cast<int>(schedule.subtrees.size());
        if (end > begun)
        {
            schedule.steps.push_back({begun, end, none, operations > serialOperations});
            begun = end;
            operations = 0;
        }
    }
};

} // namespace

FrontSchedule scheduleFronts(const std::vector<int>& parent, const std::vector<double>& operations)
{
    const DividedTree tree = divideTree(parent, operations);
    const int fronts = static_cast<int>(parent.size());
    std::vector<std::vector<int>> ofTask(fronts);  // by its root
    std::vector<std::vector<int>> tasksOf(fronts); // by the root of the divided subtree
    for (int front = 0; front < fronts; ++front)
    {
        if (tree.task[front] != none)
        {
            ofTask[tree.task[front]].push_back(front);
            if (tree.task[front] == front)
            {
                tasksOf[tree.divided[front]].push_back(front);
            }
        }
    }

    Batches batches;
    for (int front = 0; front < fronts; ++front)
    {
        // What is divided goes with its first front; what is too small for that waits for others.
        if (tree.divided[front] != none)
        {
            std::vector<int>& tasks = tasksOf[tree.divided[front]];
            for (const int root : tasks)
            {
                batches.add(std::move(ofTask[root]), tree.ofSubtree[root]);
            }
            tasks.clear();
        }
        if (tree.task[front] == none)
        {
            batches.close();
            batches.schedule.steps.push_back({0, 0, front, operations[front] > serialFront});
        }
    }
    batches.close();
    return std::move(batches.schedule);
}

} // namespace drystone
