// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The texture `rubble` of space: a pier or wall of irregular stones, the Voronoi cells of seeded points.
#pragma once

#include "assembly/Assembly.h"
#include "dictionary/Options.h"

#include <string>

namespace drystone
{

struct Rubble
{
    Vector<3> size{2, 0.5, 2}; ///< of the wall, from the origin [m]
    int stones = 100;
    int seed = 1;
    int relaxations = 2;    ///< how often points are moved to the centroids of their cells (Lloyd): stones
                            ///< become rounder and more equal, small faces rarer
    double leastEdge = 0.1; ///< shorter edges shrink to a corner, and faces of such edges vanish; in mean
                            ///< sizes of a stone, cube root of its volume
};

void declare(Options& options, Rubble& rubble);

/// The stones, all free, in the order of their points, which depends on the seed alone. Together they fill
/// the box; none is lost. They are convex where no edge was removed (see ShortEdges.h); a face that is no
/// longer plane is split into triangles.
Assembly<3> makeAssembly(const Rubble& rubble);

/// What is wrong with the first stone that is no solid, and that another seed or leastEdge gives other
/// stones; empty where all are solids, or so large or small that the size of the wall is to blame.
std::string faultOfStones(const Rubble& rubble, const Assembly<3>& assembly);

} // namespace drystone
