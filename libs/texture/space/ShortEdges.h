// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Removal of short edges from solids that fill a box, with the small faces between them: what makes rubble
/// of cells.
#pragma once

#include "geometry/space/Polyhedron.h"

#include <vector>

namespace drystone
{

/// The solids after edges shorter than `least` have shrunk to a corner, the mean of their ends, which stays
/// on the sides of the box. Faces with fewer than three corners left vanish; those that are no longer plane
/// are split into triangles, on both sides alike, so that the solids still fill the box. Edges stay where a
/// solid would no longer be one. \param cells that share whole faces, as Voronoi cells do \param size of the
/// box from the origin [m]
std::vector<Polyhedron> withoutShortEdges(const std::vector<Polyhedron>& cells, const Vector<3>& size,
                                          double least);

} // namespace drystone
