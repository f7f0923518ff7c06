// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// A polyhedron cut into convex ones, for what is only known of these. In this library because it is geometry
/// alone.
#pragma once

#include "geometry/space/Polyhedron.h"

namespace drystone
{

/// Convex polyhedra that fill the solid and overlap nowhere: the cells in which the planes of its faces
/// divide it, each only where one of its faces goes through the cell (binary space partition: Fuchs, Kedem &
/// Naylor 1980). One, with faces of one plane as one, for a convex solid. \param tolerance by which vertices
/// may be beyond a plane and still count as on it; what is thinner is left out [m] \param most parts \return
/// empty where they would be more
std::vector<Polyhedron> convexParts(const Polyhedron& polyhedron, double tolerance, std::size_t most);

} // namespace drystone
