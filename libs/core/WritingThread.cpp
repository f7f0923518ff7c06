// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Hands work over to a thread and its faults back.
#include "core/WritingThread.h"

#include "core/Error.h"

#include <utility>

namespace drystone
{

WritingThread::~WritingThread()
{
    if (!thread.joinable())
    {
        return;
    }
    try
    {
        finish();
    }
    catch (const std::exception& error)
    {
        printWarning(error.what());
    }
    {
        const std::lock_guard lock(exchange);
        isEnding = true;
    }
    changed.notify_all();
    thread.join();
}

void WritingThread::start(std::function<void()> nextWork)
{
    finish();
    if (!thread.joinable())
    {
        thread = std::thread([this] { run(); });
    }
    {
        const std::lock_guard lock(exchange);
        work = std::move(nextWork);
    }
    changed.notify_all();
}

void WritingThread::finish()
{
    std::unique_lock lock(exchange);
    changed.wait(lock, [this] { return !work; });
    if (failure)
    {
        std::rethrow_exception(std::exchange(failure, nullptr));
    }
}

void WritingThread::run()
{
    std::unique_lock lock(exchange);
    while (true)
    {
        changed.wait(lock, [this] { return work || isEnding; });
        if (!work)
        {
            return;
        }
        lock.unlock();
        std::exception_ptr thrown;
        try
        {
            work();
        }
        catch (...)
        {
            thrown = std::current_exception();
        }
        lock.lock();
        failure = thrown;
        work = nullptr;
        changed.notify_all();
    }
}

} // namespace drystone
