// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The threads and the dense kernel, which other libraries do not see.
#include "conic/MachineText.h"

#include "core/Threads.h"
#include "linear/DenseKernel.h"

#include <fmt/format.h>

namespace drystone
{

std::string machineText()
{
    return fmt::format("Threads: {}, dense kernel: {}", threads(), denseKernel().name);
}

} // namespace drystone
