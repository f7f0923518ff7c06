// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// How far the pixels of a picture are from what is marked in it.
#pragma once

#include "import/plane/Raster.h"

namespace drystone
{

/// Square of the distance of each pixel to the nearest one that is marked, between their centres [pixels^2];
/// 1e15 or more where none is. Time of order of the pixels. \param isMarked 0 for those that are not
Raster<double> squaredDistances(const Raster<std::uint8_t>& isMarked);

} // namespace drystone
