// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Voronoi cells in a box, of which rubble is made.
#pragma once

#include "geometry/space/Polyhedron.h"

#include <vector>

namespace drystone
{

/// The cells of points in a box from the origin: convex, one a point, together the box. Faces turned
/// outwards; cells that share a face have it to rounding. (Voro++, Rycroft 2009.) \param size of the box [m]
/// \param points inside it, no two in the same place
std::vector<Polyhedron> voronoiCells(const Vector<3>& size, const std::vector<Vector<3>>& points);

/// Uniformly distributed points in the box, the same for the same seed on every machine.
std::vector<Vector<3>> uniformPoints(const Vector<3>& size, int count, int seed);

} // namespace drystone
