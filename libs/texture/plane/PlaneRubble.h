// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The texture `rubble` of the plane: a wall of irregular stones, the Voronoi cells of seeded points.
#pragma once

#include "assembly/Assembly.h"
#include "dictionary/Options.h"

#include <string>

namespace drystone
{

struct PlaneRubble
{
    Vector<2> size{3, 2}; ///< of the wall, from the origin [m]
    double thickness = 1; ///< out of plane [m]
    int stones = 100;
    int seed = 1;
    int relaxations = 2; ///< how often points are moved to the centroids of their cells (Lloyd)
    double leastJoint =
        0.1; ///< shorter joints shrink to a corner; in mean sizes of a stone, square root of its face
};

void declare(Options& options, PlaneRubble& rubble);

/// The stones, all free, in the order of their points, which depends on the seed alone. Together they fill
/// the rectangle; stones are convex where no short joint was removed, else nearly so. A stone of which short
/// joints leave less than three corners, or all in a line, is taken up by its neighbours.
Assembly<2> makeAssembly(const PlaneRubble& rubble);

/// How many stones short joints have taken away, where they were, and how to keep them; empty: none.
std::string lossOfStones(const PlaneRubble& rubble, const Assembly<2>& assembly);

} // namespace drystone
