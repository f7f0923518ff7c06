// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The texture `polygons`: blocks of any shape, given by their corners.
#pragma once

#include "assembly/Assembly.h"
#include "assembly/Outlines.h"
#include "dictionary/Options.h"

namespace drystone
{

struct Polygons
{
    double thickness = 1; ///< out of plane [m]
    Outlines blocks;      ///< simple polygons, convex or not [m]
};

void declare(Options& options, Polygons& polygons);

/// The blocks, all free, in the order given.
Assembly<2> makeAssembly(const Polygons& polygons);

} // namespace drystone
