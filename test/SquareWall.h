// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The square wall that tests and benchmarks share. Header only: targets that include it link texture.
#pragma once

#include "MadeStructure.h"

#include <fmt/format.h>

namespace drystone
{

/// Blocks of a square running-bond wall: as many courses as it is units long.
inline Assembly<2> squareWall(int size)
{
    return madeStructure(Dictionary::readString(fmt::format(
        "texture {{ type runningBond; unit (0.4 0.175); length {0}; courses {0}; firstCourse full; }}\n"
        "supports {{ ground {{ type ground; segment 0.5; }} }}\n",
        size)));
}

} // namespace drystone
