// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Makes the blocks of the texture `rubble` of space from its settings.
#include "texture/space/Rubble.h"

#include "geometry/space/PolyhedronFault.h"
#include "texture/Voronoi.h"
#include "texture/space/ShortEdges.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

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
                  "more equal, small faces rarer")
        .atLeast(0)
        .atMost(1000);
    options
        .optional("leastEdge", rubble.leastEdge,
                  "shorter edges shrink to a corner, and small faces vanish with them; in mean sizes of a "
                  "stone; 0: none")
        .atLeast(0)
        .atMost(0.3);
}

namespace
{

bool areSolids(const std::vector<Polyhedron>& cells)
{
    return std::none_of(cells.begin(), cells.end(),
                        [](const Polyhedron& cell) { return findFault(cell).has_value(); });
}

/// The cells of points, all of them solids: five and more points at nearly the same distance from a place
/// make faces that are too small to have an area. \param mean size of a cell [m]
std::vector<Polyhedron> solidCells(const Vector<3>& size, const std::vector<Vector<3>>& points, double mean)
{
    const std::vector<Polyhedron> cells = voronoiCells(size, points);
    std::vector<Polyhedron> solids = cells;
    for (double least = 1e-7; least < 1e-2 && !areSolids(solids); least *= 10) // as little as is enough
    {
        solids = withoutShortEdges(cells, size, least * mean);
    }
    return solids;
}

} // namespace

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
         withoutShortEdges(solidCells(rubble.size, points, mean), rubble.size, rubble.leastEdge * mean))
    {
        assembly.blocks.push_back({std::move(cell)});
    }
    return assembly;
}

std::string faultOfStones(const Rubble& rubble, const Assembly<3>& assembly)
{
    const double mean = rubble.size.prod() / rubble.stones;
    for (std::size_t stone = 0; std::isnormal(mean * mean) && stone < assembly.blocks.size(); ++stone)
    {
        if (const std::optional<PolyhedronFault> fault = findFault(assembly.blocks[stone].shape))
        {
            return fmt::format("Stone {} of the seed {} is no solid: {}.\n\nAnother \"seed\" gives other "
                               "stones, and another \"leastEdge\" than {:g} other corners.",
                               stone, rubble.seed, fault->text, rubble.leastEdge);
        }
    }
    return {};
}

} // namespace drystone
