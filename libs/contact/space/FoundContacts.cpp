// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Contacts in space that are found: between convex parts of blocks that were not built on each other, or
/// have left that.
#include "contact/AlmostJoints.h"
#include "contact/PointsOfPair.h"
#include "contact/space/MovingContacts.h"
#include "core/Error.h"
#include "geometry/Box.h"
#include "geometry/space/PolyhedronOverlap.h"

#include <Eigen/Geometry>
#include <fmt/format.h>

#include <algorithm>

namespace drystone
{
namespace
{

/// In mean block sizes: how far blocks may enter each other between which nothing is found before a run ends.
constexpr double unsearchedMayEnter = 1e-3;

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

/// Whether the boxes about two solids are within a distance.
bool areNear(const ConvexSolid& one, const ConvexSolid& other, double distance)
{
    return meet(enlarged(boxAround<3>(one.vertices), distance), boxAround<3>(other.vertices));
}

/// What the parts before one have: their numbers follow each other.
struct Counted
{
    int vertices = 0;
    int edges = 0;
    int faces = 0;
};

Counted before(const std::vector<ConvexSolid>& parts, std::size_t part)
{
    Counted counted;
    for (std::size_t i = 0; i < part; ++i)
    {
        counted.vertices += static_cast<int>(parts[i].vertices.size());
        counted.edges += static_cast<int>(parts[i].edges.size());
        counted.faces += static_cast<int>(parts[i].faces.size());
    }
    return counted;
}

} // namespace

bool MovingContacts<3>::isSearched(int block, int neighbour) const
{
    return parts(block) > 0 && parts(neighbour) > 0;
}

/// The number of what meets: of a corner, or of two edges.
int MovingContacts<3>::featureOf(const PartContact& meeting, int block, int neighbour) const
{
    const ConvexContact& contact = meeting.contact;
    const auto& own = solids[static_cast<std::size_t>(contact.isOfFirst ? block : neighbour)];
    const auto& other = solids[static_cast<std::size_t>(contact.isOfFirst ? neighbour : block)];
    const std::size_t ownPart = contact.isOfFirst ? meeting.part : meeting.otherPart;
    const std::size_t otherPart = contact.isOfFirst ? meeting.otherPart : meeting.part;
    const Counted ownBefore = before(own, ownPart);
    const bool isCorner = contact.from == contact.to;
    const int edge = isCorner ? -1 : ownBefore.edges + edgeBetween(own[ownPart], contact.from, contact.to);
    const int otherEdge = isCorner ? -1 : before(other, otherPart).edges + contact.edge;
    const int first = isCorner ? ownBefore.vertices + contact.from : contact.isOfFirst ? edge : otherEdge;
    const int second = isCorner ? 0 : contact.isOfFirst ? otherEdge : edge;
    const int kind = isCorner ? (contact.isOfFirst ? 0 : 1) : contact.isEdgeOnEdge ? 3 : 2;
    return firstFound + (kind * mostFeatures + first) * mostFeatures + second;
}

MovingContacts<3>::Pair MovingContacts<3>::pairOfContact(const PartContact& meeting, int block,
                                                         int neighbour) const
{
    const ConvexContact& contact = meeting.contact;
    Pair pair;
    pair.cornerBlock = contact.isOfFirst ? block : neighbour;
    pair.faceBlock = contact.isOfFirst ? neighbour : block;
    const ConvexSolid& own = solids[static_cast<std::size_t>(pair.cornerBlock)]
                                   [contact.isOfFirst ? meeting.part : meeting.otherPart];
    const ConvexSolid& other = solids[static_cast<std::size_t>(pair.faceBlock)]
                                     [contact.isOfFirst ? meeting.otherPart : meeting.part];
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
        // The normal of both edges lies between those of the faces at the edge.
        pair.outward = (other.normals[static_cast<std::size_t>(edge.face)]
                        + other.normals[static_cast<std::size_t>(edge.otherFace)])
                           .normalized();
        pair.shear = pair.otherEdge;
    }
    return pair;
}

/// Whether parts of a pair that is followed are built on each other: then they are not searched.
bool MovingContacts<3>::arePartsBuilt(const SearchedPair& pair, std::size_t part, std::size_t otherPart) const
{
    return pair.followed >= 0
           && known[static_cast<std::size_t>(pair.followed)]
                  .isBuilt[part * parts(pair.neighbour) + otherPart];
}

/// Lists what two blocks that were not built on each other, or have left that, touch each other with; of a
/// pair whose points as built have just been listed what else meets.
void MovingContacts<3>::find(const SearchedPair& pairOfBlocks, Places& places)
{
    const auto [block, neighbour, followed] = pairOfBlocks;
    if (!isSearched(block, neighbour))
    {
        refuseMeeting(block, neighbour, places.now);
        return;
    }
    searched.push_back(pairOfBlocks);
    const std::size_t first = points.size();
    const KnownPair* followedPair = followed >= 0 ? &known[static_cast<std::size_t>(followed)] : nullptr;
    const std::size_t firstOfPair = first - (followedPair ? followedPair->end - followedPair->begin : 0);
    for (PlacedSolids& heading : places.headings)
    {
        for (const PartContact& meeting : contactsTowards(heading, pairOfBlocks, places))
        {
            Pair pair = pairOfContact(meeting, block, neighbour);
            const ContactPoint<3> point = foundPoint(meeting, pair, block, neighbour, places);
            if (!(point.gap > places.margin))
            {
                addFound(point, std::move(pair), firstOfPair);
            }
        }
    }
    foundJoints += points.size() > first ? 1 : 0;
}

/// Where two blocks meet, measured where they are.
ContactPoint<3> MovingContacts<3>::foundPoint(const PartContact& meeting, const Pair& pair, int block,
                                              int neighbour, const Places& places) const
{
    const auto& facing = solids[static_cast<std::size_t>(pair.faceBlock)];
    const std::size_t facingPart = meeting.contact.isOfFirst ? meeting.otherPart : meeting.part;
    ContactPoint<3> point;
    point.block = block;
    point.neighbour = neighbour;
    point.joint = static_cast<int>(known.size()) + foundJoints;
    point.feature = {pair.cornerBlock, featureOf(meeting, block, neighbour),
                     before(facing, facingPart).faces + meeting.contact.face};
    return measured(point, pair, places.now, places.forth[static_cast<std::size_t>(pair.cornerBlock)],
                    places.forth[static_cast<std::size_t>(pair.faceBlock)]);
}

/// Adds a point, unless the pair of blocks has it from an earlier heading, of another part, or next to it:
/// how the two share a force would not be determined. The nearer face is met first.
void MovingContacts<3>::addFound(const ContactPoint<3>& point, Pair pair, std::size_t firstOfPair)
{
    const auto isSame = [&](const ContactPoint<3>& other)
    {
        return other.feature == point.feature
               || ((other.position - point.position).norm() <= onePoint * blockSize
                   && other.normal.dot(point.normal) > oneNormal);
    };
    const auto there =
        std::find_if(points.begin() + static_cast<std::ptrdiff_t>(firstOfPair), points.end(), isSame);
    if (there == points.end())
    {
        found.push_back(std::move(pair));
        points.push_back(point);
        foundIndex.push_back(static_cast<int>(found.size()) - 1);
    }
    else if (const int index = foundIndex[static_cast<std::size_t>(there - points.begin())];
             index >= 0 && point.gap < there->gap)
    {
        found[static_cast<std::size_t>(index)] = std::move(pair);
        *there = point;
    }
}

/// What meets where two blocks are heading.
std::vector<MovingContacts<3>::PartContact>
MovingContacts<3>::contactsTowards(PlacedSolids& heading, const SearchedPair& pair, Places& places) const
{
    const std::vector<ConvexSolid>& own = heading.of(pair.block);
    const std::vector<ConvexSolid>& ofNeighbour = heading.of(pair.neighbour);
    std::vector<PartContact> contacts;
    for (std::size_t part = 0; part < own.size(); ++part)
    {
        for (std::size_t otherPart = 0; otherPart < ofNeighbour.size(); ++otherPart)
        {
            const bool isOfOnePart = own.size() == 1 && ofNeighbour.size() == 1;
            if (arePartsBuilt(pair, part, otherPart))
            {
                continue;
            }
            if (isOfOnePart || areNear(own[part], ofNeighbour[otherPart], places.margin))
            {
                const std::vector<PartContact> ofParts =
                    contactsOfParts(own[part], ofNeighbour[otherPart], {{}, part, otherPart}, pair.block,
                                    pair.neighbour, places);
                contacts.insert(contacts.end(), ofParts.begin(), ofParts.end());
            }
        }
    }
    return contacts;
}

/// A point that is behind a face already did not come from there, and deep in each other the way out may be
/// on the far side: then, and where nothing was found before, what meets along the axis that parts the blocks
/// now is taken too, there and where they are. \param parts which they are
std::vector<MovingContacts<3>::PartContact>
MovingContacts<3>::contactsOfParts(const ConvexSolid& there, const ConvexSolid& otherThere,
                                   const PartContact& parts, int block, int neighbour, Places& places) const
{
    const double within = toleranceOf(block, neighbour);
    const PartingAxis axis = axisBetween(there, otherThere, block, neighbour);
    if (axis.isAnEdgeAtMost)
    {
        return {};
    }
    std::vector<PartContact> contacts;
    const auto take = [&](const std::vector<ConvexContact>& more)
    {
        for (const ConvexContact& contact : more)
        {
            contacts.push_back({contact, parts.part, parts.otherPart});
        }
    };
    const double trusted = trustedPart * std::min(there.thickness, otherThere.thickness);
    if (axis.distance >= -trusted)
    {
        take(contactsAlong(axis, there, otherThere, within, edgesAlongFaces));
    }
    const auto isBehind = [&](const PartContact& contact, double depth)
    {
        const Pair pair = pairOfContact(contact, block, neighbour);
        const double gap =
            measured({}, pair, places.now, places.forth[static_cast<std::size_t>(pair.cornerBlock)],
                     places.forth[static_cast<std::size_t>(pair.faceBlock)])
                .gap;
        return gap < -depth - std::max(within, overlooked * blockSize);
    };
    const bool isAsForeseen =
        axis.distance >= -trusted
        && std::none_of(contacts.begin(), contacts.end(),
                        [&](const PartContact& contact) { return isBehind(contact, 0); });
    const bool wasOverlooked = contacts.empty() && places.headings.size() > 1;
    if (isAsForeseen && !wasOverlooked)
    {
        return contacts;
    }
    const ConvexSolid& here = places.here.of(block)[parts.part];
    const ConvexSolid& otherHere = places.here.of(neighbour)[parts.otherPart];
    const PartingAxis now = partingAxis(here, otherHere, within, SharedEdge::mayTouch);
    take(contactsAlong(now, there, otherThere, within, edgesAlongFaces));
    std::erase_if(contacts, [&](const PartContact& contact)
                  { return isBehind(contact, std::max(0.0, -now.distance)); });
    take(contactsAlong(now, here, otherHere, within, edgesAlongFaces));
    return contacts;
}

/// By how much the points between two blocks are pressed in at most, or are to be [m].
double MovingContacts<3>::pressedIn(int block, int neighbour,
                                    const std::vector<Placement<3>>& placements) const
{
    const auto [first, last] =
        entriesOf({block, neighbour}, points.begin(), points.end(),
                  [](const ContactPoint<3>& point) { return drystone::pairOf(point); });
    double deepest = 0;
    for (auto point = first; point != last; ++point)
    {
        const auto index = static_cast<std::size_t>(point - points.begin());
        deepest = std::max(deepest, -pointAt(placements, index).gap);
    }
    return deepest;
}

double MovingContacts<3>::overlookedDepth(const std::vector<Placement<3>>& placements) const
{
    PlacedSolids there(solids, centroids, placements);
    const auto depthOf = [&](const SearchedPair& pair)
    {
        double depth = 0;
        const std::vector<ConvexSolid>& own = there.of(pair.block);
        const std::vector<ConvexSolid>& ofNeighbour = there.of(pair.neighbour);
        for (std::size_t part = 0; part < own.size(); ++part)
        {
            for (std::size_t otherPart = 0; otherPart < ofNeighbour.size(); ++otherPart)
            {
                if (arePartsBuilt(pair, part, otherPart))
                {
                    continue;
                }
                const PartingAxis axis =
                    axisBetween(own[part], ofNeighbour[otherPart], pair.block, pair.neighbour);
                depth = axis.isAnEdgeAtMost ? depth : std::max(depth, -axis.distance);
            }
        }
        return depth;
    };
    double deepest = 0;
    for (const SearchedPair& pair : searched)
    {
        const double depth = depthOf(pair);
        const double error = std::max(toleranceOf(pair.block, pair.neighbour), overlooked * blockSize);
        if (depth > error && depth > error + pressedIn(pair.block, pair.neighbour, placements))
        {
            deepest = std::max(deepest, depth);
        }
    }
    return deepest;
}

namespace
{

/// The first point that was found and is farther behind its face than blocks may enter each other; the end
/// where there is none. \param found one a point, below 0 where it was built \param mayEnter [m]
std::vector<ContactPoint<3>>::const_iterator firstTooDeep(const std::vector<ContactPoint<3>>& points,
                                                          const std::vector<int>& found, double mayEnter)
{
    return std::find_if(points.begin(), points.end(),
                        [&](const ContactPoint<3>& point) {
                            return found[static_cast<std::size_t>(&point - points.data())] >= 0
                                   && point.gap < -mayEnter;
                        });
}

} // namespace

bool MovingContacts<3>::isAnyTooDeep(const std::vector<ContactPoint<3>>& measured) const
{
    return firstTooDeep(measured, foundIndex, mayEnterFound) != measured.end();
}

/// \throws FatalError where blocks are too deep in each other at points that were found
void MovingContacts<3>::refuseDeepPoints() const
{
    const auto point = firstTooDeep(points, foundIndex, mayEnterFound);
    if (point != points.end())
    {
        throw FatalError(fmt::format(
            "{} and {} have run {:.3g} m into each other, {:.2g} of the mean block size: it is not "
            "known on which side they met. Give a shorter deltaT, or with adjustTimeStep a smaller "
            "maxDisplacement or maxDeltaT; where joints are elastic, stiffer ones.",
            blockName(assembly, point->block), blockName(assembly, point->neighbour), -point->gap,
            -point->gap / blockSize));
    }
}

void MovingContacts<3>::refuseMeeting(int block, int neighbour, const std::vector<Placement<3>>& now) const
{
    const double depth = overlapDepth(
        placedShape(assembly.blocks[static_cast<std::size_t>(block)], now[static_cast<std::size_t>(block)]),
        placedShape(assembly.blocks[static_cast<std::size_t>(neighbour)],
                    now[static_cast<std::size_t>(neighbour)]));
    if (depth > unsearchedMayEnter * blockSize)
    {
        throw FatalError(
            fmt::format("{} and {}, which shared no contact point at the start, have run into "
                        "each other ({:.3g} m deep). New contact points are found between blocks "
                        "of not too many convex parts: it ends here. Divide those that have more.",
                        blockName(assembly, block), blockName(assembly, neighbour), depth));
    }
}

} // namespace drystone
