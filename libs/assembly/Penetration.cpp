// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Overlap of placed blocks by separating axes.
#include "assembly/Penetration.h"

#include "geometry/BroadPhase.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace drystone
{

namespace
{

bool isConvex(const Polygon& polygon)
{
    const std::size_t size = polygon.size();
    for (std::size_t i = 0; i < size; ++i)
    {
        const Vector<2> arriving = polygon[(i + 1) % size] - polygon[i];
        const Vector<2> leaving = polygon[(i + 2) % size] - polygon[(i + 1) % size];
        if (cross(arriving, leaving) < -1e-12 * arriving.norm() * leaving.norm())
        {
            return false;
        }
    }
    return true;
}

/// Largest distance, over the edges of `a`, by which all of `b` lies outside the edge; negative when none
/// parts them.
double separationByEdgesOf(const Polygon& a, const Polygon& b)
{
    double largest = -std::numeric_limits<double>::max();
    for (std::size_t i = 0; i < a.size(); ++i)
    {
        const Vector<2> edge = a[(i + 1) % a.size()] - a[i];
        const double length = edge.norm();
        if (length == 0)
        {
            continue;
        }
        const Vector<2> normal(edge.y() / length, -edge.x() / length);
        double least = std::numeric_limits<double>::max();
        for (const Vector<2>& vertex : b)
        {
            least = std::min(least, (vertex - a[i]).dot(normal));
        }
        largest = std::max(largest, least);
    }
    return largest;
}

/// Theorem of the separating axis: two convex polygons are apart exactly if an edge of one of them parts
/// them, and the shortest way out is along the normal of the edge that comes nearest to parting them.
double overlapOfConvex(const Polygon& a, const Polygon& b)
{
    return std::max(0.0, -std::max(separationByEdgesOf(a, b), separationByEdgesOf(b, a)));
}

bool isInTriangle(const Vector<2>& p, const Vector<2>& a, const Vector<2>& b, const Vector<2>& c)
{
    return cross(b - a, p - a) >= 0 && cross(c - b, p - b) >= 0 && cross(a - c, p - c) >= 0;
}

/// Triangles that make up a simple counter-clockwise polygon: cuts off one ear after the other.
std::vector<Polygon> triangles(Polygon rest)
{
    std::vector<Polygon> parts;
    while (rest.size() > 3)
    {
        const std::size_t size = rest.size();
        std::size_t ear = size;
        for (std::size_t i = 0; i < size && ear == size; ++i)
        {
            const Vector<2>& before = rest[(i + size - 1) % size];
            const Vector<2>& after = rest[(i + 1) % size];
            if (cross(rest[i] - before, after - rest[i]) <= 0)
            {
                continue;
            }
            const bool holdsAnother = std::any_of(rest.begin(), rest.end(),
                                                  [&](const Vector<2>& vertex)
                                                  {
                                                      return vertex != before && vertex != rest[i]
                                                             && vertex != after
                                                             && isInTriangle(vertex, before, rest[i], after);
                                                  });
            if (!holdsAnother)
            {
                ear = i;
            }
        }
        if (ear == size)
        {
            break; // what is left has no area but for rounding errors
        }
        parts.push_back({rest[(ear + size - 1) % size], rest[ear], rest[(ear + 1) % size]});
        rest.erase(rest.begin() + static_cast<std::ptrdiff_t>(ear));
    }
    if (rest.size() == 3)
    {
        parts.push_back(rest);
    }
    return parts;
}

bool isInside(const Vector<2>& point, const Polygon& polygon)
{
    bool inside = false;
    for (std::size_t i = 0, j = polygon.size() - 1; i < polygon.size(); j = i++)
    {
        const Vector<2>& a = polygon[i];
        const Vector<2>& b = polygon[j];
        if ((a.y() > point.y()) != (b.y() > point.y())
            && point.x() < a.x() + (point.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x()))
        {
            inside = !inside;
        }
    }
    return inside;
}

double distanceToOutline(const Vector<2>& point, const Polygon& polygon)
{
    double least = std::numeric_limits<double>::max();
    for (std::size_t i = 0; i < polygon.size(); ++i)
    {
        const Vector<2> edge = polygon[(i + 1) % polygon.size()] - polygon[i];
        const double squared = edge.squaredNorm();
        const double at = squared > 0 ? std::clamp((point - polygon[i]).dot(edge) / squared, 0.0, 1.0) : 0;
        least = std::min(least, (point - polygon[i] - at * edge).norm());
    }
    return least;
}

double deepestVertex(const Polygon& of, const Polygon& in)
{
    double deepest = 0;
    for (const Vector<2>& vertex : of)
    {
        if (isInside(vertex, in))
        {
            deepest = std::max(deepest, distanceToOutline(vertex, in));
        }
    }
    return deepest;
}

} // namespace

double overlapDepth(const Polygon& a, const Polygon& b)
{
    const bool aIsConvex = isConvex(a);
    const bool bIsConvex = isConvex(b);
    if (aIsConvex && bIsConvex)
    {
        return overlapOfConvex(a, b);
    }
    double depth = std::max(deepestVertex(a, b), deepestVertex(b, a));
    const std::vector<Polygon> partsOfA = aIsConvex ? std::vector<Polygon>{a} : triangles(a);
    const std::vector<Polygon> partsOfB = bIsConvex ? std::vector<Polygon>{b} : triangles(b);
    for (const Polygon& partOfA : partsOfA)
    {
        for (const Polygon& partOfB : partsOfB)
        {
            depth = std::max(depth, overlapOfConvex(partOfA, partOfB));
        }
    }
    return depth;
}

Polygon placed(const Polygon& outline, const Vector<2>& centre, const Placement<2>& placement)
{
    const double cosine = std::cos(placement.rotation);
    const double sine = std::sin(placement.rotation);
    const Vector<2> moved = centre + placement.translation;
    Polygon result;
    result.reserve(outline.size());
    for (const Vector<2>& vertex : outline)
    {
        const Vector<2> arm = vertex - centre;
        result.emplace_back(moved.x() + (cosine * arm.x() - sine * arm.y()),
                            moved.y() + (sine * arm.x() + cosine * arm.y()));
    }
    return result;
}

Penetration penetration(const Assembly<2>& assembly, const std::vector<Placement<2>>& placements)
{
    std::vector<Polygon> outlines;
    std::vector<BoundingBox> boxes;
    outlines.reserve(assembly.blocks.size());
    boxes.reserve(assembly.blocks.size());
    for (std::size_t b = 0; b < assembly.blocks.size(); ++b)
    {
        const Polygon& outline = assembly.blocks[b].outline;
        outlines.push_back(placed(outline, areaProperties(outline).centroid, placements[b]));
        boxes.push_back(boundingBox(outlines.back()));
    }
    Penetration deepest;
    for (const auto& [block, neighbour] : findMeetingPairs(boxes))
    {
        if (assembly.blocks[block].support >= 0 && assembly.blocks[neighbour].support >= 0)
        {
            continue;
        }
        const double depth = overlapDepth(outlines[block], outlines[neighbour]);
        if (depth > deepest.depth)
        {
            deepest = {depth, block, neighbour};
        }
    }
    return deepest;
}

} // namespace drystone
