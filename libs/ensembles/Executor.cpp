// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Threads that take the next piece of work each.
#include "ensembles/Executor.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

namespace drystone
{
namespace
{

/// Pieces of work that threads take one after another, and reports of them in their order.
class SharedWork
{
public:
    SharedWork(std::size_t pieces, const std::function<void(std::size_t)>& workOfPiece,
               const std::function<void(std::size_t)>& reportOfPiece)
        : count(pieces), work(workOfPiece), report(reportOfPiece), isDone(pieces, 0), errors(pieces)
    {
    }

    /// The share of one thread: it takes pieces until there are no more.
    void takePieces();
    /// \throws the error of the first piece that has one \pre all threads have ended
    void requireSuccess() const;

private:
    /// \param error of the work, or null
    void finish(std::size_t piece, std::exception_ptr error);
    void reportPiece(std::size_t piece);

    std::size_t count;
    const std::function<void(std::size_t)>& work;
    const std::function<void(std::size_t)>& report;
    std::vector<char> isDone;
    std::vector<std::exception_ptr> errors; ///< of the work or the report of each piece; null: none
    std::atomic<std::size_t> next = 0;
    std::size_t reported = 0; ///< pieces, without an error
    std::mutex reporting;
};

void SharedWork::takePieces()
{
    for (std::size_t piece = next++; piece < count; piece = next++)
    {
        std::exception_ptr error;
        try
        {
            work(piece);
        }
        catch (...)
        {
            error = std::current_exception();
        }
        finish(piece, error);
    }
}

void SharedWork::finish(std::size_t piece, std::exception_ptr error)
{
    const std::lock_guard lock(reporting);
    errors[piece] = std::move(error);
    isDone[piece] = 1;
    while (reported < count && isDone[reported] && !errors[reported])
    {
        reportPiece(reported);
        reported += errors[reported] ? 0 : 1;
    }
    if (errors[piece] || (reported < count && errors[reported]))
    {
        next = count; // what is before the fault has been begun: pieces are taken in order
    }
}

/// What a report throws must leave neither a thread, nor threads that nobody has joined.
void SharedWork::reportPiece(std::size_t piece)
{
    try
    {
        if (report)
        {
            report(piece);
        }
    }
    catch (...)
    {
        errors[piece] = std::current_exception();
    }
}

void SharedWork::requireSuccess() const
{
    for (const std::exception_ptr& error : errors)
    {
        if (error)
        {
            std::rethrow_exception(error);
        }
    }
}

} // namespace

void carryOutAll(std::size_t count, int threads, const std::function<void(std::size_t)>& work,
                 const std::function<void(std::size_t)>& report)
{
    SharedWork shared(count, work, report);
    std::vector<std::thread> others;
    const std::size_t wanted = static_cast<std::size_t>(std::max(threads, 1));
    for (std::size_t thread = 1; thread < std::min(count, wanted); ++thread)
    {
        others.emplace_back([&shared] { shared.takePieces(); });
    }
    shared.takePieces();
    for (std::thread& thread : others)
    {
        thread.join();
    }
    shared.requireSuccess();
}

} // namespace drystone
