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
        launched.rank += launched.size * task;
        launched.size *= std::max(numberIn("SLURM_ARRAY_TASK_COUNT", 1), 1);
    }
    launched.rank = std::clamp(launched.rank, 0, launched.size - 1);
    return launched;
}

} // namespace drystone
