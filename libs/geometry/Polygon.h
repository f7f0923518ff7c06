// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Simple polygons, the outline of a block in the plane, with the integrals that mass and inertia are made
/// of.
#pragma once

#include "geometry/Vector.h"

#include <vector>

namespace drystone
{

/// Vertices in order around the outline, without repeating the first one [m]. Convex or concave, without
/// self-intersection.
using Polygon = std::vector<Vector<2>>;

/// Area and its first and second moments, which times density and thickness are mass and inertia.
struct AreaProperties
{
    double area = 0;                        ///< [m2], positive when the vertices run counter-clockwise
    Vector<2> centroid = Vector<2>::Zero(); ///< [m]
    double polarMoment = 0;                 ///< about the centroid [m4]
};

/// Area properties of a simple polygon (Green's theorem, taken about the first vertex to avoid cancellation
/// in a block far from the origin). Clockwise: area and polar moment are negative. Without area, as of fewer
/// than three vertices: all zero.
AreaProperties areaProperties(const Polygon& polygon);

/// The outline without the vertices that only split a straight edge: each omitted vertex lies within
/// `tolerance` [m] of the edge that replaces its two edges. Keeps the order of the others; never fewer than
/// three vertices.
Polygon withoutStraightVertices(const Polygon& polygon, double tolerance);

} // namespace drystone
