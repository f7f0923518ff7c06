// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The search for edges that face each other.
#include "contact/Facing.h"

#include "geometry/BroadPhase.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

namespace drystone
{

namespace
{

bool isParallelToAxis(const OutlineEdge& edge)
{
    return edge.from.x() == edge.to.x() || edge.from.y() == edge.to.y();
}

/// The piece that faces both edges, if any. Distances are measured on the line halfway between the two.
bool findPiece(const OutlineEdge& a, const OutlineEdge& b, const FacingTolerance& tolerance,
               FacingPiece& piece)
{
    const bool isOblique = !(isParallelToAxis(a) && isParallelToAxis(b));
    const bool isWider = isOblique && tolerance.oblique > tolerance.distance;
    const double distance = isWider ? tolerance.oblique : tolerance.distance;
    // Both ends of both edges may be off by the distance.
    const double angle =
        isWider ? std::max(tolerance.angle,
                           4 * distance / std::min((a.to - a.from).norm(), (b.to - b.from).norm()))
                : tolerance.angle;
    const Vector<2> alongA = (a.to - a.from).normalized();
    const Vector<2> alongB =
        (b.from - b.to).normalized(); // reversed: outlines pass a joint in opposite directions
    if (alongA.dot(alongB) <= 0 || std::abs(cross(alongA, alongB)) > angle)
    {
        return false;
    }
    const Vector<2> along = (alongA + alongB).normalized();
    const Vector<2> across = perpendicular(along);
    // Coordinates from a.from, so that a structure far from the origin keeps its digits.
    const Vector<2>& origin = a.from;
    const double toA = along.dot(a.to - origin);
    const double fromB = along.dot(b.to - origin);
    const double toB = along.dot(b.from - origin);
    const double begin = std::max(0.0, fromB);
    const double end = std::min(toA, toB);
    if (end - begin <= tolerance.leastLength)
    {
        return false;
    }
    const double endHeightA = across.dot(a.to - origin);
    const double beginHeightB = across.dot(b.to - origin);
    const double endHeightB = across.dot(b.from - origin);
    const auto heightA = [&](double s) { return s / toA * endHeightA; };
    const auto heightB = [&](double s)
    { return beginHeightB + (s - fromB) / (toB - fromB) * (endHeightB - beginHeightB); };
    // An outline runs counter-clockwise, its block on the left: `across` points into a's block, away from
    // b's.
    const double gapAtBegin = heightA(begin) - heightB(begin);
    const double gapAtEnd = heightA(end) - heightB(end);
    if (std::max(std::abs(gapAtBegin), std::abs(gapAtEnd)) > distance)
    {
        return false;
    }
    const auto pointAt = [&](double s) -> Vector<2>
    { return origin + s * along + (heightA(s) + heightB(s)) / 2 * across; };
    piece = {a.block, b.block, pointAt(begin), pointAt(end), across, gapAtBegin, gapAtEnd, -1, -1, isOblique};
    return true;
}

} // namespace

FacingTolerance facingTolerance(double distance, double joint)
{
    FacingTolerance tolerance;
    tolerance.distance = distance;
    tolerance.straight = joint / 2;
    tolerance.leastLength = distance;
    return tolerance;
}

std::vector<OutlineEdge> outlineEdges(const Assembly<2>& assembly, const FacingTolerance& tolerance)
{
    std::vector<OutlineEdge> edges;
    edges.reserve(4 * assembly.blocks.size());
    std::vector<int> corners;
    for (std::size_t block = 0; block < assembly.blocks.size(); ++block)
    {
        const Polygon& outline = assembly.blocks[block].outline;
        const Polygon kept = withoutStraightVertices(outline, tolerance.straight);
        // In the same order, but perhaps from another vertex on.
        corners.clear();
        const auto start = std::find(outline.begin(), outline.end(), kept.front()) - outline.begin();
        for (std::size_t i = 0; i < outline.size() && corners.size() < kept.size(); ++i)
        {
            const std::size_t vertex = (static_cast<std::size_t>(start) + i) % outline.size();
            if (outline[vertex] == kept[corners.size()])
            {
                corners.push_back(static_cast<int>(vertex));
            }
        }
        for (std::size_t i = 0; i < corners.size(); ++i)
        {
            const int first = corners[i];
            const int last = corners[(i + 1) % corners.size()];
            const Vector<2>& from = outline[static_cast<std::size_t>(first)];
            const Vector<2>& to = outline[static_cast<std::size_t>(last)];
            if ((to - from).norm() > tolerance.leastLength)
            {
                edges.push_back({static_cast<int>(block), first, last, from, to});
            }
        }
    }
    return edges;
}

namespace
{

/// The edges of one block whose boxes meet a box. \param first of the edges of each block
void edgesWithin(const BoundingBox& box, const std::vector<BoundingBox>& boxes, const std::vector<int>& first,
                 int block, std::vector<int>& within)
{
    within.clear();
    for (int edge = first[block]; edge < first[block + 1]; ++edge)
    {
        if (meet(boxes[edge], box))
        {
            within.push_back(edge);
        }
    }
}

/// Calls `found` with each pair of edges of two blocks, not both fixed, whose boxes enlarged by `reach` [m]
/// meet, the edge of the block with the lower index first. Boxes of blocks are searched for first: of the
/// pairs that a search among edges finds most are of one outline, edges that share a corner.
template<class Found>
void forMeetingEdges(const Assembly<2>& assembly, const std::vector<OutlineEdge>& edges, double reach,
                     const Found& found)
{
    const std::size_t blocks = assembly.blocks.size();
    std::vector<BoundingBox> boxes;
    boxes.reserve(edges.size());
    std::vector<BoundingBox> boxOfBlock(blocks);
    std::vector<int> first(blocks + 1, 0);
    for (const OutlineEdge& edge : edges) // in block order
    {
        boxes.push_back(enlarged<2>(boxAround<2>(edge.from, edge.to), reach));
        extend<2>(boxOfBlock[edge.block], boxes.back());
        ++first[edge.block + 1];
    }
    std::partial_sum(first.begin(), first.end(), first.begin());

    std::vector<int> ofOne;
    std::vector<int> ofOther;
    for (const auto& [one, other] : findMeetingPairs(boxOfBlock))
    {
        if (assembly.blocks[one].support >= 0 && assembly.blocks[other].support >= 0)
        {
            continue;
        }
        edgesWithin(boxOfBlock[other], boxes, first, one, ofOne);
        edgesWithin(boxOfBlock[one], boxes, first, other, ofOther);
        for (const int a : ofOne)
        {
            for (const int b : ofOther)
            {
                if (meet(boxes[a], boxes[b]))
                {
                    found(a, b);
                }
            }
        }
    }
}

} // namespace

std::vector<FacingPiece> findFacingPieces(const Assembly<2>& assembly, const FacingTolerance& tolerance)
{
    const std::vector<OutlineEdge> edges = outlineEdges(assembly, tolerance);
    const double reach = std::max(tolerance.distance, tolerance.oblique);
    std::vector<FacingPiece> pieces;
    FacingPiece piece;
    forMeetingEdges(assembly, edges, reach,
                    [&](int first, int second)
                    {
                        if (findPiece(edges[first], edges[second], tolerance, piece))
                        {
                            piece.edge = first;
                            piece.neighbourEdge = second;
                            pieces.push_back(piece);
                        }
                    });
    // A fixed order in space, whatever the order of the search.
    std::sort(pieces.begin(), pieces.end(),
              [](const FacingPiece& a, const FacingPiece& b)
              {
                  return std::tuple(a.block, a.neighbour, a.from.x(), a.from.y())
                         < std::tuple(b.block, b.neighbour, b.from.x(), b.from.y());
              });
    return pieces;
}

} // namespace drystone
