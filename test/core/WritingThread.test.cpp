// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Order, faults and the end of work on a thread of its own.
#include "core/WritingThread.h"

#include "core/Error.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <vector>

namespace drystone
{

namespace
{

TEST(WritingThread, DoesAllInOrder)
{
    std::vector<int> done;
    WritingThread writing;
    for (int i = 0; i < 1000; ++i)
    {
        writing.start([&done, i] { done.push_back(i); });
    }
    writing.finish();
    ASSERT_EQ(done.size(), 1000U);
    for (int i = 0; i < 1000; ++i)
    {
        EXPECT_EQ(done[static_cast<std::size_t>(i)], i);
    }
}

TEST(WritingThread, GoesOnWhileTheCallerDoes)
{
    std::atomic<bool> isReleased = false;
    WritingThread writing;
    writing.start(
        [&]
        {
            while (!isReleased)
            {
                std::this_thread::yield();
            }
        });
    isReleased = true; // which the caller reaches only if it does not wait
    writing.finish();
}

TEST(WritingThread, AFaultIsThrownWhereTheNextWorkIsGiven)
{
    WritingThread writing;
    bool isDone = false;
    writing.start([] { throw FatalError("the disk is full"); });
    EXPECT_THROW(writing.start([&] { isDone = true; }), FatalError);
    EXPECT_NO_THROW(writing.finish()); // it is thrown once
    EXPECT_FALSE(isDone);
    writing.start([&] { isDone = true; });
    writing.finish();
    EXPECT_TRUE(isDone);
}

TEST(WritingThread, ItsEndWaitsForTheWorkAndWarnsOfAFault)
{
    bool isDone = false;
    {
        WritingThread writing;
        writing.start(
            [&]
            {
                std::this_thread::sleep_for(std::chrono::milliseconds(20));
                isDone = true;
            });
    }
    EXPECT_TRUE(isDone);
    testing::internal::CaptureStderr();
    {
        WritingThread writing;
        writing.start([] { throw FatalError("the disk is full"); });
    }
    EXPECT_NE(testing::internal::GetCapturedStderr().find("the disk is full"), std::string::npos);
}

TEST(WritingThread, WithoutWorkThereIsNone)
{
    WritingThread writing;
    EXPECT_NO_THROW(writing.finish());
}

} // namespace

} // namespace drystone
