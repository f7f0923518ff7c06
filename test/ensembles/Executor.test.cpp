// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Pieces of work on threads: each once, reported in order, and faults of either reach the caller.
#include "ensembles/Executor.h"

#include "core/Error.h"

#include <atomic>
#include <chrono>
#include <numeric>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

using namespace drystone;

namespace
{

class Executor : public testing::TestWithParam<int>
{
};

TEST_P(Executor, EachPieceIsCarriedOutOnceAndReportedInOrder)
{
    std::vector<int> times(40, 0);
    std::vector<std::size_t> reported;
    carryOutAll(
        times.size(), GetParam(), [&](std::size_t i) { ++times[i]; },
        [&](std::size_t i) { reported.push_back(i); });
    std::vector<std::size_t> inOrder(times.size());
    std::iota(inOrder.begin(), inOrder.end(), 0u);
    EXPECT_EQ(reported, inOrder);
    EXPECT_EQ(times, std::vector<int>(times.size(), 1));
}

TEST_P(Executor, AReportThatFailsEndsTheWorkWithItsError)
{
    std::vector<std::size_t> reported;
    const auto report = [&](std::size_t i)
    {
        if (i == 3)
        {
            throw FatalError("Cannot write history.dat.");
        }
        reported.push_back(i);
    };
    EXPECT_THROW(carryOutAll(
                     40, GetParam(), [](std::size_t) {}, report),
                 FatalError);
    EXPECT_EQ(reported, (std::vector<std::size_t>{0, 1, 2}));
}

TEST_P(Executor, WorkThatFailsLetsNoMoreBegin)
{
    std::atomic<int> begun = 0;
    std::vector<std::size_t> reported;
    const auto work = [&](std::size_t i)
    {
        ++begun;
        if (i == 0)
        {
            throw FatalError("The first.");
        }
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    };
    EXPECT_THROW(carryOutAll(10000, GetParam(), work, [&](std::size_t i) { reported.push_back(i); }),
                 FatalError);
    EXPECT_LT(begun, 10000);
    EXPECT_TRUE(reported.empty());
}

INSTANTIATE_TEST_SUITE_P(Threads, Executor, testing::Values(1, 2, 4));

} // namespace
