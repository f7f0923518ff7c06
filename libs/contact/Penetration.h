// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// How deep placed blocks are in each other: the measure of every check that motion keeps them apart.
#pragma once

#include "assembly/Assembly.h"

namespace drystone
{

/// The deepest overlap of an assembly.
struct Penetration
{
    double depth = 0;   ///< [m], 0 when no two blocks overlap
    int block = -1;     ///< index in Assembly::blocks, -1 when no two blocks overlap
    int neighbour = -1; ///< index in Assembly::blocks, greater than `block`
};

/// Depth to which two simple polygons overlap [m]: for convex ones the least distance by which one must be
/// moved to part them, exactly; for concave ones the same of the deepest pair of their convex parts, or the
/// farthest that a vertex of one lies from the outline of the other that holds it, whichever is more. 0 when
/// they only touch or lie apart.
double overlapDepth(const Polygon& a, const Polygon& b);

/// Deepest overlap over all pairs of blocks of which at least one is free, through a broad phase.
/// \param placements one for each block
Penetration penetration(const Assembly<2>& assembly, const std::vector<Placement<2>>& placements);
Penetration penetration(const Assembly<3>& assembly, const std::vector<Placement<3>>& placements);

} // namespace drystone
