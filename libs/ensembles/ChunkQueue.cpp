// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Claims chunks by the locks of the store, where the file system has them.
#include "ensembles/ChunkQueue.h"

#include <algorithm>
#include <iterator>

namespace drystone
{

ChunkQueue::ChunkQueue(SampleStore& ofSamples, const LaunchedAs& programLaunched)
    : store(ofSamples), launched(programLaunched), completed(ofSamples.completed())
{
}

long ChunkQueue::compareWithJournals(const std::map<long, SampleRow>& rows)
{
    long lost = 0; // samples
    for (long chunk = 0; chunk < store.chunks(); ++chunk)
    {
        const auto [begin, end] = store.range(chunk);
        const long missing = end - begin - std::distance(rows.lower_bound(begin), rows.lower_bound(end));
        const bool isDone = completed[static_cast<std::size_t>(chunk)] != 0;
        if (isDone && missing > 0)
        {
            store.reopen(chunk);
            lost += missing;
        }
        else if (!isDone && missing == 0 && store.claim(chunk) != SampleStore::Claim::refused)
        {
            store.complete(chunk);
        }
    }
    look();
    begun.assign(completed.size(), 0);
    place = std::min(static_cast<long>(static_cast<double>(completed.size()) * launched.beginning),
                     static_cast<long>(completed.size()) - 1);
    return lost;
}

/// Without locks each program has chunks of its own, but where nobody knows which others there are: each
/// takes all that are not complete, and two may compute the same one.
bool ChunkQueue::isOurs(long chunk, SampleStore::Claim claim) const
{
    return claim == SampleStore::Claim::taken
           || (claim == SampleStore::Claim::noLocks
               && (launched.isIrregular || chunk % launched.size == launched.rank));
}

long ChunkQueue::next()
{
    constexpr double pause = 0.3; // [s], so that waiting for others costs little
    if (isExhausted && monotonicTime() - lastLook < pause)
    {
        return -1;
    }
    if (isExhausted)
    {
        look();
    }
    lastLook = monotonicTime();
    const long count = store.chunks();
    for (long tried = 0; tried < count; ++tried)
    {
        const long chunk = (place + tried) % count;
        const auto index = static_cast<std::size_t>(chunk);
        if (!completed[index] && !begun[index] && isOurs(chunk, store.claim(chunk)))
        {
            place = (chunk + 1) % count;
            begun[index] = 1;
            isExhausted = false;
            return chunk;
        }
    }
    isExhausted = true;
    return -1;
}

void ChunkQueue::complete(long chunk)
{
    store.complete(chunk);
    completed[static_cast<std::size_t>(chunk)] = 1;
}

bool ChunkQueue::areAllComplete() const
{
    return std::all_of(completed.begin(), completed.end(), [](char done) { return done != 0; });
}

long ChunkQueue::samplesCompleted() const
{
    long done = 0;
    for (long chunk = 0; chunk < store.chunks(); ++chunk)
    {
        if (completed[static_cast<std::size_t>(chunk)])
        {
            done += store.range(chunk).second - store.range(chunk).first;
        }
    }
    return done;
}

} // namespace drystone
