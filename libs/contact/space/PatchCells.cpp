// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Cutting of patches, by indices: cells that share an edge share what cuts it.
#include "contact/space/PatchCells.h"

#include "contact/PointsOfJoints.h"
#include "geometry/Box.h"
#include "geometry/PolygonIntersection.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <utility>

namespace drystone
{
namespace
{

constexpr double samePlace = 1e-9;    ///< relative to the extent of a patch
constexpr double sharedCorner = 1e-8; ///< likewise, of parts whose corners were rounded by the clipping

/// The first corner that turns right; the size of the polygon where it is convex.
std::size_t reentrantCorner(const Polygon& polygon)
{
    const std::size_t size = polygon.size();
    for (std::size_t i = 0; i < size; ++i)
    {
        const Vector<2> in = polygon[i] - polygon[(i + size - 1) % size];
        const Vector<2> out = polygon[(i + 1) % size] - polygon[i];
        if (cross(in, out) < -samePlace * in.norm() * out.norm())
        {
            return i;
        }
    }
    return size;
}

/// Convex parts of a simple counter-clockwise polygon.
void addConvexParts(const Polygon& polygon, double extent, std::vector<Polygon>& parts)
{
    const std::size_t size = polygon.size();
    const std::size_t corner = reentrantCorner(polygon);
    if (corner == size)
    {
        parts.push_back(polygon);
        return;
    }
    // Along the edge that ends there: on either side the corner is convex.
    const Vector<2>& at = polygon[corner];
    const Vector<2> along = 2 * extent * (at - polygon[(corner + size - 1) % size]).normalized();
    const Vector<2> left = perpendicular(along);
    for (const Vector<2>& side : {left, Vector<2>(-left)})
    {
        Polygon half{at - along, at + along, at + along + side, at - along + side};
        if (side == -left)
        {
            std::reverse(half.begin(), half.end());
        }
        for (const Polygon& part : intersection(polygon, half, samePlace * extent))
        {
            // Rounding must not divide for ever.
            if (part.size() < size || reentrantCorner(part) == part.size())
            {
                addConvexParts(part, extent, parts);
            }
            else
            {
                parts.push_back(part);
            }
        }
    }
}

Polygon polygonOf(const PatchCells& patch, const std::vector<int>& cell)
{
    Polygon polygon;
    for (const int vertex : cell)
    {
        polygon.push_back(patch.vertices[vertex]);
    }
    return polygon;
}

/// The index of a vertex at a place: one of the candidates, or else a new one, which is added to them.
int vertexAt(PatchCells& patch, const Vector<2>& place, std::vector<int>& candidates)
{
    const auto found = std::find_if(
        candidates.begin(), candidates.end(),
        [&](int vertex) { return (patch.vertices[vertex] - place).norm() <= sharedCorner * patch.extent; });
    if (found != candidates.end())
    {
        return *found;
    }
    candidates.push_back(static_cast<int>(patch.vertices.size()));
    patch.vertices.push_back(place);
    return candidates.back();
}

PatchCells patchFrom(std::vector<ContactPoint<3>> corners)
{
    PatchCells patch;
    patch.frame = contactFrame(corners.front());
    BoundingBox box;
    for (const ContactPoint<3>& corner : corners)
    {
        const Vector<3> arm = corner.position - corners.front().position;
        patch.vertices.emplace_back(patch.frame.col(1).dot(arm), patch.frame.col(2).dot(arm));
        extend(box, patch.vertices.back());
    }
    patch.extent = (box.upper - box.lower).norm();
    patch.corners = std::move(corners);
    std::vector<int> all;
    for (std::size_t i = 0; i < patch.vertices.size(); ++i)
    {
        all.push_back(static_cast<int>(i));
    }
    if (areaProperties(patch.vertices).area < 0)
    {
        std::reverse(all.begin(), all.end());
    }
    const Polygon outline = polygonOf(patch, all);
    if (reentrantCorner(outline) == outline.size())
    {
        patch.cells = {all};
        return patch;
    }
    std::vector<Polygon> parts;
    addConvexParts(outline, patch.extent, parts);
    for (const Polygon& part : parts)
    {
        std::vector<int> cell;
        for (const Vector<2>& place : part)
        {
            cell.push_back(vertexAt(patch, place, all));
        }
        patch.cells.push_back(std::move(cell));
    }
    return patch;
}

/// A line through a patch, and where it crosses edges.
struct CutLine
{
    std::vector<double> side;                     ///< of each vertex, its distance; 0: on the line [m]
    std::vector<int> onLine;                      ///< vertices there
    std::map<std::pair<int, int>, int> crossings; ///< vertex in an edge, by its ends, lower index first
};

CutLine lineAcross(const PatchCells& patch, const Vector<2>& normal, double offset)
{
    CutLine line;
    for (const Vector<2>& vertex : patch.vertices)
    {
        const double distance = normal.dot(vertex) - offset;
        if (std::abs(distance) <= samePlace * patch.extent)
        {
            line.onLine.push_back(static_cast<int>(line.side.size()));
            line.side.push_back(0);
        }
        else
        {
            line.side.push_back(distance);
        }
    }
    return line;
}

/// The vertex where the line crosses an edge: cells that share the edge share it.
int crossingOf(CutLine& line, int from, int to, PatchCells& patch)
{
    const auto [lower, upper] = std::minmax(from, to);
    const auto [entry, isNew] = line.crossings.try_emplace({lower, upper}, 0);
    if (isNew)
    {
        // Of a concave patch edges may lie on parts of others, whose vertices are not their own.
        const double share = line.side[lower] / (line.side[lower] - line.side[upper]);
        entry->second =
            vertexAt(patch, (1 - share) * patch.vertices[lower] + share * patch.vertices[upper], line.onLine);
    }
    return entry->second;
}

/// The parts of a cell before and beyond a line that cuts it.
std::pair<std::vector<int>, std::vector<int>> partsOf(const std::vector<int>& cell, CutLine& line,
                                                      PatchCells& patch)
{
    std::vector<int> before;
    std::vector<int> beyond;
    for (std::size_t i = 0; i < cell.size(); ++i)
    {
        const int from = cell[i];
        const int to = cell[(i + 1) % cell.size()];
        if (line.side[from] <= 0)
        {
            before.push_back(from);
        }
        if (line.side[from] >= 0)
        {
            beyond.push_back(from);
        }
        if (line.side[from] * line.side[to] < 0)
        {
            const int between = crossingOf(line, from, to, patch);
            before.push_back(between);
            beyond.push_back(between);
        }
    }
    return {std::move(before), std::move(beyond)};
}

} // namespace

std::vector<PatchCells> patchCells(const std::vector<ContactPoint<3>>& corners)
{
    std::vector<PatchCells> patches;
    for (const PointRange& joint : pointsOfJoints(corners))
    {
        const ContactPoint<3>* first = &corners[joint.begin];
        patches.push_back(patchFrom({first, first + joint.size()}));
    }
    return patches;
}

bool cutAlong(PatchCells& patch, const Vector<2>& normal, double offset)
{
    CutLine line = lineAcross(patch, normal, offset);
    std::vector<std::vector<int>> cells;
    for (std::vector<int>& cell : patch.cells)
    {
        const auto [lowest, highest] = std::minmax_element(
            cell.begin(), cell.end(), [&](int one, int two) { return line.side[one] < line.side[two]; });
        if (line.side[*lowest] >= 0 || line.side[*highest] <= 0)
        {
            cells.push_back(std::move(cell));
            continue;
        }
        auto [before, beyond] = partsOf(cell, line, patch);
        cells.push_back(std::move(before));
        cells.push_back(std::move(beyond));
    }
    const bool isCut = cells.size() > patch.cells.size();
    patch.cells = std::move(cells);
    return isCut;
}

void cutIntoGrid(PatchCells& patch, int perSide)
{
    Vector<2> along(1, 0);
    double longest = 0;
    const std::size_t corners = patch.corners.size();
    for (std::size_t i = 0; i < corners; ++i)
    {
        const Vector<2> edge = patch.vertices[(i + 1) % corners] - patch.vertices[i];
        // Of edges that are equally long the first counts, whatever rounding says.
        if (edge.norm() > longest * (1 + 1e-9))
        {
            longest = edge.norm();
            along = edge / longest;
        }
    }
    for (const Vector<2>& normal : {along, perpendicular(along)})
    {
        double lower = 1e300;
        double upper = -1e300;
        for (const Vector<2>& vertex : patch.vertices)
        {
            lower = std::min(lower, normal.dot(vertex));
            upper = std::max(upper, normal.dot(vertex));
        }
        for (int i = 1; i + 1 < perSide; ++i)
        {
            cutAlong(patch, normal, lower + (upper - lower) * i / (perSide - 1));
        }
    }
}

void divideCells(PatchCells& patch, const std::vector<char>& isDivided)
{
    std::vector<int> all(patch.vertices.size());
    std::iota(all.begin(), all.end(), 0);
    std::vector<std::vector<int>> cells;
    for (std::size_t i = 0; i < patch.cells.size(); ++i)
    {
        const std::vector<int>& cell = patch.cells[i];
        if (!isDivided[i])
        {
            cells.push_back(cell);
            continue;
        }
        const int centre = vertexAt(patch, areaProperties(polygonOf(patch, cell)).centroid, all);
        std::vector<int> middles; // of the edge from each corner to the next
        for (std::size_t k = 0; k < cell.size(); ++k)
        {
            const Vector<2>& to = patch.vertices[cell[(k + 1) % cell.size()]];
            middles.push_back(vertexAt(patch, Vector<2>((patch.vertices[cell[k]] + to) / 2), all));
        }
        for (std::size_t k = 0; k < cell.size(); ++k)
        {
            cells.push_back({cell[k], middles[k], centre, middles[(k + cell.size() - 1) % cell.size()]});
        }
    }
    patch.cells = std::move(cells);
}

std::vector<double> vertexAreas(const PatchCells& patch)
{
    std::vector<double> areas(patch.vertices.size(), 0);
    for (const std::vector<int>& cell : patch.cells)
    {
        const Vector<2> centroid = areaProperties(polygonOf(patch, cell)).centroid;
        for (std::size_t i = 0; i < cell.size(); ++i)
        {
            const int from = cell[i];
            const int to = cell[(i + 1) % cell.size()];
            const double part =
                std::abs(cross(patch.vertices[from] - centroid, patch.vertices[to] - centroid)) / 2;
            areas[from] += part / 2;
            areas[to] += part / 2;
        }
    }
    return areas;
}

std::vector<ContactPoint<3>> pointsOf(const std::vector<PatchCells>& patches)
{
    std::vector<ContactPoint<3>> points;
    for (const PatchCells& patch : patches)
    {
        points.insert(points.end(), patch.corners.begin(), patch.corners.end());
        for (std::size_t i = patch.corners.size(); i < patch.vertices.size(); ++i)
        {
            ContactPoint<3> point = patch.corners.front();
            point.position +=
                patch.vertices[i].x() * patch.frame.col(1) + patch.vertices[i].y() * patch.frame.col(2);
            points.push_back(point);
        }
    }
    return points;
}

std::vector<double> areasOf(const std::vector<PatchCells>& patches)
{
    std::vector<double> areas;
    for (const PatchCells& patch : patches)
    {
        const std::vector<double> ofPatch = vertexAreas(patch);
        areas.insert(areas.end(), ofPatch.begin(), ofPatch.end());
    }
    return areas;
}

} // namespace drystone
