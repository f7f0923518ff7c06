// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// In the plane corners at one place are kept; in space patches are found anew where blocks are now, and
/// those too deep are of the far side and left out.
#include "statics/PushoverContacts.h"

#include "assembly/BlockShape.h"
#include "contact/EdgeNormal.h"
#include "contact/space/FacingPatches.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace drystone
{
namespace
{

constexpr double farthestTurn = 0.85; ///< of two faces from facing each other: |n1 + n2|, 50 degrees

/// Contacts leave overlaps of the order of the square of a step. Relative to the mean block size.
constexpr double mayEnter = 0.05;

Eigen::Matrix3d matrixOf(const Vector<3>& rotation)
{
    const double angle = rotation.norm();
    return angle > 0 ? Eigen::AngleAxisd(angle, rotation / angle).toRotationMatrix()
                     : Eigen::Matrix3d(Eigen::Matrix3d::Identity());
}

/// The least width across a face [m].
double thicknessOf(const Polyhedron& shape)
{
    double thickness = std::numeric_limits<double>::infinity();
    for (const std::vector<int>& face : shape.faces)
    {
        const Vector<3> normal = areaVector(shape, face).normalized();
        double least = std::numeric_limits<double>::infinity();
        double most = -least;
        for (const Vector<3>& vertex : shape.vertices)
        {
            least = std::min(least, normal.dot(vertex));
            most = std::max(most, normal.dot(vertex));
        }
        thickness = std::min(thickness, most - least);
    }
    return thickness;
}

/// Whether a point lies on the normal through another one.
bool isAcross(const Vector<3>& one, const Vector<3>& other, const Vector<3>& normal, double tolerance)
{
    const Vector<3> arm = one - other;
    return (arm - normal.dot(arm) * normal).norm() <= tolerance;
}

/// The vertex of a face across a corner of a patch; null: none is.
const Vector<3>* vertexAcross(const Polyhedron& shape, int face, const Vector<3>& corner,
                              const Vector<3>& normal, double tolerance)
{
    for (const int index : shape.faces[static_cast<std::size_t>(face)])
    {
        const Vector<3>& vertex = shape.vertices[static_cast<std::size_t>(index)];
        if (isAcross(vertex, corner, normal, tolerance))
        {
            return &vertex;
        }
    }
    return nullptr;
}

/// Direction of the edge of a face that passes a corner of a patch nearest.
Vector<3> edgeAcross(const Polyhedron& shape, int face, const Vector<3>& corner, const Vector<3>& normal)
{
    const std::vector<int>& indices = shape.faces[static_cast<std::size_t>(face)];
    double nearest = std::numeric_limits<double>::infinity();
    Vector<3> direction = Vector<3>::Zero();
    for (std::size_t i = 0; i < indices.size(); ++i)
    {
        const Vector<3>& from = shape.vertices[static_cast<std::size_t>(indices[i])];
        const Vector<3>& to = shape.vertices[static_cast<std::size_t>(indices[(i + 1) % indices.size()])];
        const Vector<3> side = normal.cross(to - from).normalized();
        const double distance = std::abs(side.dot(corner - from));
        if (distance < nearest)
        {
            nearest = distance;
            direction = (to - from).normalized();
        }
    }
    return direction;
}

Vector<3> faceNormal(const Polyhedron& shape, int face)
{
    return areaVector(shape, shape.faces[static_cast<std::size_t>(face)]).normalized();
}

/// Of two edges that cross: across both of them. Edges that are nearly parallel have no such direction.
Vector<3> acrossEdges(const Vector<3>& one, const Vector<3>& other, const Vector<3>& between)
{
    constexpr double parallel = 1e-3;
    const Vector<3> across = one.cross(other);
    return across.norm() > parallel ? Vector<3>(std::copysign(1.0, across.dot(between)) * across.normalized())
                                    : between;
}

/// Corner and edge of a point of the plane.
struct CornerAndEdge
{
    Vector<2> corner = Vector<2>::Zero();
    Vector<2> from = Vector<2>::Zero(); ///< ends of the edge
    Vector<2> to = Vector<2>::Zero();
    bool isOfBlock = true; ///< the corner

    /// Whether the corner is at an end of the edge.
    bool isAtEnd(double distance) const
    {
        return std::min((corner - from).norm(), (corner - to).norm()) <= distance;
    }
};

CornerAndEdge cornerAndEdgeOf(const Assembly<2>& asBuilt, const std::vector<Placement<2>>& placements,
                              const ContactPoint<2>& point)
{
    const auto cornersOf = [&](int block)
    {
        const auto index = static_cast<std::size_t>(block);
        return placedCorners(asBuilt.blocks[index], placements[index]);
    };
    CornerAndEdge found;
    found.isOfBlock = point.feature.vertexBlock == point.block;
    const auto corners = cornersOf(found.isOfBlock ? point.block : point.neighbour);
    const auto outline = cornersOf(found.isOfBlock ? point.neighbour : point.block);
    const auto edge = static_cast<std::size_t>(point.feature.edge);
    found.corner = corners[static_cast<std::size_t>(point.feature.vertex)];
    found.from = outline[edge];
    found.to = outline[(edge + 1) % outline.size()];
    return found;
}

/// Sets position, normal and gap.
void setPoint(const CornerAndEdge& now, ContactPoint<2>& point)
{
    const Vector<2> outward = outwardNormal((now.to - now.from).normalized());
    point.position = now.corner;
    point.normal = now.isOfBlock ? outward : Vector<2>(-outward);
    point.gap = outward.dot(now.corner - now.from);
}

} // namespace

PushoverContacts<2>::PushoverContacts(const Assembly<2>& assembly)
    : asBuilt(assembly), contacts(assembly), onePlace(1e-5 * meanBlockSize(assembly))
{
}

std::vector<ContactPoint<2>> PushoverContacts<2>::update(const std::vector<Placement<2>>& placements,
                                                         double margin)
{
    std::vector<ContactPoint<2>> points = contacts.update(placements, margin);
    kept.clear();
    for (ContactPoint<2>& point : lastPoints)
    {
        const CornerAndEdge now = cornerAndEdgeOf(asBuilt, placements, point);
        const auto isThere = [&](const ContactPoint<2>& other)
        {
            return other.block == point.block && other.neighbour == point.neighbour
                   && (other.position - now.corner).norm() <= onePlace;
        };
        if (now.isAtEnd(onePlace) && std::none_of(points.begin(), points.end(), isThere))
        {
            setPoint(now, point);
            point.joint = points.empty() ? 0 : points.back().joint + 1;
            points.push_back(point);
            kept.push_back(point);
        }
    }
    lastPoints = points;
    return points;
}

void PushoverContacts<2>::measure(const std::vector<Placement<2>>& placements,
                                  std::vector<ContactPoint<2>>& points) const
{
    contacts.measure(placements, points);
    for (ContactPoint<2> point : kept)
    {
        setPoint(cornerAndEdgeOf(asBuilt, placements, point), point);
        points.push_back(point);
    }
}

PushoverContacts<3>::PushoverContacts(const Assembly<3>& assembly)
    : asBuilt(assembly), lastPlacements(assembly.blocks.size())
{
    for (const BlockMass<3>& mass : blockMasses(assembly))
    {
        centres.push_back(mass.centroid);
    }
    for (const Block<3>& block : assembly.blocks)
    {
        // Like contacts of motion: up to a quarter of the thinner block. Farther in is its other side.
        deepest.push_back(thicknessOf(block.shape) / 4);
    }
}

std::vector<ContactPoint<3>> PushoverContacts<3>::update(const std::vector<Placement<3>>& placements,
                                                         double margin)
{
    lastPlacements = placements;
    Assembly<3> now = asBuilt;
    for (std::size_t block = 0; block < now.blocks.size(); ++block)
    {
        now.blocks[block].shape = placedShape(asBuilt.blocks[block], placements[block]);
    }
    const double size = meanBlockSize(asBuilt);
    FacingTolerance tolerance;
    tolerance.distance = margin;
    tolerance.angle = farthestTurn;
    tolerance.straight = 1e-6 * size;
    tolerance.leastLength = 1e-6 * size;
    std::vector<ContactPoint<3>> points;
    touches.clear();
    int joint = 0;
    for (const FacingPatch& patch : findFacingPatches(now, tolerance))
    {
        const double depth = std::min(deepest[static_cast<std::size_t>(patch.block)],
                                      deepest[static_cast<std::size_t>(patch.neighbour)]);
        if (*std::min_element(patch.gaps.begin(), patch.gaps.end()) < -depth)
        {
            continue;
        }
        for (std::size_t corner = 0; corner < patch.corners.size(); ++corner)
        {
            points.push_back({patch.block, patch.neighbour, joint, patch.corners[corner], patch.normal,
                              patch.gaps[corner], ContactFeature{}});
            touches.push_back(setTouch(now, patch, tolerance.leastLength, points.back()));
        }
        ++joint;
    }
    return points;
}

PushoverContacts<3>::Touch PushoverContacts<3>::setTouch(const Assembly<3>& now, const FacingPatch& patch,
                                                         double tolerance, ContactPoint<3>& point)
{
    const Polyhedron& own = now.blocks[static_cast<std::size_t>(patch.block)].shape;
    const Polyhedron& other = now.blocks[static_cast<std::size_t>(patch.neighbour)].shape;
    const Vector<3>* const ofBlock = vertexAcross(own, patch.face, point.position, patch.normal, tolerance);
    const Vector<3>* const ofNeighbour =
        vertexAcross(other, patch.neighbourFace, point.position, patch.normal, tolerance);
    Touch touch = Touch::edges;
    if (ofBlock) // also where corners of both are at one place, as in the plane
    {
        touch = Touch::cornerOfBlock;
        point.position = *ofBlock;
        point.normal = faceNormal(other, patch.neighbourFace);
    }
    else if (ofNeighbour)
    {
        touch = Touch::cornerOfNeighbour;
        point.position = *ofNeighbour;
        point.normal = -faceNormal(own, patch.face);
    }
    else
    {
        point.normal =
            acrossEdges(edgeAcross(own, patch.face, point.position, patch.normal),
                        edgeAcross(other, patch.neighbourFace, point.position, patch.normal), patch.normal);
    }
    point.gap *= point.normal.dot(patch.normal); // was along that of the patch
    return touch;
}

void PushoverContacts<3>::measure(const std::vector<Placement<3>>& placements,
                                  std::vector<ContactPoint<3>>& points) const
{
    for (std::size_t i = 0; i < points.size(); ++i)
    {
        ContactPoint<3>& point = points[i];
        std::array<Vector<3>, 2> positions;
        std::array<Vector<3>, 2> normals;
        for (const auto& [side, index] : {std::pair(0, point.block), std::pair(1, point.neighbour)})
        {
            const auto block = static_cast<std::size_t>(index);
            const Vector<3> before = centres[block] + lastPlacements[block].translation;
            const Eigen::Matrix3d turn =
                matrixOf(placements[block].rotation) * matrixOf(lastPlacements[block].rotation).transpose();
            positions[side] =
                centres[block] + placements[block].translation + turn * (point.position - before);
            normals[side] = turn * point.normal;
        }
        switch (touches[i])
        {
        case Touch::cornerOfBlock:
            point.position = positions[0];
            point.normal = normals[1];
            break;
        case Touch::cornerOfNeighbour:
            point.position = positions[1];
            point.normal = normals[0];
            break;
        case Touch::edges:
            point.position = (positions[0] + positions[1]) / 2;
            point.normal = (normals[0] + normals[1]).normalized();
            break;
        }
    }
}

Penetration PushoverContacts<3>::missed(const std::vector<Placement<3>>& placements) const
{
    const Penetration overlap = penetration(asBuilt, placements);
    return overlap.depth > mayEnter * meanBlockSize(asBuilt) ? overlap : Penetration();
}

std::vector<Placement<2>> pushedOn(std::vector<Placement<2>> placements, const std::vector<int>& free,
                                   const Eigen::VectorXd& displacement, double share)
{
    return moved(std::move(placements), free, displacement, share);
}

std::vector<Placement<3>> pushedOn(std::vector<Placement<3>> placements, const std::vector<int>& free,
                                   const Eigen::VectorXd& displacement, double share)
{
    for (std::size_t block = 0; block < free.size(); ++block)
    {
        if (free[block] >= 0)
        {
            placements[block].translation += share * displacement.segment<3>(6 * free[block]);
            const Eigen::Matrix3d turned = matrixOf(share * displacement.segment<3>(6 * free[block] + 3))
                                           * matrixOf(placements[block].rotation);
            const Eigen::AngleAxisd turn(turned);
            placements[block].rotation = turn.angle() * turn.axis();
        }
    }
    return placements;
}

} // namespace drystone
