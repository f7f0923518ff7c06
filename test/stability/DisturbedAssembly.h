// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Rounding in what is built: hard cases are solved as they are and with corners that are off by some of it.
#pragma once

#include "assembly/Assembly.h"

#include <random>

namespace drystone
{

/// Corners moved by up to `noise` [m], each by its own; the same in each call.
inline Assembly<2> disturbed(Assembly<2> assembly, double noise)
{
    std::mt19937 random(7);
    std::uniform_real_distribution<double> part(-noise, noise);
    for (Block<2>& block : assembly.blocks)
    {
        for (Vector<2>& vertex : block.outline)
        {
            vertex += Vector<2>(part(random), part(random));
        }
    }
    return assembly;
}

} // namespace drystone
