// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The texture `stair`: steps that cantilever from a wall and rest on each other.
#pragma once

#include "assembly/Assembly.h"
#include "dictionary/Options.h"

namespace drystone
{

struct Stair
{
    int steps = 8;
    double going = 0.28;   ///< from the front of a step to that of the next [m]
    double rise = 0.17;    ///< height of a step [m]
    double width = 1;      ///< from the wall to the free end of a step [m]
    double overlap = 0.04; ///< by which a step lies on the one below [m]
    double bearing = 0.15; ///< by which it is built into the wall [m]
};

void declare(Options& options, Stair& stair);

/// Steps from the lowest up along x, the wall behind y = 0; then the stones of the wall, fixed as support
/// `wall`, which enclose the ends of the steps from below, from above and on both sides.
Assembly<3> makeAssembly(const Stair& stair);

} // namespace drystone
