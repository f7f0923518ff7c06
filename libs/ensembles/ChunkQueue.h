// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Which chunks of samples a program computes: those that no other program has.
#pragma once

#include "ensembles/SampleStore.h"
#include "runControl/LaunchedAs.h"

#include <map>
#include <vector>

namespace drystone
{

/// The chunks of a store, as one program takes them in turn.
class ChunkQueue
{
public:
    /// Looks which chunks are complete: journals that are read after that have all of their samples.
    /// \param ofSamples not owned
    ChunkQueue(SampleStore& ofSamples, const LaunchedAs& programLaunched);

    /// Completes chunks all of whose samples are in journals, after an interruption or for a longer table,
    /// and reopens those of which samples are in none, where files were lost. \return the samples lost
    long compareWithJournals(const std::map<long, SampleRow>& rows);

    /// Claims the next chunk that nobody has; -1 when there is none now. Programs begin at different places.
    long next();

    /// A chunk that was claimed: all samples are in synced journals.
    void complete(long chunk);

    /// Sees what other programs have completed meanwhile.
    void look() { completed = store.completed(); }

    bool areAllComplete() const;
    long samplesCompleted() const;

private:
    bool isOurs(long chunk, SampleStore::Claim claim) const;

    SampleStore& store;
    LaunchedAs launched;
    std::vector<char> completed; ///< of each chunk, when last looked at
    std::vector<char> begun;     ///< chunks that this program has taken
    long place = 0;              ///< where the next chunk is looked for
    bool isExhausted = false;    ///< there was none when last looked for
    double lastLook = 0;         ///< when one was last looked for [s]
};

} // namespace drystone
