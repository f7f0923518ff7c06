// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Separating axes and clipped faces, as in contact of polyhedra since Gottschalk, Lin & Manocha (1996).
#include "contact/space/ConvexContacts.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace drystone
{
namespace
{

constexpr double infinite = std::numeric_limits<double>::infinity();

/// Two faces that part two solids, of directions with less than this cosine: see SharedEdge.
constexpr double nearlyOneFace = 0.9;
constexpr double nearlyAcross = 0.25;

/// Corners of a patch within so many tolerances are one point: how they share its force would not be
/// determined.
constexpr double asOnePoint = 1000;

/// Edges that part solids along a direction with more than this cosine to the normal of a face, 0.1 rad.
constexpr double nearlyAlong = 0.995;

/// Edges must part the solids by so many tolerances more than faces do: of a patch the edges say less.
constexpr double edgesWorseThanFaces = 10;

PartingAxis faceAxis(const ConvexSolid& first, const ConvexSolid& second, double tolerance,
                     SharedEdge sharedEdge)
{
    PartingAxis best;
    best.distance = -infinite;
    const Vector<3>* parting = nullptr; // normal of the first face that does
    const double most = sharedEdge == SharedEdge::rimsMayTouch ? nearlyAcross : nearlyOneFace;
    for (const bool isOfFirst : {true, false})
    {
        const ConvexSolid& solid = isOfFirst ? first : second;
        const ConvexSolid& other = isOfFirst ? second : first;
        for (int face = 0; face < static_cast<int>(solid.faces.size()); ++face)
        {
            const Vector<3>& normal = solid.normals[static_cast<std::size_t>(face)];
            const double distance = leastAlong(other, normal, pointOf(solid, face));
            if (sharedEdge != SharedEdge::mayTouch && distance > -tolerance)
            {
                if (parting && std::abs(parting->dot(normal)) < most)
                {
                    best.isAnEdgeAtMost = true;
                    return best;
                }
                parting = parting ? parting : &normal;
            }
            if (distance > best.distance + (best.isOfFirst == isOfFirst ? 0 : tolerance))
            {
                best.distance = distance;
                best.isOfFirst = isOfFirst;
                best.face = face;
            }
        }
    }
    return best;
}

/// Whether the arcs of two edges on the sphere of normals cross, those of the second turned round: their
/// product is then a face of the difference of the two solids.
bool areArcsCrossing(const ConvexSolid& first, const ConvexSolid::Edge& edge, const ConvexSolid& second,
                     const ConvexSolid::Edge& other)
{
    const auto normal = [](const ConvexSolid& solid, int face) -> const Vector<3>&
    { return solid.normals[static_cast<std::size_t>(face)]; };
    const Vector<3>& a = normal(first, edge.face);
    const Vector<3>& b = normal(first, edge.otherFace);
    const Vector<3> c = -normal(second, other.face);
    const Vector<3> d = -normal(second, other.otherFace);
    const Vector<3> ofFirst = b.cross(a);
    const Vector<3> ofSecond = d.cross(c);
    const double ca = c.dot(ofFirst);
    const double da = d.dot(ofFirst);
    const double ac = a.dot(ofSecond);
    const double bc = b.dot(ofSecond);
    return ca * da < 0 && ac * bc < 0 && ca * bc > 0;
}

/// The better of an axis and of those across edges.
void takeEdges(const ConvexSolid& first, const ConvexSolid& second, double tolerance, PartingAxis& best)
{
    Vector<3> middle = Vector<3>::Zero(); // of the first
    for (const Vector<3>& vertex : first.vertices)
    {
        middle += vertex / static_cast<double>(first.vertices.size());
    }
    double most = best.distance + edgesWorseThanFaces * tolerance;
    for (std::size_t i = 0; i < first.edges.size(); ++i)
    {
        const ConvexSolid::Edge& edge = first.edges[i];
        const Vector<3>& from = first.vertices[static_cast<std::size_t>(edge.from)];
        const Vector<3> along = first.vertices[static_cast<std::size_t>(edge.to)] - from;
        for (std::size_t j = 0; j < second.edges.size(); ++j)
        {
            const ConvexSolid::Edge& other = second.edges[j];
            if (!areArcsCrossing(first, edge, second, other))
            {
                continue;
            }
            const Vector<3>& otherFrom = second.vertices[static_cast<std::size_t>(other.from)];
            const Vector<3> otherAlong = second.vertices[static_cast<std::size_t>(other.to)] - otherFrom;
            Vector<3> across = along.cross(otherAlong);
            const double sine = across.norm();
            if (sine <= 1e-3 * along.norm() * otherAlong.norm())
            {
                continue; // parallel: what a face says too
            }
            across /= across.dot(from - middle) < 0 ? -sine : sine;
            const double distance = across.dot(otherFrom - from);
            if (distance > most)
            {
                most = distance;
                best.distance = distance;
                best.edge = static_cast<int>(i);
                best.otherEdge = static_cast<int>(j);
            }
        }
    }
}

/// A corner of the polygon that two faces share, and what the side from it to the next one lies on.
struct Corner
{
    Vector<3> place;
    int vertex = -1; ///< of the face that is clipped
    int edge = -1;   ///< side of that face, which starts at its corner `edge`, or -1: a corner of the other
    double part = 0; ///< of the way along it
    int side = -1;   ///< of the other face: that it lies on
    int otherVertex = -1; ///< corner of the other face
    int nextEdge = -1;    ///< side of the face that is clipped, or -1:
    int nextSide = -1;    ///< side of the other
};

/// The corner between two sides of a face that follow each other; -1 where they do not.
int cornerBetween(int side, int other, int count)
{
    return (side + 1) % count == other ? other : (other + 1) % count == side ? side : -1;
}

/// Cuts off what lies outside one side of the face. \param inward from the side, of length one
std::vector<Corner> clipped(const std::vector<Corner>& polygon, const Vector<3>& start,
                            const Vector<3>& inward, int side, int sides, double tolerance)
{
    std::vector<Corner> kept;
    for (std::size_t i = 0; i < polygon.size(); ++i)
    {
        const Corner& here = polygon[i];
        const Corner& next = polygon[(i + 1) % polygon.size()];
        const double inside = inward.dot(here.place - start);
        const double nextInside = inward.dot(next.place - start);
        const bool isKept = inside >= -tolerance;
        const bool isNextKept = nextInside >= -tolerance;
        if (isKept)
        {
            kept.push_back(here);
        }
        if (isKept == isNextKept)
        {
            continue;
        }
        const double part = std::clamp(inside / (inside - nextInside), 0.0, 1.0);
        Corner cut;
        cut.place = here.place + part * (next.place - here.place);
        cut.side = side;
        if (here.nextSide >= 0) // along a side of the face: its corner
        {
            cut.otherVertex = cornerBetween(here.nextSide, side, sides);
        }
        else
        {
            cut.edge = here.nextEdge;
            const double before = here.vertex >= 0 ? 0 : here.part;
            const double after = next.edge == here.nextEdge && next.vertex < 0 ? next.part : 1;
            cut.part = before + part * (after - before);
        }
        cut.nextEdge = isKept ? -1 : here.nextEdge;
        cut.nextSide = isKept ? side : here.nextSide;
        kept.push_back(cut);
    }
    return kept;
}

double widthOf(const std::vector<Corner>& polygon, const Vector<3>& normal)
{
    Vector<3> area = Vector<3>::Zero();
    double extent = 0;
    for (std::size_t i = 1; i + 1 < polygon.size(); ++i)
    {
        area += 0.5 * (polygon[i].place - polygon[0].place).cross(polygon[i + 1].place - polygon[0].place);
    }
    for (const Corner& a : polygon)
    {
        for (const Corner& b : polygon)
        {
            extent = std::max(extent, (a.place - b.place).norm());
        }
    }
    return extent > 0 ? std::abs(area.dot(normal)) / extent : 0;
}

/// The face of a solid that looks at a plane: of those at its foremost vertices the one most against it.
int faceLookingAt(const ConvexSolid& solid, const Vector<3>& normal, double tolerance)
{
    double least = infinite;
    for (const Vector<3>& vertex : solid.vertices)
    {
        least = std::min(least, normal.dot(vertex));
    }
    int best = -1;
    double most = infinite;
    for (int face = 0; face < static_cast<int>(solid.faces.size()); ++face)
    {
        const std::vector<int>& round = solid.faces[static_cast<std::size_t>(face)];
        const bool isForemost = std::any_of(
            round.begin(), round.end(),
            [&](int vertex)
            { return normal.dot(solid.vertices[static_cast<std::size_t>(vertex)]) <= least + tolerance; });
        const double against = solid.normals[static_cast<std::size_t>(face)].dot(normal);
        if (isForemost && against < most)
        {
            most = against;
            best = face;
        }
    }
    return best;
}

/// What two faces have in common, seen along the normal of the first; empty where that is narrower than the
/// tolerance.
std::vector<Corner> sharedPolygon(const ConvexSolid& solid, int face, const ConvexSolid& other, int otherFace,
                                  double tolerance)
{
    const Vector<3>& normal = solid.normals[static_cast<std::size_t>(face)];
    const std::vector<int>& round = solid.faces[static_cast<std::size_t>(face)];
    const std::vector<int>& otherRound = other.faces[static_cast<std::size_t>(otherFace)];
    std::vector<Corner> polygon;
    for (int i = 0; i < static_cast<int>(otherRound.size()); ++i)
    {
        Corner corner;
        corner.vertex = otherRound[static_cast<std::size_t>(i)];
        corner.place = other.vertices[static_cast<std::size_t>(corner.vertex)];
        corner.nextEdge = i;
        polygon.push_back(corner);
    }
    const int sides = static_cast<int>(round.size());
    for (int side = 0; side < sides && polygon.size() > 2; ++side)
    {
        const Vector<3>& start =
            solid.vertices[static_cast<std::size_t>(round[static_cast<std::size_t>(side)])];
        const Vector<3>& end =
            solid.vertices[static_cast<std::size_t>(round[static_cast<std::size_t>((side + 1) % sides)])];
        polygon = clipped(polygon, start, normal.cross(end - start).normalized(), side, sides, tolerance);
    }
    const bool isWide = polygon.size() > 2 && widthOf(polygon, normal) > 2 * tolerance;
    return isWide ? polygon : std::vector<Corner>();
}

/// Those of its corners that are apart: corners of the faces before crossings of their edges.
std::vector<Corner> cornersApart(const std::vector<Corner>& polygon, double distance)
{
    std::vector<Corner> apart;
    for (const bool isCrossing : {false, true})
    {
        for (const Corner& corner : polygon)
        {
            const bool isOfAFace = corner.vertex >= 0 || corner.otherVertex >= 0;
            const auto isNear = [&](const Corner& other)
            { return (other.place - corner.place).norm() <= distance; };
            if (isOfAFace != isCrossing && (isOfAFace || corner.edge >= 0)
                && std::none_of(apart.begin(), apart.end(), isNear))
            {
                apart.push_back(corner);
            }
        }
    }
    return apart;
}

/// Which of two solids a face belongs to.
enum class FaceOf
{
    first,
    second
};

/// What meets at corners of a shared polygon. \param faceOf whose face the first is
std::vector<ConvexContact> contactsAtCorners(const std::vector<Corner>& corners, const ConvexSolid& solid,
                                             int face, FaceOf faceOf, const ConvexSolid& other, int otherFace)
{
    const bool isOfFirst = faceOf == FaceOf::first;
    const std::vector<int>& round = solid.faces[static_cast<std::size_t>(face)];
    const std::vector<int>& otherRound = other.faces[static_cast<std::size_t>(otherFace)];
    const auto at = [](const std::vector<int>& vertices, int index)
    { return vertices[static_cast<std::size_t>(index) % vertices.size()]; };
    std::vector<ConvexContact> contacts;
    for (const Corner& corner : corners)
    {
        if (corner.vertex >= 0)
        {
            contacts.push_back({!isOfFirst, corner.vertex, corner.vertex, 0, face, -1, false});
        }
        else if (corner.otherVertex >= 0)
        {
            const int vertex = at(round, corner.otherVertex);
            contacts.push_back({isOfFirst, vertex, vertex, 0, otherFace, -1, false});
        }
        else
        {
            const int crossed = edgeBetween(solid, at(round, corner.side), at(round, corner.side + 1));
            contacts.push_back({!isOfFirst, at(otherRound, corner.edge), at(otherRound, corner.edge + 1),
                                corner.part, face, crossed, false});
        }
    }
    return contacts;
}

/// \param solid whose face parts the two \param faceOf which of the two it is
std::vector<ConvexContact> contactsOfFace(const ConvexSolid& solid, int face, FaceOf faceOf,
                                          const ConvexSolid& other, double tolerance)
{
    const Vector<3>& normal = solid.normals[static_cast<std::size_t>(face)];
    const Vector<3>& onFace = pointOf(solid, face);
    std::vector<ConvexContact> contacts;
    double nearest = infinite;
    const auto add = [&](int otherFace)
    {
        const std::vector<Corner> corners =
            cornersApart(sharedPolygon(solid, face, other, otherFace, tolerance), asOnePoint * tolerance);
        for (const Corner& corner : corners)
        {
            nearest = std::min(nearest, normal.dot(corner.place - onFace));
        }
        for (const ConvexContact& contact : contactsAtCorners(corners, solid, face, faceOf, other, otherFace))
        {
            if (std::find(contacts.begin(), contacts.end(), contact) == contacts.end())
            {
                contacts.push_back(contact);
            }
        }
    };
    add(faceLookingAt(other, normal, tolerance));
    if (nearest <= leastAlong(other, normal, onFace) + tolerance)
    {
        return contacts;
    }
    // What is foremost is beside the face: any other that looks at it may enter it at its rim, and deeper.
    for (int otherFace = 0; otherFace < static_cast<int>(other.faces.size()); ++otherFace)
    {
        if (other.normals[static_cast<std::size_t>(otherFace)].dot(normal) < 0)
        {
            add(otherFace);
        }
    }
    return contacts;
}

/// Where two edges cross, seen along the normal of both.
std::vector<ConvexContact> contactOfEdges(const ConvexSolid& first, const ConvexSolid& second,
                                          const PartingAxis& axis)
{
    const ConvexSolid::Edge& edge = first.edges[static_cast<std::size_t>(axis.edge)];
    const ConvexSolid::Edge& other = second.edges[static_cast<std::size_t>(axis.otherEdge)];
    const Vector<3>& from = first.vertices[static_cast<std::size_t>(edge.from)];
    const Vector<3> along = first.vertices[static_cast<std::size_t>(edge.to)] - from;
    const Vector<3>& otherFrom = second.vertices[static_cast<std::size_t>(other.from)];
    const Vector<3> otherAlong = second.vertices[static_cast<std::size_t>(other.to)] - otherFrom;
    const Vector<3> across = along.cross(otherAlong);
    const double part = (otherFrom - from).cross(otherAlong).dot(across) / across.squaredNorm();
    const double otherPart = (otherFrom - from).cross(along).dot(across) / across.squaredNorm();
    if (part < 0 || part > 1 || otherPart < 0 || otherPart > 1)
    {
        return {};
    }
    return {{true, edge.from, edge.to, part, other.face, axis.otherEdge, true}};
}

/// Whether two edges part the solids nearly along the normal of the face that parts them most.
bool isAlongFace(const PartingAxis& axis, const ConvexSolid& first, const ConvexSolid& second)
{
    const auto directionOf = [](const ConvexSolid& solid, int index)
    {
        const ConvexSolid::Edge& edge = solid.edges[static_cast<std::size_t>(index)];
        return Vector<3>(solid.vertices[static_cast<std::size_t>(edge.to)]
                         - solid.vertices[static_cast<std::size_t>(edge.from)]);
    };
    const Vector<3> across = directionOf(first, axis.edge).cross(directionOf(second, axis.otherEdge));
    const ConvexSolid& solid = axis.isOfFirst ? first : second;
    return std::abs(across.dot(solid.normals[static_cast<std::size_t>(axis.face)]))
           > nearlyAlong * across.norm();
}

} // namespace

PartingAxis partingAxis(const ConvexSolid& first, const ConvexSolid& second, double tolerance,
                        SharedEdge sharedEdge)
{
    PartingAxis axis = faceAxis(first, second, tolerance, sharedEdge);
    if (!axis.isAnEdgeAtMost)
    {
        takeEdges(first, second, tolerance, axis);
    }
    return axis;
}

std::vector<ConvexContact> contactsAlong(const PartingAxis& axis, const ConvexSolid& first,
                                         const ConvexSolid& second, double tolerance,
                                         EdgesAlongFaces edgesAlongFaces)
{
    if (axis.isAnEdgeAtMost)
    {
        return {};
    }
    const bool areFaces = edgesAlongFaces == EdgesAlongFaces::faces && axis.edge >= 0
                          && axis.distance < -tolerance && isAlongFace(axis, first, second);
    if (axis.edge >= 0 && !areFaces)
    {
        if (std::vector<ConvexContact> found = contactOfEdges(first, second, axis); !found.empty())
        {
            return found;
        }
    }
    return axis.isOfFirst ? contactsOfFace(first, axis.face, FaceOf::first, second, tolerance)
                          : contactsOfFace(second, axis.face, FaceOf::second, first, tolerance);
}

} // namespace drystone
