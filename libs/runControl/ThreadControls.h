// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// `nThreads` of system/controlDict: how many threads the solvers of a run have.
#pragma once

#include "dictionary/Options.h"

#include <optional>

namespace drystone
{

struct ThreadControls
{
    std::optional<int> nThreads; ///< absent: as many as the machine or the scheduler grants
};

void declare(Options& options, ThreadControls& controls);

/// From now on the solvers of this process have the threads that its case requests, or those that are
/// granted. \throws FatalIOError for a number of threads that is none
void useThreads(const Dictionary& controlDict);

} // namespace drystone
