// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Shape of simple polygons and position of two of them relative to each other: the geometry behind the
/// checks of an assembly.
#pragma once

#include "geometry/Polygon.h"

#include <array>
#include <optional>
#include <string>
#include <utility>

namespace drystone
{

/// The first two edges of an outline that cross, touch or fold back on each other, by index (edge i runs from
/// vertex i to the next one), or nothing when the outline is simple. Edges that come within `tolerance` [m]
/// touch; neighbours touch at their common corner alone, and fold back when the second runs back along the
/// first.
std::optional<std::pair<int, int>> findSelfIntersection(const Polygon& polygon, double tolerance);

/// What keeps an outline from being a block, as a predicate that continues "outline 3 ": too few corners, a
/// coordinate that is not finite, corners that coincide, edges that cross or touch (closer than 1e-10 of its
/// extent), no area. Empty when it is a simple polygon, in either orientation.
std::string outlineFault(const Polygon& polygon);

/// Whether no corner of a simple counter-clockwise polygon turns right. Straight corners count as convex.
bool isConvex(const Polygon& polygon);

/// Triangles (counter-clockwise) that together make up a simple counter-clockwise polygon, by ear clipping,
/// as indices of its corners; of one that crosses itself, as many triangles. Takes time of order n^2.
std::vector<std::array<int, 3>> triangleCorners(const Polygon& polygon);

/// The same with the corners themselves.
std::vector<std::array<Vector<2>, 3>> triangulate(const Polygon& polygon);

/// Convex polygons that together make up a simple counter-clockwise one: itself where it is convex, else its
/// triangles.
std::vector<Polygon> convexParts(const Polygon& polygon);

/// Area common to two simple counter-clockwise polygons [m2], convex or not. Correct to rounding relative to
/// the smaller polygon: polygons that only touch give a value near 0, not always 0.
double overlapArea(const Polygon& a, const Polygon& b);

/// Distance from a point to a segment, and between two segments (0 when they cross) [m].
double distance(const Vector<2>& point, const Vector<2>& from, const Vector<2>& to);
double distance(const Vector<2>& from1, const Vector<2>& to1, const Vector<2>& from2, const Vector<2>& to2);

/// Distance from a point to the outline [m]: negative inside the polygon, positive outside.
double signedDistance(const Polygon& polygon, const Vector<2>& point);

/// Figures that distinguish a sound block from a sliver.
struct ShapeQuality
{
    double compactness = 0;   ///< 4 pi area / perimeter^2: 1 for a circle, 0.785 for a square
    double smallestAngle = 0; ///< the sharpest corner [rad], between 0 and pi
    double shortestEdge = 0;  ///< relative to the perimeter
};

ShapeQuality shapeQuality(const Polygon& polygon);

} // namespace drystone
