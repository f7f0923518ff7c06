// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Contacts in space: those as built, and where they are followed. Those that are found are in
/// FoundContacts.cpp.
#include "contact/space/MovingContacts.h"

#include "contact/AlmostJoints.h"
#include "core/Error.h"
#include "geometry/BroadPhase.h"
#include "geometry/Rotation.h"
#include "geometry/space/ConvexParts.h"
#include "geometry/space/PolyhedronOverlap.h"

#include <Eigen/Geometry>
#include <fmt/format.h>

#include <algorithm>
#include <limits>

namespace drystone
{
namespace
{

/// In mean block sizes: how far a corner of convex blocks may leave the face that it was built on and still
/// be followed, and that of others before a run ends.
constexpr double mayLeave = 1e-3;
constexpr double othersMayLeave = 0.05;

/// Beyond this turn other corners of convex blocks may touch than those of the face that lay on the other
/// [rad].
constexpr double mayTurn = 0.1;

/// In mean block sizes: how far blocks that are followed may enter each other before a run ends.
constexpr double mayEnter = 1e-3;

/// Blocks of more convex parts are followed only.
constexpr std::size_t mostParts = 100;

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

/// A block as convex solids. \param within by which vertices may be off a plane [m] \return empty where they
/// are too many, or have more edges than can be distinguished
std::vector<ConvexSolid> solidsOf(const Polyhedron& shape, double within, std::size_t mostEdges)
{
    std::vector<ConvexSolid> solids;
    std::size_t edges = 0;
    for (const Polyhedron& part :
         isConvex(shape, within) ? std::vector<Polyhedron>{shape} : convexParts(shape, within, mostParts))
    {
        solids.push_back(convexSolid(part, within));
        edges += solids.back().edges.size();
    }
    return edges < mostEdges ? solids : std::vector<ConvexSolid>();
}

} // namespace

MovingContacts<3>::MovingContacts(const Assembly<3>& structure, const MovingContactOptions& options)
    : assembly(structure),
      asBuilt(findContactPoints(structure)),
      isLeftOut(structure.blocks.size(), false),
      blockSize(meanBlockSize(structure)),
      tolerance(options.tolerance * blockSize),
      mayEnterFound(options.mayEnter * blockSize),
      edgesAlongFaces(options.edgesAlongFaces)
{
    for (const Block<3>& block : assembly.blocks)
    {
        centroids.push_back(volumeProperties(block.shape).centroid);
        double radius = 0;
        for (const Vector<3>& vertex : block.shape.vertices)
        {
            radius = std::max(radius, (vertex - centroids.back()).norm());
        }
        radii.push_back(radius);
        // Faces that are even to so many digits only, as they were written, are plane: vertices of others may
        // be beyond a plane by some times as much.
        constexpr double timesUneven = 3;
        tolerances.push_back(std::max(tolerance, timesUneven * unevenness(block.shape)));
        solids.push_back(solidsOf(block.shape, tolerances.back(), mostFeatures));
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
        const int cornerBlock = isOfBlock ? point.block : point.neighbour;
        point.feature = {cornerBlock, static_cast<int>(pairs.size()), 0}; // each point is itself
        pairs.push_back(pairAt(point, cornerBlock));
        others.push_back(isOfBlock && isOfNeighbour ? std::optional(pairAt(point, point.neighbour))
                                                    : std::nullopt);
        const std::size_t index = pairs.size() - 1;
        if (known.empty() || known.back().block != point.block || known.back().neighbour != point.neighbour)
        {
            known.push_back({point.block, point.neighbour, index, index, {}});
        }
        ++known.back().end;
    }
    points = asBuilt;
    foundIndex.assign(points.size(), -1);
    for (KnownPair& pair : known)
    {
        findBuiltParts(pair);
    }
    atEdges = pairsAtEdges();
}

/// \param cornerBlock that of the two blocks of the point whose corner stands against a face of the other
MovingContacts<3>::Pair MovingContacts<3>::pairAt(const ContactPoint<3>& point, int cornerBlock) const
{
    const bool isOfBlock = cornerBlock == point.block;
    Pair pair;
    pair.cornerBlock = cornerBlock;
    pair.faceBlock = isOfBlock ? point.neighbour : point.block;
    pair.corner = point.position;
    pair.onFace = point.position;
    pair.outward = isOfBlock ? point.normal : Vector<3>(-point.normal);
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
        const Pair& pair = pairOf(i);
        measured[i] = pointAt(placements, swings[static_cast<std::size_t>(pair.cornerBlock)],
                              swings[static_cast<std::size_t>(pair.faceBlock)], i);
    }
}

ContactPoint<3> MovingContacts<3>::pointAt(const std::vector<Placement<3>>& placements,
                                           std::size_t index) const
{
    const Pair& pair = pairOf(index);
    return pointAt(placements, Swing<3>(placements[static_cast<std::size_t>(pair.cornerBlock)].rotation),
                   Swing<3>(placements[static_cast<std::size_t>(pair.faceBlock)].rotation), index);
}

ContactPoint<3> MovingContacts<3>::pointAt(const std::vector<Placement<3>>& placements,
                                           const Swing<3>& swingOfCorner, const Swing<3>& swingOfFace,
                                           std::size_t index) const
{
    return measured(points[index], pairOf(index), placements, swingOfCorner, swingOfFace);
}

ContactPoint<3> MovingContacts<3>::measured(ContactPoint<3> point, const Pair& pair,
                                            const std::vector<Placement<3>>& placements,
                                            const Swing<3>& swingOfCorner, const Swing<3>& swingOfFace) const
{
    const auto cornerBlock = static_cast<std::size_t>(pair.cornerBlock);
    const auto faceBlock = static_cast<std::size_t>(pair.faceBlock);
    Vector<3> outward = pair.outward + swingOfFace(pair.outward);
    // Corner and face of a point that is followed coincide as built: the gap is what they have moved by, to
    // the last digits.
    const Vector<3> cornerMoves =
        placements[cornerBlock].translation + swingOfCorner(pair.corner - centroids[cornerBlock]);
    const Vector<3> faceMoves =
        placements[faceBlock].translation + swingOfFace(pair.onFace - centroids[faceBlock]);
    const Vector<3> between = pair.corner - pair.onFace + (cornerMoves - faceMoves);
    point.position = pair.corner + cornerMoves;
    point.tangent1 = pair.shear + swingOfFace(pair.shear);
    if (!pair.edge.isZero(0))
    {
        const Vector<3> edge = pair.edge + swingOfCorner(pair.edge);
        const Vector<3> other = pair.otherEdge + swingOfFace(pair.otherEdge);
        const Vector<3> across = edge.cross(other);
        outward = across.dot(outward) < 0 ? Vector<3>(-across.normalized()) : across.normalized();
        // Where the edge is nearest to the other one: between + s edge - t other is along their normal.
        point.position -= between.cross(other).dot(across) / across.squaredNorm() * edge;
    }
    point.gap = outward.dot(between);
    point.normal = pair.cornerBlock == point.block ? outward : Vector<3>(-outward);
    return point;
}

const std::vector<ContactPoint<3>>& MovingContacts<3>::update(const std::vector<Placement<3>>& now,
                                                              double margin)
{
    return update(now, std::vector<std::vector<Placement<3>>>(1, now), margin);
}

const std::vector<ContactPoint<3>>&
MovingContacts<3>::update(const std::vector<Placement<3>>& now,
                          const std::vector<std::vector<Placement<3>>>& headings, double margin)
{
    points.clear();
    foundIndex.clear();
    found.clear();
    foundJoints = 0;
    searched.clear();
    Places places{now, margin, swingsOf(now, 1), swingsOf(now, -1), PlacedSolids(solids, centroids, now), {}};
    for (const std::vector<Placement<3>>& heading : headings)
    {
        places.headings.emplace_back(solids, centroids, heading);
    }
    const std::vector<std::pair<int, int>> meeting = meetingPairs(places);
    auto next = meeting.begin();
    const auto findBefore = [&](const std::pair<int, int>& end)
    {
        for (; next != meeting.end() && *next < end; ++next)
        {
            find({next->first, next->second, -1}, places);
        }
    };
    for (const KnownPair& pair : known)
    {
        const std::pair blocks(pair.block, pair.neighbour);
        findBefore(blocks);
        const bool isMeeting = next != meeting.end() && *next == blocks;
        next += isMeeting ? 1 : 0;
        if (isLeftOut[static_cast<std::size_t>(pair.block)]
            || isLeftOut[static_cast<std::size_t>(pair.neighbour)])
        {
            continue;
        }
        if (isFollowed(pair, places))
        {
            follow(pair, places);
            if (wayApart(pair, places) + places.margin >= pair.clearance)
            {
                find({pair.block, pair.neighbour, static_cast<int>(&pair - known.data())}, places);
            }
        }
        else if (isMeeting)
        {
            find({pair.block, pair.neighbour, -1}, places);
        }
    }
    findBefore({static_cast<int>(now.size()), 0});
    measure(now, points);
    refuseDeepPoints();
    return points;
}

/// Pairs of blocks, not both fixed, that are or will be within the margin.
std::vector<std::pair<int, int>> MovingContacts<3>::meetingPairs(const Places& places) const
{
    std::vector<Box<3>> boxes(places.now.size());
    for (std::size_t block = 0; block < boxes.size(); ++block)
    {
        if (isLeftOut[block])
        {
            continue;
        }
        Box<3>& box = boxes[block];
        const auto extendTo = [&](const Vector<3>& translation, const Swing<3>& forth)
        {
            for (const Vector<3>& vertex : assembly.blocks[block].shape.vertices)
            {
                extend(box, Vector<3>(vertex + translation + forth(vertex - centroids[block])));
            }
        };
        extendTo(places.now[block].translation, places.forth[block]);
        for (const PlacedSolids& heading : places.headings)
        {
            const Placement<3>& there = heading.placements()[block];
            extendTo(there.translation, Swing<3>(there.rotation));
        }
        box = enlarged(box, 0.5 * places.margin);
    }
    std::vector<std::pair<int, int>> meeting = findMeetingPairs(boxes);
    std::erase_if(meeting,
                  [&](const std::pair<int, int>& pair)
                  {
                      return assembly.blocks[static_cast<std::size_t>(pair.first)].support >= 0
                             && assembly.blocks[static_cast<std::size_t>(pair.second)].support >= 0;
                  });
    return meeting;
}

/// How far a corner is outside the face that it was built on [m].
double MovingContacts<3>::outsideOf(const Pair& pair, const Places& places) const
{
    const auto corner = static_cast<std::size_t>(pair.cornerBlock);
    const auto face = static_cast<std::size_t>(pair.faceBlock);
    const Vector<3> place =
        pair.corner + places.now[corner].translation + places.forth[corner](pair.corner - centroids[corner]);
    const Vector<3> arm = place - centroids[face] - places.now[face].translation;
    return distanceOutside(pair.outline, pair.outward, centroids[face] + arm + places.back[face](arm));
}

/// By how much points of two blocks have moved to each other at most [m].
double MovingContacts<3>::wayApart(const KnownPair& pair, const Places& places) const
{
    const auto a = static_cast<std::size_t>(pair.block);
    const auto b = static_cast<std::size_t>(pair.neighbour);
    return (places.now[a].translation - places.now[b].translation).norm()
           + radii[a] * places.now[a].rotation.norm() + radii[b] * places.now[b].rotation.norm();
}

/// Whether the points of a pair as built are still all that there are between the two.
bool MovingContacts<3>::isFollowed(const KnownPair& pair, const Places& places) const
{
    const double most = mayLeave * blockSize;
    if (!isSearched(pair.block, pair.neighbour) || wayApart(pair, places) <= most)
    {
        return true;
    }
    const auto a = static_cast<std::size_t>(pair.block);
    const auto b = static_cast<std::size_t>(pair.neighbour);
    if (turnBetween(places.now[a].rotation, places.now[b].rotation).norm() > mayTurn)
    {
        return false;
    }
    for (std::size_t point = pair.begin; point < pair.end; ++point)
    {
        if (outsideOf(pairs[point], places) > most
            && !(others[point] && outsideOf(*others[point], places) <= most))
        {
            return false;
        }
    }
    return true;
}

/// Lists the points of a pair as built. Of two corners that were at one place the one that lies on the
/// other's face: once they have slid past each other the patch ends there, and a joint that turns opens by
/// what is beyond it.
void MovingContacts<3>::follow(const KnownPair& pair, const Places& places)
{
    const double rounding = cornersAtOnePlace * blockSize;
    const bool isAsBuilt = 2 * wayApart(pair, places) <= rounding; // of either corner by as much
    for (std::size_t index = pair.begin; index < pair.end; ++index)
    {
        points.push_back(asBuilt[index]);
        foundIndex.push_back(-1);
        if (!isAsBuilt && others[index]
            && outsideOf(*others[index], places) < outsideOf(pairs[index], places) - rounding)
        {
            points.back().feature.vertexBlock = others[index]->cornerBlock;
        }
    }
    if (!isSearched(pair.block, pair.neighbour))
    {
        refuseLostPoints(pair, places);
    }
}

/// Of the pair that was listed last.
void MovingContacts<3>::refuseLostPoints(const KnownPair& pairAsBuilt, const Places& places) const
{
    for (std::size_t index = points.size() - (pairAsBuilt.end - pairAsBuilt.begin); index < points.size();
         ++index)
    {
        const Pair& pair = pairOf(index);
        const double gap = pointAt(places.now, places.forth[static_cast<std::size_t>(pair.cornerBlock)],
                                   places.forth[static_cast<std::size_t>(pair.faceBlock)], index)
                               .gap;
        if (gap > mayEnter * blockSize)
        {
            continue; // apart
        }
        const double outside = outsideOf(pair, places);
        if (outside > othersMayLeave * blockSize)
        {
            throw FatalError(fmt::format("A corner of {} has left the face of {} that it was built on by "
                                         "{:.3g} m. New contact points are found between blocks of up to {} "
                                         "convex parts: it ends here. Divide those that have more.",
                                         blockName(assembly, pair.cornerBlock),
                                         blockName(assembly, pair.faceBlock), outside, mostParts));
        }
    }
}

double MovingContacts<3>::marginFor(const std::vector<Eigen::Matrix<double, 6, 1>>& velocities,
                                    double timeStep, double acceleration) const
{
    double fastest = 0;
    for (std::size_t block = 0; block < radii.size(); ++block)
    {
        fastest = std::max(fastest, velocities[block].head<3>().norm()
                                        + velocities[block].tail<3>().norm() * radii[block]);
    }
    return 2 * timeStep * (fastest + acceleration * timeStep);
}

void MovingContacts<3>::leaveOut(int block)
{
    isLeftOut[static_cast<std::size_t>(block)] = true;
}

} // namespace drystone
