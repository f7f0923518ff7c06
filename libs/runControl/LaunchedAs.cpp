// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// What launchers say in the environment.
#include "runControl/LaunchedAs.h"

#include <algorithm>
#include <cstdlib>
#include <utility>

namespace drystone
{
namespace
{

int numberIn(const char* variable, int otherwise)
{
    const char* text = std::getenv(variable);
    return text && *text ? std::atoi(text) : otherwise;
}

} // namespace

LaunchedAs launchedAs()
{
    const std::pair<const char*, const char*> launchers[] = {{"OMPI_COMM_WORLD_RANK", "OMPI_COMM_WORLD_SIZE"},
                                                             {"PMI_RANK", "PMI_SIZE"},
                                                             {"SLURM_PROCID", "SLURM_NTASKS"}};
    LaunchedAs launched;
    for (const auto& [rank, size] : launchers)
    {
        if (std::getenv(rank) && std::getenv(size))
        {
            launched.rank = numberIn(rank, 0);
            launched.size = std::max(numberIn(size, 1), 1);
            break;
        }
    }
    if (std::getenv("SLURM_ARRAY_TASK_ID"))
    {
        launched.isArray = true;
        const int first = numberIn("SLURM_ARRAY_TASK_MIN", 0);
        const int step = std::max(numberIn("SLURM_ARRAY_TASK_STEP", 1), 1);
        const int task = (numberIn("SLURM_ARRAY_TASK_ID", 0) - first) / step;
        const int count = std::max(numberIn("SLURM_ARRAY_TASK_COUNT", 1), 1);
        const int places =
            std::max((numberIn("SLURM_ARRAY_TASK_MAX", first + (count - 1) * step) - first) / step + 1, 1);
        launched.isIrregular = places != count;
        launched.beginning = (task + static_cast<double>(launched.rank) / launched.size) / places;
        launched.rank += launched.size * task;
        launched.size *= count;
    }
    launched.rank = std::clamp(launched.rank, 0, launched.size - 1);
    if (!launched.isIrregular)
    {
        launched.beginning = static_cast<double>(launched.rank) / launched.size;
    }
    return launched;
}

} // namespace drystone
