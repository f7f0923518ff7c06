// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Makes the blocks of the texture `rubble` of the plane from its settings.
#include "texture/plane/PlaneRubble.h"

#include "core/DisjointSets.h"
#include "core/ShownList.h"
#include "geometry/BroadPhase.h"
#include "texture/Voronoi.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace drystone
{

namespace
{

/// The cells of points in a rectangle: those of a slab cut through the middle of its thickness.
std::vector<Polygon> planeCells(const Vector<2>& size, const std::vector<Vector<2>>& points)
{
    // As thick as the cells are large, which keeps the bins of the search square.
    const double depth = std::sqrt(size.prod() / static_cast<double>(points.size()));
    std::vector<Vector<3>> inSlab;
    for (const Vector<2>& point : points)
    {
        inSlab.emplace_back(point.x(), point.y(), depth / 2);
    }
    std::vector<Polygon> cells;
    for (const Polyhedron& prism : voronoiCells({size.x(), size.y(), depth}, inSlab))
    {
        Polygon outline;
        for (const std::vector<int>& face : prism.faces)
        {
            if (areaVector(prism, face).normalized().z() > 0.5)
            {
                for (const int corner : face)
                {
                    outline.emplace_back(prism.vertices[corner].head<2>());
                }
            }
        }
        cells.push_back(std::move(outline));
    }
    return cells;
}

/// The corners of all cells, one cell after the other.
std::vector<Vector<2>> cornersOf(const std::vector<Polygon>& cells)
{
    std::vector<Vector<2>> corners;
    for (const Polygon& cell : cells)
    {
        corners.insert(corners.end(), cell.begin(), cell.end());
    }
    return corners;
}

/// Which corners are to be one: those that are the same but for rounding, and the ends of short edges.
/// \param corners of the cells
DisjointSets clustersOf(const std::vector<Polygon>& cells, const std::vector<Vector<2>>& corners, double same,
                        double least)
{
    std::vector<BoundingBox> boxes;
    for (const Vector<2>& corner : corners)
    {
        boxes.push_back(enlarged(BoundingBox{corner, corner}, same / 2));
    }
    DisjointSets clusters(corners.size());
    for (const auto& [one, other] : findMeetingPairs(boxes))
    {
        clusters.join(one, other);
    }
    int first = 0;
    for (const Polygon& cell : cells)
    {
        const int count = static_cast<int>(cell.size());
        for (int i = 0; i < count; ++i)
        {
            const int next = (i + 1) % count;
            if ((cell[next] - cell[i]).norm() < least)
            {
                clusters.join(first + i, first + next);
            }
        }
        first += count;
    }
    return clusters;
}

/// Where each corner comes to lie: at the mean of its cluster, but on the sides of the rectangle that the
/// cluster touches.
std::vector<Vector<2>> mergedCorners(const std::vector<Vector<2>>& corners, DisjointSets& clusters,
                                     const Vector<2>& size, double same)
{
    std::vector<Vector<2>> sums(corners.size(), Vector<2>::Zero());
    std::vector<int> counts(corners.size(), 0);
    std::vector<BoundingBox> extents(corners.size());
    for (std::size_t i = 0; i < corners.size(); ++i)
    {
        const int root = clusters.firstOf(static_cast<int>(i));
        sums[root] += corners[i];
        ++counts[root];
        extend<2>(extents[root], corners[i]);
    }
    std::vector<Vector<2>> merged(corners.size());
    for (std::size_t i = 0; i < corners.size(); ++i)
    {
        const int root = clusters.firstOf(static_cast<int>(i));
        merged[i] = sums[root] / counts[root];
        for (int axis = 0; axis < 2; ++axis)
        {
            merged[i][axis] = extents[root].lower[axis] < same                ? 0
                              : extents[root].upper[axis] > size[axis] - same ? size[axis]
                                                                              : merged[i][axis];
        }
    }
    return merged;
}

/// Corners of all cells that are nearer to each other than `least`, along edges, become one: their mean,
/// which stays on the sides of the rectangle and in its corners. Also makes corners that are the same but for
/// rounding the same.
void mergeShortEdges(std::vector<Polygon>& cells, const Vector<2>& size, double least)
{
    const double same = 1e-9 * size.maxCoeff();
    const std::vector<Vector<2>> corners = cornersOf(cells);
    DisjointSets clusters = clustersOf(cells, corners, same, least);
    const std::vector<Vector<2>> merged = mergedCorners(corners, clusters, size, same);
    std::size_t next = 0;
    for (Polygon& cell : cells)
    {
        Polygon outline;
        for (std::size_t i = 0; i < cell.size(); ++i, ++next)
        {
            if (outline.empty() || outline.back() != merged[next])
            {
                outline.push_back(merged[next]);
            }
        }
        while (outline.size() > 1 && outline.back() == outline.front())
        {
            outline.pop_back();
        }
        cell = std::move(outline);
    }
}

/// The root of the mean area of a stone [m].
double meanSize(const PlaneRubble& rubble)
{
    return std::sqrt(rubble.size.prod() / rubble.stones);
}

} // namespace

void declare(Options& options, PlaneRubble& rubble)
{
    options.required("size", rubble.size, "length and height of the wall, from the origin")
        .unit("m")
        .above(0)
        .example("(3 2)");
    options.optional("thickness", rubble.thickness, "out of plane").unit("m").above(0);
    options.required("stones", rubble.stones, "their number").atLeast(1).atMost(1000000).example("100");
    options.optional("seed", rubble.seed, "of the points: another one gives another wall").atLeast(0);
    options
        .optional("relaxations", rubble.relaxations,
                  "how often points are moved to the centroids of their cells: stones become rounder and "
                  "more equal")
        .atLeast(0)
        .atMost(1000);
    options
        .optional("leastJoint", rubble.leastJoint,
                  "shorter joints shrink to a corner; in mean sizes of a stone")
        .atLeast(0)
        .atMost(0.3);
}

namespace
{

/// The cells of a wall in the order of their points, before and after their short edges are merged.
struct Cells
{
    std::vector<Polygon> whole;
    std::vector<Polygon> merged;
};

Cells cellsOf(const PlaneRubble& rubble)
{
    std::vector<Vector<2>> points;
    for (const Vector<3>& point :
         uniformPoints({rubble.size.x(), rubble.size.y(), 1}, rubble.stones, rubble.seed))
    {
        points.emplace_back(point.head<2>());
    }
    for (int round = 0; round < rubble.relaxations; ++round)
    {
        const std::vector<Polygon> cells = planeCells(rubble.size, points);
        std::transform(cells.begin(), cells.end(), points.begin(),
                       [](const Polygon& cell) { return areaProperties(cell).centroid; });
    }
    Cells cells;
    cells.whole = planeCells(rubble.size, points);
    cells.merged = cells.whole;
    mergeShortEdges(cells.merged, rubble.size, rubble.leastJoint * meanSize(rubble));
    return cells;
}

/// Whether merged edges have left it a face.
bool isStone(const Polygon& cell, const PlaneRubble& rubble)
{
    constexpr double flat = 1e-9; // of a mean stone's face: corners of three that are in a line
    return cell.size() >= 3 && std::abs(areaProperties(cell).area) > flat * std::pow(meanSize(rubble), 2);
}

} // namespace

Assembly<2> makeAssembly(const PlaneRubble& rubble)
{
    Assembly<2> assembly;
    for (Polygon& cell : cellsOf(rubble).merged)
    {
        if (isStone(cell, rubble))
        {
            assembly.blocks.push_back({std::move(cell), rubble.thickness});
        }
    }
    return assembly;
}

std::string lossOfStones(const PlaneRubble& rubble, const Assembly<2>& assembly)
{
    const std::size_t left = assembly.blocks.size();
    if (left >= static_cast<std::size_t>(rubble.stones))
    {
        return "";
    }
    std::vector<std::string> places;
    const Cells cells = cellsOf(rubble);
    for (std::size_t i = 0; i < cells.merged.size(); ++i)
    {
        if (!isStone(cells.merged[i], rubble))
        {
            const Vector<2> place = areaProperties(cells.whole[i]).centroid;
            places.push_back(fmt::format("({:.4g} {:.4g})", place.x(), place.y()));
        }
    }
    return fmt::format(
        "{} of {} stones are left: joints shorter than leastJoint, {:g} of the mean size of a stone, shrink "
        "to a corner, and the other {} had no face any more: {} [m]. Their neighbours take their place, "
        "and blocks are numbered without them. Reduce leastJoint, or give more relaxations, to keep all of "
        "them.",
        left, rubble.stones, rubble.leastJoint, rubble.stones - left, shownList(places, 8));
}

} // namespace drystone
