// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Overlap of placed blocks by separating axes.
#include "contact/Penetration.h"

#include "geometry/BroadPhase.h"
#include "geometry/PolygonShape.h"

#include <algorithm>
#include <limits>

namespace drystone
{

namespace
{

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

double deepestVertex(const Polygon& of, const Polygon& in)
{
    double deepest = 0;
    for (const Vector<2>& vertex : of)
    {
        deepest = std::max(deepest, -signedDistance(in, vertex));
    }
    return deepest;
}

} // namespace

double overlapDepth(const Polygon& a, const Polygon& b)
{
    if (isConvex(a) && isConvex(b))
    {
        return overlapOfConvex(a, b);
    }
    double depth = std::max(deepestVertex(a, b), deepestVertex(b, a));
    const std::vector<Polygon> partsOfA = convexParts(a);
    const std::vector<Polygon> partsOfB = convexParts(b);
    for (const Polygon& partOfA : partsOfA)
    {
        for (const Polygon& partOfB : partsOfB)
        {
            depth = std::max(depth, overlapOfConvex(partOfA, partOfB));
        }
    }
    return depth;
}

Penetration penetration(const Assembly<2>& assembly, const std::vector<Placement<2>>& placements)
{
    std::vector<Polygon> outlines;
    std::vector<BoundingBox> boxes;
    outlines.reserve(assembly.blocks.size());
    boxes.reserve(assembly.blocks.size());
    for (std::size_t b = 0; b < assembly.blocks.size(); ++b)
    {
        outlines.push_back(placedOutline(assembly.blocks[b], placements[b]));
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
