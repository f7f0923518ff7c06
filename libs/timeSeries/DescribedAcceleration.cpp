// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// What the summaries of all types of ground acceleration begin with.
#include "timeSeries/DescribedAcceleration.h"

#include <fmt/format.h>

namespace drystone
{

std::string typeLine(const std::string& type)
{
    return fmt::format("    type        {}\n", type);
}

} // namespace drystone
