// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Contacts in space: followed, found, and the ends of that.
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

/// In mean block sizes: how far a corner of convex blocks may leave the face that it was built on and still
/// be followed, and that of others before a run ends.
constexpr double mayLeave = 1e-3;
constexpr double othersMayLeave = 0.05;

/// Beyond this turn other corners of convex blocks may touch than those of the face that lay on the other
/// [rad].
constexpr double mayTurn = 0.1;

/// In mean block sizes: how far blocks may enter each other between which nothing is found, and others before
/// a run ends.
constexpr double mayEnter = 1e-3;
constexpr double foundMayEnter = 1e-2;

/// In mean block sizes: blocks that a step leaves deeper in each other have met otherwise than was foreseen,
/// and a point that is farther behind a face now does not come from there.
constexpr double overlooked = 1e-5;

/// Points of two blocks within so many mean block sizes whose normals have at least this cosine are one.
constexpr double onePoint = 1e-4;
constexpr double oneNormal = 0.99;

/// Where blocks are heading deeper into each other than this part of the thinner one, the way out may be on
/// the far side: what meets is then chosen where they are.
constexpr double trustedPart = 0.25;

/// Features that are found are numbered from here on; points that are followed have the numbers below.
constexpr int firstFound = 1 << 30;
constexpr int mostFeatures = 1 << 13; // vertices or edges of a block

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

/// The number of what meets: of a corner, or of two edges.
int featureOf(const ConvexContact& contact, const ConvexSolid& own)
{
    const bool isCorner = contact.from == contact.to;
    int edge = -1;
    for (std::size_t i = 0; !isCorner && i < own.edges.size(); ++i)
    {
        const bool isIt =
            std::minmax(own.edges[i].from, own.edges[i].to) == std::minmax(contact.from, contact.to);
        edge = isIt ? static_cast<int>(i) : edge;
    }
    const int first = isCorner ? contact.from : contact.isOfFirst ? edge : contact.edge;
    const int second = isCorner ? 0 : contact.isOfFirst ? contact.edge : edge;
    const int kind = isCorner ? (contact.isOfFirst ? 0 : 1) : contact.isEdgeOnEdge ? 3 : 2;
    return firstFound + (kind * mostFeatures + first) * mostFeatures + second;
}

} // namespace

MovingContacts<3>::MovingContacts(const Assembly<3>& structure, const MovingContactOptions& options)
    : assembly(structure),
      asBuilt(findContactPoints(structure)),
      isLeftOut(structure.blocks.size(), false),
      blockSize(meanBlockSize(structure)),
      tolerance(options.tolerance * blockSize)
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
        const bool isFound =
            drystone::isConvex(block.shape) && block.shape.vertices.size() < mostFeatures / 3; // E < 3 V
        solids.push_back(isFound ? convexSolid(block.shape, tolerance) : ConvexSolid());
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
        const std::size_t index = pairs.size() - 1;
        if (known.empty() || known.back().block != point.block || known.back().neighbour != point.neighbour)
        {
            known.push_back({point.block, point.neighbour, index, index});
        }
        ++known.back().end;
    }
    points = asBuilt;
    foundIndex.assign(points.size(), -1);
}

/// \param isOfNeighbour whose corner, against the face of the other
MovingContacts<3>::Pair MovingContacts<3>::pairAt(const ContactPoint<3>& point, bool isOfNeighbour) const
{
    Pair pair;
    pair.cornerBlock = isOfNeighbour ? point.neighbour : point.block;
    pair.faceBlock = isOfNeighbour ? point.block : point.neighbour;
    pair.corner = point.position;
    pair.onFace = point.position;
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
    lookedAt.clear();
    const Places places{now, headings, swingsOf(now, 1), swingsOf(now, -1)};
    const std::vector<std::pair<int, int>> meeting = meetingPairs(places, margin);
    auto next = meeting.begin();
    const auto findBefore = [&](const std::pair<int, int>& end)
    {
        for (; next != meeting.end() && *next < end; ++next)
        {
            find(next->first, next->second, places);
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
        }
        else if (isMeeting)
        {
            find(pair.block, pair.neighbour, places);
        }
    }
    findBefore({static_cast<int>(now.size()), 0});
    measure(now, points);
    dropFar(margin);
    return points;
}

/// Pairs of blocks, not both fixed, that are or will be within the margin.
std::vector<std::pair<int, int>> MovingContacts<3>::meetingPairs(const Places& places, double margin) const
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
        for (const std::vector<Placement<3>>& heading : places.headings)
        {
            extendTo(heading[block].translation, Swing<3>(heading[block].rotation));
        }
        box = enlarged(box, 0.5 * margin);
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

bool MovingContacts<3>::isConvexPair(int block, int neighbour) const
{
    return !solids[static_cast<std::size_t>(block)].faces.empty()
           && !solids[static_cast<std::size_t>(neighbour)].faces.empty();
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
    if (!isConvexPair(pair.block, pair.neighbour) || wayApart(pair, places) <= most)
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
    if (!isConvexPair(pair.block, pair.neighbour))
    {
        refuseLostPoints(pair, places);
    }
}

MovingContacts<3>::Pair MovingContacts<3>::pairOfContact(const ConvexContact& contact, int block,
                                                         int neighbour) const
{
    Pair pair;
    pair.cornerBlock = contact.isOfFirst ? block : neighbour;
    pair.faceBlock = contact.isOfFirst ? neighbour : block;
    const ConvexSolid& own = solids[static_cast<std::size_t>(pair.cornerBlock)];
    const ConvexSolid& other = solids[static_cast<std::size_t>(pair.faceBlock)];
    const Vector<3>& from = own.vertices[static_cast<std::size_t>(contact.from)];
    const Vector<3>& to = own.vertices[static_cast<std::size_t>(contact.to)];
    const std::vector<int>& face = other.faces[static_cast<std::size_t>(contact.face)];
    pair.corner = from + contact.part * (to - from);
    pair.onFace = other.vertices[static_cast<std::size_t>(face.front())];
    pair.outward = other.normals[static_cast<std::size_t>(contact.face)];
    pair.shear = frameOf(pair.outward).col(1);
    if (contact.isEdgeOnEdge)
    {
        const ConvexSolid::Edge& edge = other.edges[static_cast<std::size_t>(contact.edge)];
        pair.onFace = other.vertices[static_cast<std::size_t>(edge.from)];
        pair.edge = (to - from).normalized();
        pair.otherEdge = (other.vertices[static_cast<std::size_t>(edge.to)] - pair.onFace).normalized();
        // Between the normals of the faces beside it: that of both edges is there.
        pair.outward = (other.normals[static_cast<std::size_t>(edge.face)]
                        + other.normals[static_cast<std::size_t>(edge.otherFace)])
                           .normalized();
        pair.shear = pair.otherEdge;
    }
    return pair;
}

/// Lists what two blocks that were not built on each other, or have left that, touch each other with.
void MovingContacts<3>::find(int block, int neighbour, const Places& places)
{
    if (!isConvexPair(block, neighbour))
    {
        refuseMeeting(block, neighbour, places.now);
        return;
    }
    lookedAt.emplace_back(block, neighbour);
    const std::size_t first = points.size();
    for (const std::vector<Placement<3>>& heading : places.headings)
    {
        const std::vector<ConvexContact> contacts = contactsTowards(heading, block, neighbour, places);
        for (const ConvexContact& contact : contacts)
        {
            Pair pair = pairOfContact(contact, block, neighbour);
            ContactPoint<3> point;
            point.block = block;
            point.neighbour = neighbour;
            point.joint = static_cast<int>(known.size()) + foundJoints;
            point.feature = {pair.cornerBlock,
                             featureOf(contact, solids[static_cast<std::size_t>(pair.cornerBlock)]),
                             contact.face};
            point =
                measured(point, pair, places.now, places.forth[static_cast<std::size_t>(pair.cornerBlock)],
                         places.forth[static_cast<std::size_t>(pair.faceBlock)]);
            const auto isSame = [&](const ContactPoint<3>& other)
            {
                return other.feature == point.feature
                       || ((other.position - point.position).norm() <= onePoint * blockSize
                           && other.normal.dot(point.normal) > oneNormal);
            };
            if (std::any_of(points.begin() + static_cast<std::ptrdiff_t>(first), points.end(), isSame))
            {
                continue; // of an earlier heading, or beside one: how the two share a force would not be
                          // determined
            }
            found.push_back(std::move(pair));
            points.push_back(point);
            foundIndex.push_back(static_cast<int>(found.size()) - 1);
        }
    }
    foundJoints += points.size() > first ? 1 : 0;
}

/// What meets where two blocks are heading. A point that is behind a face already did not come from there,
/// and deep in each other the way out may be on the far side: then, and where nothing was found before, what
/// meets along the axis that parts the blocks now is taken too, there and where they are.
std::vector<ConvexContact> MovingContacts<3>::contactsTowards(const std::vector<Placement<3>>& heading,
                                                              int block, int neighbour,
                                                              const Places& places) const
{
    const PlacedPair there = placedPair(block, neighbour, heading);
    const PartingAxis axis = partingAxis(there.first, there.second, tolerance, true);
    if (axis.isAnEdgeAtMost)
    {
        return {};
    }
    const double trusted = trustedPart
                           * std::min(solids[static_cast<std::size_t>(block)].thickness,
                                      solids[static_cast<std::size_t>(neighbour)].thickness);
    std::vector<ConvexContact> contacts;
    if (axis.distance >= -trusted)
    {
        contacts = contactsAlong(axis, there.first, there.second, tolerance);
    }
    const auto isBehind = [&](const ConvexContact& contact, double depth)
    {
        const Pair pair = pairOfContact(contact, block, neighbour);
        const double gap =
            measured({}, pair, places.now, places.forth[static_cast<std::size_t>(pair.cornerBlock)],
                     places.forth[static_cast<std::size_t>(pair.faceBlock)])
                .gap;
        return gap < -depth - overlooked * blockSize;
    };
    const bool isAsForeseen =
        axis.distance >= -trusted
        && std::none_of(contacts.begin(), contacts.end(),
                        [&](const ConvexContact& contact) { return isBehind(contact, 0); });
    const bool wasOverlooked = contacts.empty() && places.headings.size() > 1;
    if (isAsForeseen && !wasOverlooked)
    {
        return contacts;
    }
    const PlacedPair here = placedPair(block, neighbour, places.now);
    const PartingAxis now = partingAxis(here.first, here.second, tolerance, false);
    const std::vector<ConvexContact> then = contactsAlong(now, there.first, there.second, tolerance);
    contacts.insert(contacts.end(), then.begin(), then.end());
    std::erase_if(contacts, [&](const ConvexContact& contact)
                  { return isBehind(contact, std::max(0.0, -now.distance)); });
    const std::vector<ConvexContact> already = contactsAlong(now, here.first, here.second, tolerance);
    contacts.insert(contacts.end(), already.begin(), already.end());
    return contacts;
}

MovingContacts<3>::PlacedPair MovingContacts<3>::placedPair(int block, int neighbour,
                                                            const std::vector<Placement<3>>& placements) const
{
    const auto a = static_cast<std::size_t>(block);
    const auto b = static_cast<std::size_t>(neighbour);
    return {placed(solids[a], centroids[a], placements[a]), placed(solids[b], centroids[b], placements[b])};
}

bool MovingContacts<3>::isOverlapping(const std::vector<Placement<3>>& placements) const
{
    return std::any_of(lookedAt.begin(), lookedAt.end(),
                       [&](const std::pair<int, int>& pair)
                       {
                           const PlacedPair there = placedPair(pair.first, pair.second, placements);
                           const PartingAxis axis = partingAxis(there.first, there.second, tolerance, true);
                           return !axis.isAnEdgeAtMost && axis.distance < -overlooked * blockSize;
                       });
}

/// Takes away points that were found and are farther apart than the margin. \throws FatalError where they
/// are too deep in each other
void MovingContacts<3>::dropFar(double margin)
{
    std::size_t kept = 0;
    for (std::size_t index = 0; index < points.size(); ++index)
    {
        const ContactPoint<3>& point = points[index];
        if (foundIndex[index] >= 0)
        {
            if (point.gap > margin)
            {
                continue;
            }
            if (point.gap < -foundMayEnter * blockSize)
            {
                throw FatalError(fmt::format("{} and {} have run {:.3g} m into each other within a step, "
                                             "{:.2g} of the mean block size: it is "
                                             "not known on which side they met. Give a shorter deltaT.",
                                             blockName(assembly, point.block),
                                             blockName(assembly, point.neighbour), -point.gap,
                                             -point.gap / blockSize));
            }
        }
        points[kept] = point;
        foundIndex[kept] = foundIndex[index];
        ++kept;
    }
    points.resize(kept);
    foundIndex.resize(kept);
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
                                         "{:.3g} m. In space new contact "
                                         "points are found between convex blocks alone: it ends here. Divide "
                                         "blocks that are not convex.",
                                         blockName(assembly, pair.cornerBlock),
                                         blockName(assembly, pair.faceBlock), outside));
        }
    }
}

void MovingContacts<3>::refuseMeeting(int block, int neighbour, const std::vector<Placement<3>>& now) const
{
    const double depth = overlapDepth(
        placedShape(assembly.blocks[static_cast<std::size_t>(block)], now[static_cast<std::size_t>(block)]),
        placedShape(assembly.blocks[static_cast<std::size_t>(neighbour)],
                    now[static_cast<std::size_t>(neighbour)]));
    if (depth > mayEnter * blockSize)
    {
        throw FatalError(fmt::format("{} and {}, which shared no contact point at the start, have run into "
                                     "each other ({:.3g} m deep). In "
                                     "space new contact points are found between convex blocks alone: it "
                                     "ends here. Divide blocks that "
                                     "are not convex.",
                                     blockName(assembly, block), blockName(assembly, neighbour), depth));
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
