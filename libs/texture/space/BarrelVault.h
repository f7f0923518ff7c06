// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The texture `barrelVault`: an arch given length, in slices whose joints may be staggered.
#pragma once

#include "texture/Arch.h"

namespace drystone
{

struct BarrelVault
{
    Arch arch;              ///< its section; `depth` is not used
    double length = 1;      ///< along the axis, which is y [m]
    int slices = 1;         ///< blocks along the axis in an even row of voussoirs
    bool staggered = false; ///< odd rows begin and end with half a slice
};

void declare(Options& options, BarrelVault& vault);

/// Voussoirs by row from the left springing (-x) to the right one, in each row along y from 0 to the length.
/// The axis is at x = z = 0: a semicircle springs from z = 0. Abutments come last, one on either side, as in
/// the plane.
Assembly<3> makeAssembly(const BarrelVault& vault);

} // namespace drystone
