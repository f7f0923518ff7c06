// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The broad phase, pure geometry that contact search, checks and textures share: which axis-aligned boxes
/// meet, without comparing all pairs.
#pragma once

#include "geometry/Polygon.h"

#include <utility>
#include <vector>

namespace drystone
{

/// Axis-aligned box around a block. The default is empty: it meets nothing, and extending it by a point gives
/// that point.
struct BoundingBox
{
    Vector<2> lower = Vector<2>::Constant(1e300);  ///< [m]
    Vector<2> upper = Vector<2>::Constant(-1e300); ///< [m]
};

/// The smallest box that contains every vertex.
BoundingBox boundingBox(const Polygon& polygon);

/// The box with every side moved outwards by `distance` [m].
inline BoundingBox enlarged(const BoundingBox& box, double distance)
{
    return {box.lower.array() - distance, box.upper.array() + distance};
}

/// Whether the closed boxes share a point: boxes that only touch do meet.
inline bool meet(const BoundingBox& a, const BoundingBox& b)
{
    return a.lower.x() <= b.upper.x() && b.lower.x() <= a.upper.x() && a.lower.y() <= b.upper.y()
           && b.lower.y() <= a.upper.y();
}

/// Whether every point of `inner` is a point of `outer`.
inline bool contains(const BoundingBox& outer, const BoundingBox& inner)
{
    return outer.lower.x() <= inner.lower.x() && outer.lower.y() <= inner.lower.y()
           && inner.upper.x() <= outer.upper.x() && inner.upper.y() <= outer.upper.y();
}

/// All pairs (i, j), i < j, of boxes that meet, sorted. Searches a tree of boxes split at the median, so the
/// time is of order (n log n + pairs) for boxes of any mixture of sizes. Empty boxes meet nothing.
std::vector<std::pair<int, int>> findMeetingPairs(const std::vector<BoundingBox>& boxes);

} // namespace drystone
