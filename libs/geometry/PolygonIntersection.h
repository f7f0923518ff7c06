// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The common parts of two polygons: where two faces touch, or two blocks overlap.
#pragma once

#include "geometry/Polygon.h"

#include <vector>

namespace drystone
{

/// The common part of two convex counter-clockwise polygons, counter-clockwise; empty where they have none.
/// Polygons that only touch may give one without area. (Sutherland and Hodgman, 1974.)
Polygon convexIntersection(Polygon a, const Polygon& b);

/// The common parts of two simple counter-clockwise polygons, convex or not: simple polygons,
/// counter-clockwise, without corners that only split a straight edge. Parts that are nowhere wider than
/// `tolerance` [m], as where the polygons touch along an edge or at a corner, are left out; so are tongues of
/// others that are this thin. The order is that of the search, the same for the same polygons. (Vatti 1992,
/// by Clipper.)
std::vector<Polygon> intersection(const Polygon& a, const Polygon& b, double tolerance);

} // namespace drystone
