// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
#include "core/Threads.h"

#include "core/Log.h"

#include <gmock/gmock.h>

#include <array>
#include <atomic>
#include <cstdlib>
#include <numeric>
#include <stdexcept>
#include <string>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>
#include <vector>

using testing::Each;

namespace drystone
{
namespace
{

/// With so many threads, and one again after each test.
class Threads : public testing::Test
{
protected:
    ~Threads() override { setThreads(1); }
};

TEST_F(Threads, CarryOutEachTaskOnce)
{
    for (const int count : {1, 2, 5})
    {
        setThreads(count);
        for (int call = 0; call < 200; ++call)
        {
            std::vector<int> done(static_cast<std::size_t>(call), 0);
            std::atomic<bool> isWorkerKnown = true;
            carryOut(call,
                     [&](int task, int worker)
                     {
                         ++done[static_cast<std::size_t>(task)];
                         isWorkerKnown = isWorkerKnown && worker >= 0 && worker < count;
                     });
            ASSERT_THAT(done, Each(1)) << count << ' ' << call;
            ASSERT_TRUE(isWorkerKnown);
        }
    }
}

// Tasks that take long, so that each thread has some.
TEST_F(Threads, ShareTasks)
{
    setThreads(3);
    std::atomic<int> waiting = 0;
    carryOut(3,
             [&](int, int)
             {
                 ++waiting;
                 while (waiting < 3) // none ends before each has begun
                 {
                     std::this_thread::yield();
                 }
             });
    EXPECT_EQ(waiting, 3);
}

TEST_F(Threads, AreNotTakenTwiceAtATime)
{
    setThreads(2);
    std::array<int, 6> sums{};
    carryOut(2,
             [&](int task, int) {
                 carryOut(3, [&](int inner, int) { sums[static_cast<std::size_t>(3 * task + inner)] += 1; });
             });
    EXPECT_THAT(sums, Each(1));

    // Callers that have nothing to do with each other.
    std::array<long, 2> totals{};
    const auto caller = [&](std::size_t which)
    {
        for (int call = 0; call < 500; ++call)
        {
            std::array<long, 4> parts{};
            carryOut(4, [&](int task, int) { parts[static_cast<std::size_t>(task)] = task + 1; });
            totals[which] += std::accumulate(parts.begin(), parts.end(), 0L);
        }
    };
    std::thread other([&] { caller(1); });
    caller(0);
    other.join();
    EXPECT_THAT(totals, Each(5000));
}

TEST_F(Threads, PassOnWhatTheFirstTaskThrows)
{
    for (const int count : {1, 2})
    {
        setThreads(count);
        try
        {
            carryOut(20,
                     [](int task, int)
                     {
                         if (task >= 7)
                         {
                             throw std::runtime_error("task " + std::to_string(task));
                         }
                     });
            ADD_FAILURE() << "nothing thrown";
        }
        catch (const std::runtime_error& error)
        {
            EXPECT_STREQ(error.what(), "task 7");
        }
        int sum = 0; // and the next call is not concerned
        carryOut(1, [&](int, int) { ++sum; });
        EXPECT_EQ(sum, 1);
    }
}

TEST_F(Threads, OfAForkedProcessAreItsOwn)
{
    setThreads(2);
    carryOut(4, [](int, int) {});
    const pid_t child = ::fork();
    ASSERT_GE(child, 0);
    if (child == 0)
    {
        std::array<int, 8> done{};
        carryOut(8, [&](int task, int) { done[static_cast<std::size_t>(task)] = 1; });
        ::_exit(std::accumulate(done.begin(), done.end(), 0));
    }
    int status = 0;
    ASSERT_EQ(::waitpid(child, &status, 0), child);
    EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 8) << status;
}

TEST_F(Threads, AreGrantedByTheEnvironmentOrTheMachine)
{
    ::unsetenv("OMP_NUM_THREADS");
    ::unsetenv("SLURM_CPUS_PER_TASK");
    const int ofMachine = threadCount();
    EXPECT_GE(ofMachine, 1);
    ::setenv("SLURM_CPUS_PER_TASK", "3", 1);
    EXPECT_EQ(threadCount(), 3);
    ::setenv("OMP_NUM_THREADS", "5", 1);
    EXPECT_EQ(threadCount(), 5);
    ::setenv("OMP_NUM_THREADS", "none", 1);
    EXPECT_EQ(threadCount(), 3);
    ::unsetenv("OMP_NUM_THREADS");
    ::unsetenv("SLURM_CPUS_PER_TASK");
}

TEST_F(Threads, HavePartsOfVectorsThatDoNotDependOnThem)
{
    EXPECT_EQ(partsOf(0), 1);
    EXPECT_EQ(partsOf(entriesOfTask), 1);
    EXPECT_EQ(partsOf(entriesOfTask + 1), 2);
    setThreads(2);
    std::vector<int> values(static_cast<std::size_t>(3 * entriesOfTask + 5), 0);
    forParts(static_cast<long>(values.size()),
             [&](long begin, long end)
             {
                 for (long entry = begin; entry < end; ++entry)
                 {
                     ++values[static_cast<std::size_t>(entry)];
                 }
             });
    EXPECT_THAT(values, Each(1));
}

} // namespace
} // namespace drystone
