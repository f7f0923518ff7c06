// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The executor of processes: computes the samples of a store by worker processes, alone or together with
/// other such programs that share the folder.
#pragma once

#include "ensembles/SampleStore.h"
#include "runControl/LaunchedAs.h"

#include <functional>

namespace drystone
{

struct WorkerSettings
{
    int jobs = 1; ///< worker processes of this program
    LaunchedAs launched;
    bool waitsForOthers = true; ///< until all samples are there; else until none is left to begin
};

/// What there is of an ensemble at some instant, over all programs.
struct EnsembleProgress
{
    long done = 0;
    long samples = 0;
    long failed = 0; ///< that this program knows of
    double rate = 0; ///< samples a second of late, over all programs
};

/// Computes what is missing. A worker that crashes, hangs or is killed costs the sample in hand one attempt
/// and is replaced.
/// \param report called every few seconds
/// \return whether all samples are there; false after a signal, or when others have some in hand
bool computeSamples(const Ensemble& ensemble, SampleStore& store, const WorkerSettings& settings,
                    const std::function<void(const EnsembleProgress&)>& report);

} // namespace drystone
