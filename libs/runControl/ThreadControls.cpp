// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Reads the number of threads, which only applications with a solver have.
#include "runControl/ThreadControls.h"

#include "core/Log.h"
#include "core/Threads.h"

namespace drystone
{

void declare(Options& options, ThreadControls& controls)
{
    options
        .optional(
            "nThreads", controls.nThreads,
            "threads of the solvers, which results do not depend on; absent: as many as the machine or the "
            "scheduler grants (OMP_NUM_THREADS, SLURM_CPUS_PER_TASK, its cores and their control group)")
        .atLeast(1)
        .atMost(1024)
        .example("2");
}

void useThreads(const Dictionary& controlDict)
{
    ThreadControls controls;
    Options options;
    declare(options, controls);
    std::vector<std::string> others;
    for (const Entry& entry : controlDict.entries())
    {
        if (!entry.isPattern() && entry.keyword() != "nThreads")
        {
            others.push_back(entry.keyword());
        }
    }
    options.readElsewhere(others);
    options.readFrom(controlDict);
    setThreads(controls.nThreads.value_or(threadCount()));
}

} // namespace drystone
