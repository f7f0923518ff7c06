// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// One worker process of an ensemble: the samples of one chunk after the other, with a note of each in memory
/// that its supervisor sees.
#pragma once

#include "ensembles/SampleStore.h"

#include <array>
#include <atomic>
#include <filesystem>
#include <map>

#include <sys/types.h>

namespace drystone
{

/// What a worker does, in memory that it shares with its supervisor.
struct Activity
{
    std::atomic<long> sample{-1}; ///< in hand; -1: none
    std::atomic<double> since{0}; ///< monotonic time at which the attempt began [s]
    std::atomic<long> done{0};    ///< samples of the chunk in hand that are done
    /// The sample in hand and others before this one are computed together: a crash is not known to be of the
    /// sample in hand. 0: it is by itself.
    std::atomic<long> togetherBefore{0};
    /// Samples of the chunk in hand before this one are computed one by one.
    std::atomic<long> aloneBefore{0};
    std::atomic<bool> stops{false};         ///< finish the sample in hand and end
    std::atomic<bool> isFromOutside{false}; ///< the signal that ended the worker was sent by somebody
    /// Why the worker cannot go on, ended by a zero: where the disk is full no file has room for it.
    std::array<char, 512> fault{};
};

struct Worker
{
    pid_t process = -1;
    int orders = -1;  ///< to the worker: numbers of chunks
    int answers = -1; ///< from it: a byte when a chunk is complete; its end when the worker has died
    long chunk = -1;  ///< in hand
    Activity* activity = nullptr;
    std::filesystem::path journal;
    std::filesystem::path messages;
    std::filesystem::path scratch;
    SampleStatus endedFor = SampleStatus::crashed; ///< when the supervisor itself ends it
    bool isEnded = false;
};

/// Lets a descriptor of this process write to the end of a file; nothing where that cannot be opened.
void redirect(const std::filesystem::path& file, int descriptor);

/// The life of a worker: chunks until there is no other. \param knownBefore samples that are done
[[noreturn]] void work(const Ensemble& ensemble, const SampleStore& store, const Worker& worker,
                       const std::map<long, SampleRow>& knownBefore);

/// Copies of the case that programs of this machine have left when they were killed. \param prefix of their
/// names, before the number of the process
void removeCopiesOfTheDead(const std::filesystem::path& folder, const std::string& prefix);

} // namespace drystone
