// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Points that are written several times, made one: files repeat the corner of a block for every face, and
/// neighbours repeat each other's.
#pragma once

#include "geometry/Vector.h"

#include <vector>

namespace drystone
{

/// For each point the index of the node that it belongs to, nodes numbered in the order in which they appear.
/// A point joins the first node whose first point lies within `tolerance` of it, or is equal to it where the
/// tolerance is 0. \param owners of the points; two points of one owner never share a node. Empty: they may
/// \param tolerance [m], coordinates below 1e15 of it. Time of order n
std::vector<int> weld(const std::vector<Vector<3>>& points, double tolerance,
                      const std::vector<int>& owners = {});

} // namespace drystone
