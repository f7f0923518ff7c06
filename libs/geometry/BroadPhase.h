// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The broad phase, pure geometry that contact search, checks and textures share: which axis-aligned boxes
/// meet, without comparing all pairs.
#pragma once

#include "geometry/Box.h"
#include "geometry/Polygon.h"
#include "geometry/space/Polyhedron.h"

#include <utility>
#include <vector>

namespace drystone
{

/// The smallest box that contains every vertex.
BoundingBox boundingBox(const Polygon& polygon);
Box<3> boundingBox(const Polyhedron& polyhedron);

/// All pairs (i, j), i < j, of boxes that meet, sorted. Searches a tree of boxes split at the median, so the
/// time is of order (n log n + pairs) for boxes of any mixture of sizes. Empty boxes meet nothing.
template<int Dim>
std::vector<std::pair<int, int>> findMeetingPairs(const std::vector<Box<Dim>>& boxes);
inline std::vector<std::pair<int, int>>
findMeetingPairs(const std::vector<BoundingBox>& boxes) // also in braces
{
    return findMeetingPairs<2>(boxes);
}

/// All pairs (i, j) of boxes[i] and others[j] that meet, sorted, in time of the same order.
template<int Dim>
std::vector<std::pair<int, int>> findMeetingPairs(const std::vector<Box<Dim>>& boxes,
                                                  const std::vector<Box<Dim>>& others);

} // namespace drystone
