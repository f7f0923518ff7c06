// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Where two convex polyhedra touch, or are about to: the corners of the patch that they share. Internal to
/// MovingContacts.
#pragma once

#include "contact/MovingContacts.h"
#include "contact/space/ConvexSolid.h"

#include <vector>

namespace drystone
{

/// A point of one solid against a face, or an edge, of the other.
struct ConvexContact
{
    bool isOfFirst = true;     ///< whose corner, or point of an edge, it is
    int from = -1;             ///< vertex of that solid
    int to = -1;               ///< other end of its edge; `from` where the point is the vertex
    double part = 0;           ///< of the way from `from` to `to`
    int face = -1;             ///< of the other solid: that it stands against, or one beside the edge
    int edge = -1;             ///< of the other solid that the edge crosses
    bool isEdgeOnEdge = false; ///< along the normal of both edges instead of that of the face

    friend bool operator==(const ConvexContact&, const ConvexContact&) = default;
};

/// What parts two solids most, or lets them enter each other least (theorem of the separating axis): the
/// normal of a face of one, or that of an edge of each.
struct PartingAxis
{
    double distance = 0;         ///< along it, negative where they enter each other [m]
    bool isOfFirst = true;       ///< the face
    int face = -1;               ///< also where edges part them more
    int edge = -1;               ///< of the first solid
    int otherEdge = -1;          ///< of the second
    bool isAnEdgeAtMost = false; ///< two faces part them, see SharedEdge; nothing else is said then
};

/// What two solids that two faces part, and which therefore share an edge or a corner at most, may be taken
/// for: blocks across the meeting point of four do not hold each other.
enum class SharedEdge
{
    mayTouch,     ///< as any others
    rimsMayTouch, ///< apart where the faces are across each other: one may rock on the rim of the other
    doesNotTouch  ///< apart, unless both faces have nearly one direction, as those of a ridge
};

/// \param tolerance [m] \param sharedEdge ends with `isAnEdgeAtMost` where that is what they are
PartingAxis partingAxis(const ConvexSolid& first, const ConvexSolid& second, double tolerance,
                        SharedEdge sharedEdge);

/// What meets along an axis: along the normal of a face the corners of the polygon that the face and that of
/// the other solid which looks at it have in common, seen along the normal: corners of either that lie on the
/// other, and crossings of their edges; across two edges the point where they cross. None where the polygon
/// is narrower than the tolerance. \param axis of the solids here or where they are a little before
std::vector<ConvexContact> contactsAlong(const PartingAxis& axis, const ConvexSolid& first,
                                         const ConvexSolid& second, double tolerance,
                                         EdgesAlongFaces edgesAlongFaces);

} // namespace drystone
