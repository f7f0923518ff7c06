// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The part of a joint's area that each of its contact points stands for.
#pragma once

#include "contact/ContactPoint.h"

#include <vector>

namespace drystone
{

/// Area that each point stands for [m2]. In the plane: thickness times half the way to its neighbours in the
/// joint. The thickness is the lesser of the two blocks', or that of the free one. In space, for points at
/// the corners of a patch: of a convex one the triangles from its centroid to its edges, half of each for
/// either end; of a concave one, whose centroid may lie outside, a third of the triangles that it is divided
/// into. None is negative, they add up to the area of the patch and their moments to its own (vertexAreas of
/// space/PatchCells.h has those of points within it).
///
/// With the ends among the points a block of uniform pressure from one end inwards has its resultant where it
/// belongs to second order in their distance.
std::vector<double> pointAreas(const Assembly<2>& assembly, const std::vector<ContactPoint<2>>& points);
std::vector<double> pointAreas(const Assembly<3>& assembly, const std::vector<ContactPoint<3>>& points);

} // namespace drystone
