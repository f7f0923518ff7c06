// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Threads that take the next piece of work each.
#include "ensembles/Executor.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace drystone
{
namespace
{

/// What a report has thrown: it must leave neither a thread, nor threads that nobody has joined.
std::exception_ptr errorOf(const std::function<void(std::size_t)>& report, std::size_t number)
{
    try
    {
        if (report)
        {
            report(number);
        }
    }
    catch (...)
    {
        return std::current_exception();
    }
    return {};
}

} // namespace

void carryOutAll(std::size_t count, int threads, const std::function<void(std::size_t)>& work,
                 const std::function<void(std::size_t)>& report)
{
    std::vector<char> isDone(count, 0);
    std::vector<std::exception_ptr> errors(count);
    std::atomic<std::size_t> next = 0;
    std::size_t reported = 0;
    std::mutex reporting;
    const auto takeNext = [&]
    {
        for (std::size_t i = next++; i < count; i = next++)
        {
            std::exception_ptr error;
            try
            {
                work(i);
            }
            catch (...)
            {
                error = std::current_exception();
            }
            const std::lock_guard lock(reporting);
            errors[i] = error;
            isDone[i] = 1;
            for (; reported < count && isDone[reported] && !errors[reported]; ++reported)
            {
                errors[reported] = errorOf(report, reported);
                if (errors[reported])
                {
                    break;
                }
            }
            if (errors[i] || (reported < count && errors[reported]))
            {
                next = count; // what is before the fault has been begun: pieces are taken in order
            }
        }
    };
    std::vector<std::thread> others;
    const std::size_t wanted = static_cast<std::size_t>(std::max(threads, 1));
    for (std::size_t thread = 1; thread < std::min(count, wanted); ++thread)
    {
        others.emplace_back(takeNext);
    }
    takeNext();
    for (std::thread& thread : others)
    {
        thread.join();
    }
    for (const std::exception_ptr& error : errors)
    {
        if (error)
        {
            std::rethrow_exception(error);
        }
    }
}

} // namespace drystone
