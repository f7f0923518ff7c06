// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Which of several programs this one is, by the environment of launchers.
#include "runControl/LaunchedAs.h"

#include <cstdlib>
#include <map>
#include <string>

#include <gtest/gtest.h>

using namespace drystone;

namespace
{

/// As in an environment that has these variables alone, of those of launchers.
LaunchedAs launchedIn(const std::map<std::string, std::string>& variables)
{
    for (const char* name : {"OMPI_COMM_WORLD_RANK", "OMPI_COMM_WORLD_SIZE", "PMI_RANK", "PMI_SIZE",
                             "SLURM_PROCID", "SLURM_NTASKS", "SLURM_ARRAY_TASK_ID", "SLURM_ARRAY_TASK_MIN",
                             "SLURM_ARRAY_TASK_MAX", "SLURM_ARRAY_TASK_STEP", "SLURM_ARRAY_TASK_COUNT"})
    {
        ::unsetenv(name);
    }
    for (const auto& [name, value] : variables)
    {
        ::setenv(name.c_str(), value.c_str(), 1);
    }
    return launchedAs();
}

LaunchedAs taskOf(int task, int first, int last, int count, int step)
{
    return launchedIn({{"SLURM_ARRAY_TASK_ID", std::to_string(task)},
                       {"SLURM_ARRAY_TASK_MIN", std::to_string(first)},
                       {"SLURM_ARRAY_TASK_MAX", std::to_string(last)},
                       {"SLURM_ARRAY_TASK_COUNT", std::to_string(count)},
                       {"SLURM_ARRAY_TASK_STEP", std::to_string(step)}});
}

TEST(LaunchedAs, OneOfOneWhereNoLauncherSaysOtherwise)
{
    const LaunchedAs launched = launchedIn({});
    EXPECT_EQ(launched.rank, 0);
    EXPECT_EQ(launched.size, 1);
    EXPECT_FALSE(launched.isArray);
    EXPECT_EQ(launched.beginning, 0);
}

TEST(LaunchedAs, ProgramsBeginOneAfterTheOther)
{
    const LaunchedAs launched = launchedIn({{"PMI_RANK", "3"}, {"PMI_SIZE", "4"}});
    EXPECT_EQ(launched.rank, 3);
    EXPECT_EQ(launched.size, 4);
    EXPECT_EQ(launched.beginning, 0.75);
}

TEST(LaunchedAs, TasksOfAnArrayHaveRanksOfTheirOwn)
{
    for (int task = 0; task < 4; ++task)
    {
        const LaunchedAs launched = taskOf(10 + 5 * task, 10, 25, 4, 5);
        EXPECT_TRUE(launched.isArray);
        EXPECT_FALSE(launched.isIrregular);
        EXPECT_EQ(launched.rank, task);
        EXPECT_EQ(launched.size, 4);
        EXPECT_EQ(launched.beginning, task / 4.0);
    }
}

// Tasks 3 and 7 of 1,3,7 both had the rank 2 of 3, and none had 1: where there are no locks a third of the
// samples was computed by none of them.
TEST(LaunchedAs, TasksOfAnArrayWithHolesAreSaidToBe)
{
    double before = -1;
    for (const int task : {1, 3, 7})
    {
        const LaunchedAs launched = taskOf(task, 1, 7, 3, 1);
        EXPECT_TRUE(launched.isIrregular);
        EXPECT_EQ(launched.size, 3);
        EXPECT_LT(launched.rank, 3);
        EXPECT_GT(launched.beginning, before);
        EXPECT_LT(launched.beginning, 1);
        before = launched.beginning;
    }
    EXPECT_FALSE(taskOf(3, 3, 3, 1, 1).isIrregular);
}

} // namespace
