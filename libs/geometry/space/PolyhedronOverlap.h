// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// How two polyhedra lie to each other, and the figures of their shape: the geometry behind the checks of an
/// assembly in space.
#pragma once

#include "geometry/space/Polyhedron.h"

namespace drystone
{

/// Whether every vertex lies behind the plane of every face, to 1e-9 of the extent, or to a distance [m].
bool isConvex(const Polyhedron& polyhedron);
bool isConvex(const Polyhedron& polyhedron, double within);

/// Depth to which two polyhedra overlap [m]: for convex ones the least distance by which one must be moved to
/// part them, along the normals of their faces and the directions across pairs of their edges (theorem of the
/// separating axis); with a concave one the same of the deepest pair of their convex parts, or the farthest
/// that a vertex of one lies inside the other, whichever is more. 0 when they touch or lie apart.
double overlapDepth(const Polyhedron& a, const Polyhedron& b);

/// Volume common to two polyhedra [m3], convex or not. A solid is the sum of the tetrahedra from one point to
/// its faces, those that are turned towards the point counted as negative; so the common part of two solids
/// is the sum of the common parts of their tetrahedra. Correct to rounding relative to the smaller solid.
double overlapVolume(const Polyhedron& a, const Polyhedron& b);

/// Figures that distinguish a sound block from a sliver.
struct SolidQuality
{
    double compactness = 0;  ///< 36 pi volume^2 / surface^3: 1 for a ball, 0.52 for a cube
    double shortestEdge = 0; ///< [m]
};

SolidQuality solidQuality(const Polyhedron& polyhedron);

} // namespace drystone
