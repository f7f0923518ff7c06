// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Tasks that several threads of this process carry out together: in this library because it knows nothing of
/// what is computed.
#pragma once

#include <algorithm>
#include <type_traits>

namespace drystone
{

/// From now on `carryOut` has so many threads, the caller's included. One until this is called, as for a
/// process among others that fill the machine. \param count at least 1; what is granted is threadCount() of
/// core/Log.h
void setThreads(int count);
int threads();

/// A function of the number of a task and of the thread that carries it out, without its type.
struct TaskFunction
{
    void (*call)(const void* function, int task, int worker);
    const void* function;
};

/// As the template below.
void carryOutTasks(int tasks, TaskFunction function);

/// Carries out `function(task, worker)` for each task from 0 to tasks - 1, begun in this order, and returns
/// when all are done. `worker`, from 0 to threads() - 1, is another one for each of those that are at work at
/// a time. Results do not depend on the number of threads where each task writes what no other reads or
/// writes, and the tasks themselves do not depend on it. All is done by the caller where there is but one
/// thread, inside a task, and while another thread has the others at work. Threads begin with the first call
/// that needs them, look out for more tasks for some microseconds after each, and then sleep.
/// \throws what the first task that failed has thrown, once all have ended
template<class Function>
void carryOut(int tasks, const Function& function)
{
    carryOutTasks(tasks, {[](const void* of, int task, int worker)
                          { (*static_cast<const Function*>(of))(task, worker); },
                          &function});
}

/// Entries of vectors from which on it pays to have several threads pass over them, and of each pass.
inline constexpr long entriesOfTask = 1 << 14;

/// Parts of a vector that passes over it are divided into; one where it is short. They depend on its size
/// alone.
inline int partsOf(long size)
{
    return static_cast<int>(std::max(1L, (size + entriesOfTask - 1) / entriesOfTask));
}

/// Carries out `function(begin, end)` for each part of a vector of so many entries.
template<class Function>
void forParts(long size, const Function& function)
{
    carryOut(partsOf(size), [&](int part, int)
             { function(part * entriesOfTask, std::min(size, (part + 1) * entriesOfTask)); });
}

} // namespace drystone
