// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The texture `polyhedra`: blocks of any shape in space, given by their vertices and faces; what `polygons`
/// is in the plane.
#pragma once

#include "assembly/Assembly.h"
#include "assembly/Polyhedra.h"
#include "dictionary/Options.h"

namespace drystone
{

struct PolyhedronBlocks
{
    Polyhedra blocks; ///< solids with plane faces, convex or not [m]
};

void declare(Options& options, PolyhedronBlocks& polyhedra);

/// The blocks, all free, in the order given.
Assembly<3> makeAssembly(const PolyhedronBlocks& polyhedra);

} // namespace drystone
