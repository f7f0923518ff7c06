// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Blocks of any shape, corner by corner.
#pragma once

#include "assembly/Assembly.h"

#include <vector>

namespace drystone
{

struct Polygons
{
    double thickness = 1;        ///< out of plane [m]
    std::vector<Polygon> blocks; ///< simple polygons, convex or not, in either orientation [m]
};

/// The blocks, all free, in the order given, each turned counter-clockwise.
Assembly<2> makeAssembly(const Polygons& polygons);

} // namespace drystone
