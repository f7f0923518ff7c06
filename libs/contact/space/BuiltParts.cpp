// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Which convex parts of blocks in space are built on each other, or at an edge of each other: what meets is
/// found between the others.
#include "contact/JointClosure.h"
#include "contact/space/MovingContacts.h"

#include <algorithm>

namespace drystone
{
namespace
{

/// Whether a point is in a solid or within a distance of the planes of its faces.
bool isAt(const ConvexSolid& solid, const Vector<3>& point, double within)
{
    for (std::size_t face = 0; face < solid.faces.size(); ++face)
    {
        if (solid.normals[face].dot(point - pointOf(solid, static_cast<int>(face))) > within)
        {
            return false;
        }
    }
    return true;
}

} // namespace

/// Of blocks that are not convex other parts may meet than those that are built on each other: a block that
/// stands in a notch its walls. Those of which both are at one point as built are followed there.
void MovingContacts<3>::findBuiltParts(KnownPair& pair) const
{
    const auto& own = solids[static_cast<std::size_t>(pair.block)];
    const auto& ofNeighbour = solids[static_cast<std::size_t>(pair.neighbour)];
    if (own.size() * ofNeighbour.size() <= 1)
    {
        return;
    }
    const double joint = std::max(toleranceOf(pair.block, pair.neighbour), jointTolerance(assembly).oblique);
    for (const ConvexSolid& part : own)
    {
        for (const ConvexSolid& other : ofNeighbour)
        {
            const bool isBuilt = std::any_of(asBuilt.begin() + static_cast<std::ptrdiff_t>(pair.begin),
                                             asBuilt.begin() + static_cast<std::ptrdiff_t>(pair.end),
                                             [&](const ContactPoint<3>& point) {
                                                 return isAt(part, point.position, joint)
                                                        && isAt(other, point.position, joint);
                                             });
            pair.isBuilt.push_back(isBuilt);
            if (!isBuilt)
            {
                pair.clearance =
                    std::min(pair.clearance, partingAxis(part, other, joint, SharedEdge::mayTouch).distance);
            }
        }
    }
}

/// Joints within a tolerance that is stated, narrower than it too, are none: blocks across the meeting point
/// of four that are in each other by a sliver are at an edge as well.
std::map<std::pair<int, int>, double> MovingContacts<3>::pairsAtEdges() const
{
    constexpr double steps = 2; // of the tolerances that are tried
    const double widest = jointTolerance(assembly).oblique;
    const std::vector<Placement<3>> built(assembly.blocks.size());
    const std::vector<Swing<3>> unturned(built.size(), Swing<3>(Vector<3>::Zero()));
    const Places places{built, tolerance, unturned, unturned, PlacedSolids(solids, centroids, built), {}};
    const auto isKnown = [this](const std::pair<int, int>& pair)
    {
        return std::binary_search(
            known.begin(), known.end(), KnownPair{pair.first, pair.second, 0, 0, {}},
            [](const KnownPair& one, const KnownPair& other)
            { return std::pair(one.block, one.neighbour) < std::pair(other.block, other.neighbour); });
    };
    const auto touch = [this](const std::pair<int, int>& pair, double within, SharedEdge sharedEdge)
    {
        for (const ConvexSolid& own : solids[static_cast<std::size_t>(pair.first)])
        {
            for (const ConvexSolid& other : solids[static_cast<std::size_t>(pair.second)])
            {
                const PartingAxis axis = partingAxis(own, other, within, sharedEdge);
                if (!axis.isAnEdgeAtMost && axis.distance <= toleranceOf(pair.first, pair.second))
                {
                    return true;
                }
            }
        }
        return false;
    };
    std::map<std::pair<int, int>, double> touching;
    for (const std::pair<int, int>& pair : meetingPairs(places))
    {
        const double least = toleranceOf(pair.first, pair.second);
        if (isKnown(pair) || !touch(pair, least, SharedEdge::mayTouch))
        {
            continue;
        }
        double within = least;
        while (touch(pair, within, SharedEdge::doesNotTouch))
        {
            if (within >= widest)
            {
                within = least;
                break;
            }
            within = std::min(steps * within, widest);
        }
        touching[pair] = within;
    }
    return touching;
}

PartingAxis MovingContacts<3>::axisBetween(const ConvexSolid& first, const ConvexSolid& second, int block,
                                           int neighbour) const
{
    const auto atEdge = atEdges.find({block, neighbour});
    return atEdge == atEdges.end()
               ? partingAxis(first, second, toleranceOf(block, neighbour), SharedEdge::rimsMayTouch)
               : partingAxis(first, second, atEdge->second, SharedEdge::doesNotTouch);
}

} // namespace drystone
