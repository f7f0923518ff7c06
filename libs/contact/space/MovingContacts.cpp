// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Contacts in space that are followed, and the ends of that.
#include "contact/space/MovingContacts.h"

#include "contact/AlmostJoints.h"
#include "core/Error.h"
#include "geometry/BroadPhase.h"
#include "geometry/Rotation.h"
#include "geometry/space/PolyhedronOverlap.h"

#include <Eigen/Geometry>
#include <fmt/format.h>

#include <algorithm>
#include <limits>

namespace drystone
{
namespace
{

/// In mean block sizes: how far a corner may leave its face, how far blocks may enter each other.
constexpr double mayLeave = 0.05;
constexpr double mayEnter = 1e-3;

constexpr double sameVertex = 1e-6; // in mean block sizes

/// Corners of two blocks this close, in mean block sizes, are at one place: rounding errors do not decide
/// between them.
constexpr double cornersAtOnePlace = 1e-9;

/// \param sense 1: by which the blocks have turned; -1: back to where they were built
std::vector<Swing<3>> swingsOf(const std::vector<Placement<3>>& placements, double sense)
{
    std::vector<Swing<3>> swings;
    swings.reserve(placements.size());
    for (const Placement<3>& placement : placements)
    {
        swings.emplace_back(sense * placement.rotation);
    }
    return swings;
}

bool isVertex(const Polyhedron& shape, const Vector<3>& point, double reach)
{
    return std::any_of(shape.vertices.begin(), shape.vertices.end(),
                       [&](const Vector<3>& vertex) { return (vertex - point).norm() <= reach; });
}

/// How far a point of the plane of a face is outside its outline, corners against the clock seen from
/// outside; for a concave one at most that [m].
double distanceOutside(const std::vector<Vector<3>>& outline, const Vector<3>& outward,
                       const Vector<3>& point)
{
    double nearest = std::numeric_limits<double>::infinity();
    bool isInside = false;
    const Eigen::Vector3d along = outward.unitOrthogonal();
    const Eigen::Vector3d across = outward.cross(along);
    const auto flat = [&](const Vector<3>& p) { return Vector<2>(p.dot(along), p.dot(across)); };
    const Vector<2> here = flat(point);
    for (std::size_t i = 0; i < outline.size(); ++i)
    {
        const Vector<2> from = flat(outline[i]);
        const Vector<2> to = flat(outline[(i + 1) % outline.size()]);
        const Vector<2> edge = to - from;
        const double part = std::clamp((here - from).dot(edge) / edge.squaredNorm(), 0.0, 1.0);
        nearest = std::min(nearest, (here - from - part * edge).norm());
        if ((from.y() > here.y()) != (to.y() > here.y())
            && here.x() < from.x() + (here.y() - from.y()) / edge.y() * edge.x())
        {
            isInside = !isInside;
        }
    }
    return isInside ? 0 : nearest;
}

/// The face of a block that a point lies on and that looks in a direction.
const std::vector<int>& faceUnder(const Polyhedron& shape, const Vector<3>& point, const Vector<3>& outward)
{
    const std::vector<int>* best = nullptr;
    double least = std::numeric_limits<double>::infinity();
    for (const std::vector<int>& face : shape.faces)
    {
        const Vector<3> normal = areaVector(shape, face).normalized();
        std::vector<Vector<3>> outline;
        for (const int vertex : face)
        {
            outline.push_back(shape.vertices[static_cast<std::size_t>(vertex)]);
        }
        const double away = std::abs(normal.dot(point - outline.front()))
                            + distanceOutside(outline, normal, point) + (normal - outward).norm();
        if (away < least)
        {
            least = away;
            best = &face;
        }
    }
    return *best;
}

} // namespace

MovingContacts<3>::MovingContacts(const Assembly<3>& structure, const MovingContactOptions&)
    : assembly(structure),
      asBuilt(findContactPoints(structure)),
      isLeftOut(structure.blocks.size(), false),
      blockSize(meanBlockSize(structure))
{
    for (const Block<3>& block : assembly.blocks)
    {
        centroids.push_back(volumeProperties(block.shape).centroid);
    }
    for (ContactPoint<3>& point : asBuilt)
    {
        const auto isVertexOf = [&](int block)
        {
            return isVertex(assembly.blocks[static_cast<std::size_t>(block)].shape, point.position,
                            sameVertex * blockSize);
        };
        const bool isOfNeighbour = isVertexOf(point.neighbour);
        const bool isOfBlock = isVertexOf(point.block) || !isOfNeighbour;
        point.feature = {isOfBlock ? point.block : point.neighbour, static_cast<int>(pairs.size()),
                         0}; // each point is itself
        pairs.push_back(pairAt(point, !isOfBlock));
        others.push_back(isOfBlock && isOfNeighbour ? std::optional(pairAt(point, true)) : std::nullopt);
        known.emplace_back(point.block, point.neighbour);
    }
    std::sort(known.begin(), known.end());
    known.erase(std::unique(known.begin(), known.end()), known.end());
    points = asBuilt;
}

/// \param isOfNeighbour whose corner, against the face of the other
MovingContacts<3>::Pair MovingContacts<3>::pairAt(const ContactPoint<3>& point, bool isOfNeighbour) const
{
    Pair pair;
    pair.cornerBlock = isOfNeighbour ? point.neighbour : point.block;
    pair.faceBlock = isOfNeighbour ? point.block : point.neighbour;
    pair.corner = point.position;
    pair.outward = isOfNeighbour ? Vector<3>(-point.normal) : point.normal;
    pair.shear = contactFrame(point).col(1);
    const Polyhedron& shape = assembly.blocks[static_cast<std::size_t>(pair.faceBlock)].shape;
    for (const int vertex : faceUnder(shape, point.position, pair.outward))
    {
        pair.outline.push_back(shape.vertices[static_cast<std::size_t>(vertex)]);
    }
    return pair;
}

void MovingContacts<3>::measure(const std::vector<Placement<3>>& placements,
                                std::vector<ContactPoint<3>>& measured) const
{
    const std::vector<Swing<3>> swings = swingsOf(placements, 1);
    measured.resize(points.size());
    for (std::size_t i = 0; i < points.size(); ++i)
    {
        const Pair& pair = pairOf(points[i]);
        measured[i] = pointAt(placements, swings[static_cast<std::size_t>(pair.cornerBlock)],
                              swings[static_cast<std::size_t>(pair.faceBlock)], i);
    }
}

ContactPoint<3> MovingContacts<3>::pointAt(const std::vector<Placement<3>>& placements,
                                           std::size_t index) const
{
    const Pair& pair = pairOf(points[index]);
    return pointAt(placements, Swing<3>(placements[static_cast<std::size_t>(pair.cornerBlock)].rotation),
                   Swing<3>(placements[static_cast<std::size_t>(pair.faceBlock)].rotation), index);
}

ContactPoint<3> MovingContacts<3>::pointAt(const std::vector<Placement<3>>& placements,
                                           const Swing<3>& swingOfCorner, const Swing<3>& swingOfFace,
                                           std::size_t index) const
{
    ContactPoint<3> point = points[index];
    const Pair& pair = pairOf(point);
    const auto cornerBlock = static_cast<std::size_t>(pair.cornerBlock);
    const auto faceBlock = static_cast<std::size_t>(pair.faceBlock);
    const Vector<3> outward = pair.outward + swingOfFace(pair.outward);
    // Corner and face coincide as built: the gap is what they have moved by, to the last digits.
    const Vector<3> cornerMoves =
        placements[cornerBlock].translation + swingOfCorner(pair.corner - centroids[cornerBlock]);
    const Vector<3> faceMoves =
        placements[faceBlock].translation + swingOfFace(pair.corner - centroids[faceBlock]);
    point.position = pair.corner + cornerMoves;
    point.gap = outward.dot(cornerMoves - faceMoves);
    point.normal = pair.cornerBlock == point.block ? outward : Vector<3>(-outward);
    point.tangent1 = pair.shear + swingOfFace(pair.shear);
    return point;
}

const std::vector<ContactPoint<3>>& MovingContacts<3>::update(const std::vector<Placement<3>>& now, double)
{
    points.clear();
    for (const ContactPoint<3>& point : asBuilt)
    {
        if (!isLeftOut[static_cast<std::size_t>(point.block)]
            && !isLeftOut[static_cast<std::size_t>(point.neighbour)])
        {
            points.push_back(point);
        }
    }
    const std::vector<Swing<3>> back = swingsOf(now, -1);
    chooseCorners(now, back);
    measure(now, points);
    refuseLostPoints(now, back);
    refuseNewContacts(now);
    return points;
}

const std::vector<ContactPoint<3>>& MovingContacts<3>::update(const std::vector<Placement<3>>& now,
                                                              const std::vector<Placement<3>>&, double margin)
{
    return update(now, margin);
}

/// How far a point of the corner is outside the face now [m]. \param back turns of the blocks to where they
/// were built
double MovingContacts<3>::outsideOf(const Pair& pair, const Vector<3>& place,
                                    const std::vector<Placement<3>>& now,
                                    const std::vector<Swing<3>>& back) const
{
    const auto face = static_cast<std::size_t>(pair.faceBlock);
    const Vector<3> arm = place - centroids[face] - now[face].translation;
    return distanceOutside(pair.outline, pair.outward, centroids[face] + arm + back[face](arm));
}

/// Of two corners that were at one place the one that lies on the other's face: once they have slid past each
/// other the patch ends there, and a joint that turns opens by what is beyond it.
void MovingContacts<3>::chooseCorners(const std::vector<Placement<3>>& now, const std::vector<Swing<3>>& back)
{
    const std::vector<Swing<3>> forth = swingsOf(now, 1);
    const auto outside = [&](const Pair& pair)
    {
        const auto corner = static_cast<std::size_t>(pair.cornerBlock);
        const Vector<3> moves = now[corner].translation + forth[corner](pair.corner - centroids[corner]);
        return outsideOf(pair, pair.corner + moves, now, back);
    };
    for (ContactPoint<3>& point : points)
    {
        const auto index = static_cast<std::size_t>(point.feature.vertex);
        if (others[index] && outside(*others[index]) < outside(pairs[index]) - cornersAtOnePlace * blockSize)
        {
            point.feature.vertexBlock = others[index]->cornerBlock;
        }
    }
}

void MovingContacts<3>::refuseLostPoints(const std::vector<Placement<3>>& now,
                                         const std::vector<Swing<3>>& back) const
{
    for (const ContactPoint<3>& point : points)
    {
        if (point.gap > mayEnter * blockSize)
        {
            continue; // apart
        }
        const Pair& pair = pairOf(point);
        const double outside = outsideOf(pair, point.position, now, back);
        if (outside > mayLeave * blockSize)
        {
            throw FatalError(fmt::format(
                "A corner of {} has left the face of {} that it was built on by {:.3g} m. Motion in space "
                "follows the contact points of the start and does not find new ones: it ends here.",
                blockName(assembly, pair.cornerBlock), blockName(assembly, pair.faceBlock), outside));
        }
    }
}

void MovingContacts<3>::refuseNewContacts(const std::vector<Placement<3>>& now) const
{
    std::vector<Box<3>> boxes;
    for (std::size_t block = 0; block < now.size(); ++block)
    {
        const Swing<3> swing(now[block].rotation);
        Box<3> box;
        for (const Vector<3>& vertex : assembly.blocks[block].shape.vertices)
        {
            extend(box, Vector<3>(vertex + now[block].translation + swing(vertex - centroids[block])));
        }
        boxes.push_back(isLeftOut[block] ? Box<3>() : enlarged(box, -mayEnter * blockSize));
    }
    for (const auto& [block, neighbour] : findMeetingPairs(boxes))
    {
        const Block<3>& one = assembly.blocks[static_cast<std::size_t>(block)];
        const Block<3>& other = assembly.blocks[static_cast<std::size_t>(neighbour)];
        const bool isKnown = std::binary_search(known.begin(), known.end(), std::pair(block, neighbour));
        if (isKnown || (one.support >= 0 && other.support >= 0))
        {
            continue;
        }
        const double depth = overlapDepth(placedShape(one, now[static_cast<std::size_t>(block)]),
                                          placedShape(other, now[static_cast<std::size_t>(neighbour)]));
        if (depth > mayEnter * blockSize)
        {
            throw FatalError(fmt::format(
                "{} and {}, which shared no contact point at the start, have run into each other ({:.3g} m "
                "deep). Motion in space follows the contact points of the start and does not find new ones: "
                "it ends here.",
                blockName(assembly, block), blockName(assembly, neighbour), depth));
        }
    }
}

void MovingContacts<3>::leaveOut(int block)
{
    isLeftOut[static_cast<std::size_t>(block)] = true;
}

} // namespace drystone
