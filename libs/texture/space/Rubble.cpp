// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Makes the blocks of the texture `rubble` of space from its settings.
#include "texture/space/Rubble.h"

#include "texture/Voronoi.h"
#include "texture/space/ShortEdges.h"

#include <algorithm>
#include <cmath>

namespace drystone
{

void declare(Options& options, Rubble& rubble)
{
    options.required("size", rubble.size, "of the wall or pier, from the origin")
        .unit("m")
        .above(0)
        .example("(2 0.5 2)");
    options.required("stones", rubble.stones, "their number").atLeast(1).atMost(1000000).example("100");
    options.optional("seed", rubble.seed, "of the points: another one gives another wall").atLeast(0);
    options
        .optional("relaxations", rubble.relaxations,
                  "how often points are moved to the centroids of their cells: stones become rounder and "
                  "more equal, "
                  "small faces rarer")
        .atLeast(0)
        .atMost(1000);
    options
        .optional("leastEdge", rubble.leastEdge,
                  "shorter edges shrink to a corner, and small faces vanish with them; in mean sizes of a "
                  "stone; 0: none")
        .atLeast(0)
        .atMost(0.3);
}

Assembly<3> makeAssembly(const Rubble& rubble)
{
    std::vector<Vector<3>> points = uniformPoints(rubble.size, rubble.stones, rubble.seed);
    for (int round = 0; round < rubble.relaxations; ++round)
    {
        const std::vector<Polyhedron> cells = voronoiCells(rubble.size, points);
        std::transform(cells.begin(), cells.end(), points.begin(),
                       [](const Polyhedron& cell) { return volumeProperties(cell).centroid; });
    }
    Assembly<3> assembly;
    const double mean = std::cbrt(rubble.size.prod() / rubble.stones);
    for (Polyhedron& cell :
         withoutShortEdges(voronoiCells(rubble.size, points), rubble.size, rubble.leastEdge * mean))
    {
        assembly.blocks.push_back({std::move(cell)});
    }
    return assembly;
}

} // namespace drystone
