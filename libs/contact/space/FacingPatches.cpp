// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The search for faces that face each other.
#include "contact/space/FacingPatches.h"

#include "geometry/BroadPhase.h"
#include "geometry/PolygonIntersection.h"
#include "geometry/space/Frame.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace drystone
{

namespace
{

struct Face
{
    int block = -1;
    int index = -1;                       ///< in the block's shape
    Vector<3> normal = Vector<3>::Zero(); ///< outward
    Vector<3> centre = Vector<3>::Zero(); ///< mean of the corners
    double width = 0;                     ///< area over the longest extent [m]
    bool isOblique = false;               ///< not parallel to two axes
    Box<3> box;                           ///< with the distance at which faces still meet
};

/// All faces that are large enough to have a patch, block by block.
std::vector<Face> facesOf(const Assembly<3>& assembly, const FacingTolerance& tolerance)
{
    std::vector<Face> faces;
    const double reach = std::max(tolerance.distance, tolerance.oblique);
    for (std::size_t block = 0; block < assembly.blocks.size(); ++block)
    {
        const Polyhedron& shape = assembly.blocks[block].shape;
        for (std::size_t i = 0; i < shape.faces.size(); ++i)
        {
            const Vector<3> area = areaVector(shape, shape.faces[i]);
            if (area.squaredNorm() <= std::pow(tolerance.leastLength, 4))
            {
                continue;
            }
            Face face;
            face.block = static_cast<int>(block);
            face.index = static_cast<int>(i);
            face.normal = area.normalized();
            for (const int corner : shape.faces[i])
            {
                face.centre += shape.vertices[corner];
                extend<3>(face.box, shape.vertices[corner]);
            }
            face.centre /= static_cast<double>(shape.faces[i].size());
            const Vector<3> extent = face.box.upper - face.box.lower;
            face.width = area.norm() / extent.norm();
            face.isOblique = extent.minCoeff() > 0;
            face.box = enlarged(face.box, reach);
            faces.push_back(face);
        }
    }
    return faces;
}

/// The corners of a face in the plane of a frame, counter-clockwise seen against the frame's normal.
Polygon projected(const Polyhedron& shape, const Face& face, const Vector<3>& origin,
                  const Eigen::Matrix3d& frame)
{
    const std::vector<int>& corners = shape.faces[face.index];
    Polygon polygon;
    polygon.reserve(corners.size());
    for (const int corner : corners)
    {
        const Vector<3> arm = shape.vertices[corner] - origin;
        polygon.emplace_back(frame.col(1).dot(arm), frame.col(2).dot(arm));
    }
    return polygon;
}

/// Height of a face's plane above a point of the frame's plane, along the frame's normal.
double heightAt(const Face& face, const Vector<3>& point, const Vector<3>& normal)
{
    return face.normal.dot(face.centre - point) / face.normal.dot(normal);
}

/// By how much the normals of faces may differ whose corners may be off by the tolerance of oblique faces.
double angleOf(const Face& a, const Face& b, const FacingTolerance& tolerance)
{
    return std::max(tolerance.angle, 4 * tolerance.oblique / std::min(a.width, b.width));
}

void findPatches(const Assembly<3>& assembly, const Face& a, const Face& b, const FacingTolerance& tolerance,
                 std::vector<FacingPatch>& patches)
{
    const bool isOblique = a.isOblique || b.isOblique;
    const bool isWider = isOblique && tolerance.oblique > tolerance.distance;
    const double distance = isWider ? tolerance.oblique : tolerance.distance;
    if ((a.normal + b.normal).norm() > (isWider ? angleOf(a, b, tolerance) : tolerance.angle))
    {
        return;
    }
    const Vector<3> normal = (a.normal - b.normal).normalized(); // out of a's block
    const Polyhedron& shapeA = assembly.blocks[a.block].shape;
    const Polyhedron& shapeB = assembly.blocks[b.block].shape;
    // Coordinates from a corner, so that a structure far from the origin keeps its digits.
    const Vector<3>& origin = shapeA.vertices[shapeA.faces[a.index].front()];
    const Eigen::Matrix3d frame = frameOf(normal);
    const Polygon polygonA = projected(shapeA, a, origin, frame);
    Polygon polygonB = projected(shapeB, b, origin, frame);
    std::reverse(polygonB.begin(), polygonB.end());
    for (const Polygon& part : intersection(polygonA, polygonB, tolerance.leastLength))
    {
        FacingPatch patch{a.block, b.block, a.index, b.index, {}, {}, -normal, isOblique};
        bool isNear = true;
        for (const Vector<2>& corner : part)
        {
            const Vector<3> point = origin + corner.x() * frame.col(1) + corner.y() * frame.col(2);
            const double heightA = heightAt(a, point, normal);
            const double heightB = heightAt(b, point, normal);
            isNear = isNear && std::abs(heightB - heightA) <= distance;
            patch.corners.emplace_back(point + (heightA + heightB) / 2 * normal);
            patch.gaps.push_back(heightB - heightA);
        }
        if (isNear)
        {
            patches.push_back(std::move(patch));
        }
    }
}

} // namespace

std::vector<FacingPatch> findFacingPatches(const Assembly<3>& assembly, const FacingTolerance& tolerance)
{
    const std::vector<Face> faces = facesOf(assembly, tolerance);
    double angle = tolerance.angle;
    if (tolerance.oblique > tolerance.distance)
    {
        for (const Face& face : faces)
        {
            angle = std::max(angle, angleOf(face, face, tolerance));
        }
    }
    std::vector<FacingPatch> patches;
    for (int axis = 0; axis < 3; ++axis)
    {
        // Faces that face each other have opposite normals: the search is one between those that look along
        // an axis and those that look against it, and leaves out the sides and the neighbours in the same
        // plane.
        std::vector<int> indices[2];
        std::vector<Box<3>> boxes[2];
        for (std::size_t i = 0; i < faces.size(); ++i)
        {
            if (std::abs(faces[i].normal[axis]) >= faces[i].normal.cwiseAbs().maxCoeff() - 2 * angle)
            {
                const int side = faces[i].normal[axis] > 0 ? 0 : 1;
                indices[side].push_back(static_cast<int>(i));
                boxes[side].push_back(faces[i].box);
            }
        }
        for (const auto& [positive, negative] : findMeetingPairs<3>(boxes[0], boxes[1]))
        {
            const int one = indices[0][positive];
            const int other = indices[1][negative];
            const Face& a = faces[std::min(one, other)]; // faces are in block order: a's block comes first
            const Face& b = faces[std::max(one, other)];
            // Faces between two axes are met along both of them, and count along one.
            int axisOfPair = 0;
            (a.normal - b.normal).cwiseAbs().maxCoeff(&axisOfPair);
            const bool bothFixed =
                assembly.blocks[a.block].support >= 0 && assembly.blocks[b.block].support >= 0;
            if (a.block != b.block && axisOfPair == axis && !bothFixed)
            {
                findPatches(assembly, a, b, tolerance, patches);
            }
        }
    }
    std::stable_sort(patches.begin(), patches.end(),
                     [](const FacingPatch& a, const FacingPatch& b)
                     {
                         return std::tuple(a.block, a.neighbour, a.face, a.neighbourFace)
                                < std::tuple(b.block, b.neighbour, b.face, b.neighbourFace);
                     });
    return patches;
}

} // namespace drystone
