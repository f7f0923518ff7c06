// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Corner-edge contacts between placed blocks: neighbour list, points of a pair and measures.
#include "contact/MovingContacts.h"

#include "contact/EdgeNormal.h"
#include "contact/Penetration.h"
#include "geometry/PolygonShape.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <tuple>

namespace drystone
{

namespace
{

/// Overlaps are trusted up to this part of the thinner block: well above any that a step may leave, and below
/// the depth at which a corner is nearer to the far side.
constexpr double deepestPart = 0.25;

/// Indices of the vertices at which the outline turns: those along a straight edge part no joint.
std::vector<int> turningVertices(const Polygon& outline, double tolerance)
{
    const Polygon kept = withoutStraightVertices(outline, tolerance);
    std::vector<int> indices;
    for (std::size_t i = 0; i < outline.size(); ++i)
    {
        const bool isRepeated = outline[i] == outline[(i + 1) % outline.size()];
        if (!isRepeated && std::find(kept.begin(), kept.end(), outline[i]) != kept.end())
        {
            indices.push_back(static_cast<int>(i));
        }
    }
    return indices;
}

} // namespace

MovingContacts<2>::MovingContacts(const Assembly<2>& assembly, const MovingContactOptions& options)
{
    const double size = meanBlockSize(assembly);
    pointTolerance = options.tolerance * size;
    skin = options.skin * size;
    mayEnter = options.mayEnter * size;

    first.push_back(0);
    for (const Block<2>& block : assembly.blocks)
    {
        addBlock(block);
    }
    const std::size_t blocks = assembly.blocks.size();
    for (Outlines* outlines : {&placedNow, &aheadStorage})
    {
        outlines->corner.resize(localCorner.size());
        outlines->tangent.resize(localCorner.size());
        outlines->box.resize(blocks);
    }
    reaches.resize(blocks);
}

void MovingContacts<2>::addBlock(const Block<2>& block)
{
    const Polygon& outline = block.outline;
    const Vector<2> centroid = areaProperties(outline).centroid;
    const std::vector<int> turning = turningVertices(outline, pointTolerance / 2);
    const int begin = first.back();
    const int count = static_cast<int>(turning.size());
    double radius = 0;
    for (int i = 0; i < count; ++i)
    {
        const Vector<2>& before = outline[turning[(i + count - 1) % count]];
        const Vector<2>& here = outline[turning[i]];
        const Vector<2>& after = outline[turning[(i + 1) % count]];
        next.push_back(begin + (i + 1) % count);
        previous.push_back(begin + (i + count - 1) % count);
        vertex.push_back(turning[i]);
        localCorner.push_back(here - centroid);
        edgeLength.push_back((after - here).norm());
        localTangent.push_back((after - here) / edgeLength.back());
        isConvexCorner.push_back(cross(here - before, after - here) > 0);
        radius = std::max(radius, localCorner.back().norm());
    }
    first.push_back(begin + count);
    centroids.push_back(centroid);
    isFixed.push_back(block.support >= 0);
    radii.push_back(radius);
    deepest.push_back(deepestPart * thicknessOf(static_cast<int>(deepest.size())));
    leastDeepest = std::min(leastDeepest, deepest.back());
}

/// Of a convex block the least distance between parallel supports, one of which holds an edge; of a concave
/// one a lower bound, the least distance of a corner from an edge that does not end there.
double MovingContacts<2>::thicknessOf(int block) const
{
    const int begin = first[block];
    const int end = first[block + 1];
    const bool isConvex = std::all_of(isConvexCorner.begin() + begin, isConvexCorner.begin() + end,
                                      [](char isConvexThere) { return isConvexThere; });
    double thickness = std::numeric_limits<double>::max();
    for (int edge = begin; edge < end; ++edge)
    {
        double farthest = 0;
        for (int corner = begin; corner < end; ++corner)
        {
            const Vector<2> arm = localCorner[corner] - localCorner[edge];
            farthest = std::max(farthest, -arm.dot(outwardNormal(localTangent[edge])));
            if (!isConvex && corner != edge && corner != next[edge])
            {
                thickness = std::min(
                    thickness, distance(localCorner[corner], localCorner[edge], localCorner[next[edge]]));
            }
        }
        thickness = std::min(thickness, farthest);
    }
    return thickness;
}

MovingContacts<2>::Rotation::Rotation(const Placement<2>& placement)
    : cosine(std::cos(placement.rotation)), sine(std::sin(placement.rotation))
{
}

void MovingContacts<2>::place(Outlines& outlines, const std::vector<Placement<2>>& placements) const
{
    for (std::size_t b = 0; b < centroids.size(); ++b)
    {
        placeBlock(outlines, static_cast<int>(b), placements[b]);
    }
}

void MovingContacts<2>::placeBlock(Outlines& outlines, int block, const Placement<2>& placement) const
{
    const Rotation turned(placement);
    const Vector<2> centre = centroids[block] + placement.translation;
    BoundingBox box;
    for (int i = first[block]; i < first[block + 1]; ++i)
    {
        const Vector<2> corner = centre + turned(localCorner[i]);
        outlines.corner[i] = corner;
        outlines.tangent[i] = turned(localTangent[i]);
        extend<2>(box, corner);
    }
    outlines.box[block] = box;
}

const std::vector<ContactPoint<2>>& MovingContacts<2>::update(const std::vector<Placement<2>>& now,
                                                              double margin)
{
    assert(now.size() == centroids.size());
    place(placedNow, now);
    placedAhead = &placedNow;
    findNeighbours(margin);
    return found;
}

const std::vector<ContactPoint<2>>& MovingContacts<2>::update(const std::vector<Placement<2>>& now,
                                                              const std::vector<Placement<2>>& ahead,
                                                              double margin)
{
    assert(now.size() == centroids.size() && ahead.size() == centroids.size());
    otherHeadings.clear();
    place(placedNow, now);
    place(aheadStorage, ahead);
    placedAhead = &aheadStorage;
    findNeighbours(margin);
    return found;
}

const std::vector<ContactPoint<2>>&
MovingContacts<2>::update(const std::vector<Placement<2>>& now,
                          const std::vector<std::vector<Placement<2>>>& headings, double margin)
{
    assert(!headings.empty());
    otherHeadings.resize(headings.size() - 1, aheadStorage);
    for (std::size_t other = 1; other < headings.size(); ++other)
    {
        place(otherHeadings[other - 1], headings[other]);
    }
    place(placedNow, now);
    place(aheadStorage, headings.front());
    placedAhead = &aheadStorage;
    findNeighbours(margin);
    return found;
}

void MovingContacts<2>::leaveOut(int block)
{
    leftOut.resize(isFixed.size(), false);
    leftOut[static_cast<std::size_t>(block)] = true;
}

void MovingContacts<2>::findNeighbours(double margin)
{
    bool isCurrent = fat.size() == reaches.size();
    for (std::size_t b = 0; b < reaches.size(); ++b)
    {
        BoundingBox box = placedNow.box[b];
        extend<2>(box, placedAhead->box[b]);
        reaches[b] = enlarged(box, margin / 2);
        isCurrent = isCurrent && contains(fat[b], reaches[b]);
    }
    if (!isCurrent)
    {
        fat.clear();
        for (const BoundingBox& box : reaches)
        {
            fat.push_back(enlarged(box, skin / 2));
        }
        neighbours = findMeetingPairs(fat);
        ++rebuildCount;
    }
    found.clear();
    cornerAndEdge.clear();
    leftAlone.clear();
    joints = 0;
    lastMargin = margin;
    for (const auto& [block, neighbour] : neighbours)
    {
        if (isLookedAt(block, neighbour))
        {
            findPoints(block, neighbour, margin);
        }
    }
}

void MovingContacts<2>::sortCandidates()
{
    std::sort(candidates.begin(), candidates.end(),
              [](const Candidate& a, const Candidate& b)
              {
                  return std::tuple(a.blockEdge(), a.neighbourEdge(), a.owner, a.corner)
                         < std::tuple(b.blockEdge(), b.neighbourEdge(), b.owner, b.corner);
              });
}

void MovingContacts<2>::addFound()
{
    static const ContactPoint<2> blank;
    int lastBlockEdge = -1;
    int lastNeighbourEdge = -1;
    for (const Candidate& candidate : candidates)
    {
        if (candidate.blockEdge() != lastBlockEdge || candidate.neighbourEdge() != lastNeighbourEdge)
        {
            lastBlockEdge = candidate.blockEdge();
            lastNeighbourEdge = candidate.neighbourEdge();
            ++joints;
        }
        const bool cornerIsTheBlocks = candidate.owner == 0;
        cornerAndEdge.emplace_back(candidate.corner, candidate.edge);
        found.push_back(blank); // emplaced, it would be cleared twice
        ContactPoint<2>& point = found.back();
        point.block = pairBlock;
        point.neighbour = pairNeighbour;
        point.joint = joints - 1;
        point.position = placedNow.corner[candidate.corner];
        const Vector<2> normal = outwardNormal(placedNow.tangent[candidate.edge]);
        point.normal = cornerIsTheBlocks ? normal : Vector<2>(-normal);
        point.gap = candidate.gap;
        point.feature = {cornerIsTheBlocks ? pairBlock : pairNeighbour, vertex[candidate.corner],
                         vertex[candidate.edge]};
    }
}

void MovingContacts<2>::findPoints(int block, int neighbour, double margin)
{
    candidates.clear();
    pairBlock = block;
    pairNeighbour = neighbour;
    const double lowest = -std::min(deepest[block], deepest[neighbour]);
    if (pairEdges(block, neighbour, lowest, margin))
    {
        standCorners(0, block, neighbour, lowest, margin);
        standCorners(1, neighbour, block, lowest, margin);
    }
    if (candidates.empty() && placedAhead != &placedNow)
    {
        guardOnEachWay(margin);
    }
    if (candidates.size() > 1)
    {
        dropDeeper();
        sortCandidates();
    }
    addFound();
}

/// Asked of every pair in the list, so that its reserve cannot change the result.
bool MovingContacts<2>::isLookedAt(int block, int neighbour) const
{
    const bool isLeftOut = !leftOut.empty() && (leftOut[block] || leftOut[neighbour]);
    return !isLeftOut && !(isFixed[block] && isFixed[neighbour]) && meet(reaches[block], reaches[neighbour]);
}

Polygon MovingContacts<2>::outlineOf(const Outlines& outlines, int block) const
{
    return {outlines.corner.begin() + first[block], outlines.corner.begin() + first[block + 1]};
}

bool MovingContacts<2>::mayOverlook() const
{
    return lastMargin > leastDeepest || !leftAlone.empty();
}

double MovingContacts<2>::depthGained(const Outlines& there, int block, int neighbour) const
{
    if (!meet(there.box[block], there.box[neighbour]))
    {
        return 0;
    }
    const double depth = overlapDepth(outlineOf(there, block), outlineOf(there, neighbour));
    const bool isGained =
        depth > 0 && depth > overlapDepth(outlineOf(placedNow, block), outlineOf(placedNow, neighbour));
    return isGained ? depth : 0;
}

double MovingContacts<2>::depthAtCorners(const std::vector<Placement<2>>& placements) const
{
    double deepestOfAll = 0;
    if (leftAlone.empty())
    {
        return deepestOfAll;
    }
    Outlines there = placedNow;
    for (const auto& [block, neighbour] : leftAlone)
    {
        placeBlock(there, block, placements[static_cast<std::size_t>(block)]);
        placeBlock(there, neighbour, placements[static_cast<std::size_t>(neighbour)]);
        deepestOfAll = std::max(deepestOfAll, depthGained(there, block, neighbour));
    }
    return deepestOfAll > pointTolerance ? deepestOfAll : 0;
}

bool MovingContacts<2>::findsMoreTowards(const std::vector<Placement<2>>& placements) const
{
    return depthAtCorners(placements) > 0;
}

double MovingContacts<2>::overlookedDepth(const std::vector<Placement<2>>& placements) const
{
    double deepestOfAll = depthAtCorners(placements);
    if (!(lastMargin > leastDeepest))
    {
        return deepestOfAll;
    }
    Outlines there = placedNow;
    place(there, placements);
    for (const auto& [block, neighbour] : neighbours)
    {
        if (lastMargin > std::min(deepest[block], deepest[neighbour]) && isLookedAt(block, neighbour))
        {
            deepestOfAll = std::max(deepestOfAll, depthGained(there, block, neighbour));
        }
    }
    return deepestOfAll;
}

namespace
{

/// The blocks of the corner and of the edge that meet at a point.
std::pair<int, int> blocksOf(const ContactPoint<2>& point)
{
    return point.feature.vertexBlock == point.block ? std::pair{point.block, point.neighbour}
                                                    : std::pair{point.neighbour, point.block};
}

} // namespace

void MovingContacts<2>::measure(const std::vector<Placement<2>>& placements,
                                std::vector<ContactPoint<2>>& points) const
{
    assert(placements.size() == centroids.size());
    points = found;
    std::vector<Rotation> rotations;
    rotations.reserve(placements.size());
    for (const Placement<2>& placement : placements)
    {
        rotations.emplace_back(placement);
    }
    for (std::size_t i = 0; i < points.size(); ++i)
    {
        const auto [cornerBlock, edgeBlock] = blocksOf(found[i]);
        measure(placements, rotations[cornerBlock], rotations[edgeBlock], i, points[i]);
    }
}

ContactPoint<2> MovingContacts<2>::pointAt(const std::vector<Placement<2>>& placements,
                                           std::size_t index) const
{
    ContactPoint<2> point = found[index];
    const auto [cornerBlock, edgeBlock] = blocksOf(point);
    measure(placements, Rotation(placements[cornerBlock]), Rotation(placements[edgeBlock]), index, point);
    return point;
}

void MovingContacts<2>::measure(const std::vector<Placement<2>>& placements, const Rotation& turned,
                                const Rotation& turnedEdge, std::size_t index, ContactPoint<2>& point) const
{
    const auto [corner, edge] = cornerAndEdge[index];
    const auto [cornerBlock, edgeBlock] = blocksOf(point);
    const Vector<2> cornerArm = turned(localCorner[corner]);
    const Vector<2> normal = outwardNormal(turnedEdge(localTangent[edge]));
    // Differences of places first, so that a structure far from the origin keeps its digits.
    const Vector<2> centres = (centroids[cornerBlock] - centroids[edgeBlock])
                              + (placements[cornerBlock].translation - placements[edgeBlock].translation);
    point.gap = (centres + cornerArm - turnedEdge(localCorner[edge])).dot(normal);
    point.position = centroids[cornerBlock] + placements[cornerBlock].translation + cornerArm;
    point.normal = cornerBlock == point.block ? normal : Vector<2>(-normal);
}

double MovingContacts<2>::marginFor(const std::vector<Vector<3>>& velocities, double timeStep,
                                    double acceleration) const
{
    assert(velocities.size() == radii.size());
    double fastest = 0;
    for (std::size_t b = 0; b < radii.size(); ++b)
    {
        fastest = std::max(fastest, velocities[b].head<2>().norm() + std::abs(velocities[b][2]) * radii[b]);
    }
    return 2 * timeStep * (fastest + acceleration * timeStep);
}

} // namespace drystone
