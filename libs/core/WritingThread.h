// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// A thread that writes files while the program computes on: in this library because it knows nothing of what
/// is written.
#pragma once

#include <condition_variable>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>

namespace drystone
{

/// Carries out one piece of work at a time, in the order in which they are given. It starts with the first
/// one, and at most one waits or is carried out at any moment, so that memory is bounded and a program that
/// is killed loses one. To be used by one thread.
class WritingThread
{
public:
    WritingThread() = default;
    WritingThread(const WritingThread&) = delete;
    WritingThread& operator=(const WritingThread&) = delete;
    /// Waits for the work in hand; what it throws is printed as a warning.
    ~WritingThread();

    /// Waits for the work given before and then has this done. It must not use what the caller goes on to
    /// change. \throws what the work before has thrown; this is then not done
    void start(std::function<void()> nextWork);

    /// Waits until all is done. \throws what it has thrown
    void finish();

private:
    void run();

    std::mutex exchange;
    std::condition_variable changed;
    std::function<void()> work; ///< waiting or in hand; empty: none
    std::exception_ptr failure;
    bool isEnding = false;
    std::thread thread;
};

} // namespace drystone
