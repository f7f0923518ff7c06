// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The threads, and how tasks are handed out to them.
#include "core/Threads.h"

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <exception>
#include <memory>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

#include <unistd.h>

namespace drystone
{
namespace
{

void pause()
{
#if defined(__x86_64__)
    __builtin_ia32_pause();
#endif
}

/// A thread looks out so often, for some tens of microseconds, before it sleeps: to wake it takes longer than
/// most tasks do, and a solver has the next ones soon.
constexpr int patience = 2000;

thread_local bool isInTask = false;

/// Threads that sleep until there are tasks. Those of one call are handed out by one number, `offer`: which
/// call it is, and how many tasks of it are left. A thread that comes late, or not at all because the system
/// runs another program, takes none, and nobody waits for it.
class Pool
{
public:
    explicit Pool(int others)
    {
        for (int worker = 1; worker <= others; ++worker)
        {
            workers.emplace_back([this, worker](const std::stop_token& end) { work(worker, end); });
        }
    }

    ~Pool()
    {
        for (std::jthread& worker : workers)
        {
            worker.request_stop();
        }
        offer = nextCall(); // without tasks
        wakeSleeping();
    }

    void carryOut(int count, TaskFunction function)
    {
        // Nobody takes tasks while none are left: only then what they are may change.
        call = function.call;
        argument = function.function;
        tasks = count;
        missing = count;
        failedTask = count;
        failure = nullptr;
        offer = nextCall() + static_cast<std::uint64_t>(count);
        wakeSleeping();
        takeTasks(0);
        for (int left = missing; left > 0;)
        {
            left = waitForChange(missing, left);
        }
        if (failure)
        {
            std::rethrow_exception(std::exchange(failure, nullptr));
        }
    }

private:
    static constexpr int bits = 32;
    static std::uint64_t leftOf(std::uint64_t value) { return value & ((std::uint64_t{1} << bits) - 1); }
    std::uint64_t nextCall() const { return ((offer >> bits) + 1) << bits; }

    void work(int worker, const std::stop_token& end)
    {
        isInTask = true;
        for (std::uint64_t seen = 0; !end.stop_requested();)
        {
            waitForChange(offer, seen);
            seen = takeTasks(worker);
        }
    }

    /// Takes tasks as long as there are any. \return the offer in which there were none
    std::uint64_t takeTasks(int worker)
    {
        std::uint64_t now = offer;
        while (leftOf(now) > 0)
        {
            // Read before the task is taken: where it can be, they are those of its call.
            const TaskFunction function{call, argument};
            const int task = tasks - static_cast<int>(leftOf(now));
            if (!offer.compare_exchange_weak(now, now - 1))
            {
                continue;
            }
            carryOutOne(function, task, worker);
            if (missing.fetch_sub(1) == 1)
            {
                wakeSleeping();
            }
            now = offer;
        }
        return now;
    }

    void carryOutOne(const TaskFunction& function, int task, int worker)
    {
        try
        {
            function.call(function.function, task, worker);
        }
        catch (...)
        {
            const std::lock_guard lock(failing);
            if (task < failedTask)
            {
                failedTask = task;
                failure = std::current_exception();
            }
        }
    }

    /// Waits until the value is no longer what it was. \return what it is then
    template<class Value>
    Value waitForChange(const std::atomic<Value>& value, Value was)
    {
        for (int look = 0; look < patience; ++look)
        {
            if (value != was)
            {
                return value;
            }
            pause();
        }
        std::unique_lock lock(sleeping);
        ++sleepers;
        changed.wait(lock, [&] { return value != was; });
        --sleepers;
        return value;
    }

    /// After a change of what threads may wait for.
    void wakeSleeping()
    {
        if (sleepers > 0)
        {
            // One that has counted itself but does not sleep yet has the lock until it does.
            {
                const std::lock_guard lock(sleeping);
            }
            changed.notify_all();
        }
    }

    std::atomic<std::uint64_t> offer = 0;
    std::atomic<decltype(TaskFunction::call)> call = nullptr;
    std::atomic<const void*> argument = nullptr;
    std::atomic<int> tasks = 0;
    std::atomic<int> missing = 0; ///< tasks that are not done
    std::mutex failing;
    int failedTask = 0;
    std::exception_ptr failure;
    std::mutex sleeping;
    std::condition_variable changed;
    std::atomic<int> sleepers = 0;
    std::vector<std::jthread> workers; ///< last: they end before what they use
};

std::atomic<int> wanted = 1;
std::mutex inUse; ///< held by the thread that has the pool at work

/// The pool, and the process that it belongs to: a process that was forked has none of its threads.
struct Owned
{
    std::unique_ptr<Pool> pool;
    int threads = 1;
    pid_t process = 0;
};
Owned& owned()
{
    // Never destroyed: at the end of the program its threads wait for tasks, and a forked process has none to
    // wait for.
    static Owned& kept = *new Owned;
    return kept;
}

/// With `inUse` held.
Pool& poolOf(int count)
{
    Owned& kept = owned();
    if (kept.pool && kept.process != ::getpid())
    {
        static_cast<void>(kept.pool.release());
    }
    if (!kept.pool || kept.threads != count)
    {
        kept.pool.reset();
        kept.pool = std::make_unique<Pool>(count - 1);
        kept.threads = count;
        kept.process = ::getpid();
    }
    return *kept.pool;
}

/// This thread is in a task as long as one exists.
class InTask
{
public:
    InTask() { isInTask = true; }
    ~InTask() { isInTask = false; }
    InTask(const InTask&) = delete;
    InTask& operator=(const InTask&) = delete;
};

} // namespace

void setThreads(int count)
{
    wanted = std::max(1, count);
}

int threads()
{
    return wanted;
}

void carryOutTasks(int tasks, TaskFunction function)
{
    if (const int count = threads(); count > 1 && tasks > 1 && !isInTask)
    {
        if (const std::unique_lock lock(inUse, std::try_to_lock); lock)
        {
            const InTask here;
            poolOf(count).carryOut(tasks, function);
            return;
        }
    }
    for (int task = 0; task < tasks; ++task)
    {
        function.call(function.function, task, 0);
    }
}

} // namespace drystone
