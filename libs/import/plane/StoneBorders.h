// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Outlines of the stones of a picture, whose common borders are simplified once, so that they are the same
/// for both.
#pragma once

#include "geometry/Polygon.h"
#include "import/plane/Picture.h"

#include <vector>

namespace drystone
{

/// The outline of each stone, counter-clockwise with y upwards from the lower edge of the picture, in pixels.
/// A border runs between two points where three areas meet; its corners are those that Douglas and Peucker
/// (1973) keep, so that no pixel's corner is farther than `tolerance` [pixels] from it.
std::vector<Polygon> stoneOutlines(const Raster<int>& labels, int count, double tolerance);

} // namespace drystone
