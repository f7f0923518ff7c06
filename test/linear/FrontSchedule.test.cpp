// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
#include "linear/FrontSchedule.h"

#include <gtest/gtest.h>

#include <numeric>

namespace drystone
{
namespace
{

/// A binary tree of so many levels in postorder, each front of as many operations.
std::vector<int> binaryTree(int levels)
{
    std::vector<int> parent;
    const auto add = [&](const auto& self, int level) -> int
    {
        const int one = level > 1 ? self(self, level - 1) : -1;
        const int other = level > 1 ? self(self, level - 1) : -1;
        const int own = static_cast<int>(parent.size());
        parent.push_back(-1);
        if (level > 1)
        {
            parent[static_cast<std::size_t>(one)] = parent[static_cast<std::size_t>(other)] = own;
        }
        return own;
    };
    add(add, levels);
    return parent;
}

/// Fronts in the order in which they are done; a child must not follow its parent.
std::vector<int> orderOf(const FrontSchedule& schedule)
{
    std::vector<int> order;
    for (const FrontSchedule::Step& step : schedule.steps)
    {
        for (int task = step.firstSubtree; task < step.lastSubtree; ++task)
        {
            const std::vector<int>& subtree = schedule.subtrees[static_cast<std::size_t>(task)];
            order.insert(order.end(), subtree.begin(), subtree.end());
        }
        if (step.isFront())
        {
            order.push_back(step.front);
        }
    }
    return order;
}

void expectSound(const FrontSchedule& schedule, const std::vector<int>& parent)
{
    std::vector<int> place(parent.size(), -1);
    const std::vector<int> order = orderOf(schedule);
    ASSERT_EQ(order.size(), parent.size());
    for (std::size_t at = 0; at < order.size(); ++at)
    {
        int& ofFront = place[static_cast<std::size_t>(order[at])];
        EXPECT_EQ(ofFront, -1) << "twice";
        ofFront = static_cast<int>(at);
    }
    std::vector<int> task(parent.size(), -1);
    for (std::size_t index = 0; index < schedule.subtrees.size(); ++index)
    {
        for (const int front : schedule.subtrees[index])
        {
            task[static_cast<std::size_t>(front)] = static_cast<int>(index);
        }
    }
    for (std::size_t front = 0; front < parent.size(); ++front)
    {
        if (parent[front] >= 0)
        {
            const auto above = static_cast<std::size_t>(parent[front]);
            EXPECT_LT(place[front], place[above]);
            // What tasks leave to others comes from their last front alone.
            EXPECT_TRUE(task[front] == task[above] || task[above] == -1) << front;
            EXPECT_TRUE(
                task[front] == task[above]
                || schedule.subtrees[static_cast<std::size_t>(task[front] < 0 ? 0 : task[front])].back()
                       == static_cast<int>(front)
                || task[front] == -1)
                << front;
        }
    }
}

TEST(FrontSchedule, LeavesSmallTreesWhole)
{
    const std::vector<int> parent = binaryTree(5);
    const FrontSchedule schedule = scheduleFronts(parent, std::vector<double>(parent.size(), 100.0));
    expectSound(schedule, parent);
    ASSERT_EQ(schedule.steps.size(), 1u);
    EXPECT_FALSE(schedule.steps[0].isShared);
    ASSERT_EQ(schedule.subtrees.size(), 1u);
    std::vector<int> all(parent.size());
    std::iota(all.begin(), all.end(), 0);
    EXPECT_EQ(schedule.subtrees[0], all);
}

TEST(FrontSchedule, DividesALargeTreeIntoTasksAndTheFrontsAboveThem)
{
    const std::vector<int> parent = binaryTree(10);
    const FrontSchedule schedule = scheduleFronts(parent, std::vector<double>(parent.size(), 1e5));
    expectSound(schedule, parent);
    EXPECT_EQ(schedule.subtrees.size(), 32u);
    EXPECT_EQ(schedule.steps.size(), 1u + 31u);
    EXPECT_TRUE(schedule.steps[0].isShared);
    EXPECT_FALSE(schedule.steps[1].isShared); // of 1e5 operations
}

// The updates of all tasks of a batch wait for its end.
TEST(FrontSchedule, DividesVeryLargeTreesIntoSeveralBatches)
{
    const std::vector<int> parent = binaryTree(10);
    const FrontSchedule schedule = scheduleFronts(parent, std::vector<double>(parent.size(), 5e7));
    expectSound(schedule, parent);
    int batches = 0;
    for (const FrontSchedule::Step& step : schedule.steps)
    {
        batches += !step.isFront();
        EXPECT_TRUE(step.isShared);
    }
    EXPECT_EQ(batches, 8);
}

TEST(FrontSchedule, TakesTreesInAnyOrderAndSeveralOfThem)
{
    // 0 and 1 below 4, 2 and 3 below 5, 4 below 6; 5 and 6 are roots.
    const std::vector<int> parent{4, 4, 5, 5, 6, -1, -1};
    for (const double operations : {1.0, 3e6, 1e10})
    {
        const FrontSchedule schedule = scheduleFronts(parent, std::vector<double>(parent.size(), operations));
        expectSound(schedule, parent);
    }
    EXPECT_TRUE(scheduleFronts({}, {}).steps.empty());
}

} // namespace
} // namespace drystone
