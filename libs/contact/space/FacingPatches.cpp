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
};

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

void findPatches(const Assembly<3>& assembly, const Face& a, const Face& b, const FacingTolerance& tolerance,
                 std::vector<FacingPatch>& patches)
{
    const Vector<3> difference = a.normal - b.normal;
    const Vector<3> normal = difference.normalized(); // out of a's block
    // Faces apart are most of the pairs: the boxes of a wall's side meet those of its bed joints.
    if ((a.normal + b.normal).norm() > tolerance.angle)
    {
        return;
    }
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
        FacingPatch patch{a.block, b.block, a.index, b.index, {}, {}, -normal};
        bool isNear = true;
        for (const Vector<2>& corner : part)
        {
            const Vector<3> point = origin + corner.x() * frame.col(1) + corner.y() * frame.col(2);
            const double heightA = heightAt(a, point, normal);
            const double heightB = heightAt(b, point, normal);
            isNear = isNear && std::abs(heightB - heightA) <= tolerance.distance;
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

double meanBlockSize(const Assembly<3>& assembly)
{
    double volume = 0;
    int count = 0;
    for (const Block<3>& block : assembly.blocks)
    {
        if (block.support < 0)
        {
            volume += std::abs(volumeProperties(block.shape).volume);
            ++count;
        }
    }
    return count > 0 ? std::cbrt(volume / count) : 0;
}

std::vector<FacingPatch> findFacingPatches(const Assembly<3>& assembly, const FacingTolerance& tolerance)
{
    std::vector<Face> faces;
    std::vector<Box<3>> boxes;
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
            Face face{static_cast<int>(block), static_cast<int>(i), area.normalized()};
            Box<3> box;
            for (const int corner : shape.faces[i])
            {
                face.centre += shape.vertices[corner];
                extend<3>(box, shape.vertices[corner]);
            }
            face.centre /= static_cast<double>(shape.faces[i].size());
            faces.push_back(face);
            boxes.push_back(enlarged(box, tolerance.distance));
        }
    }

    std::vector<FacingPatch> patches;
    for (const auto& [first, second] : findMeetingPairs(boxes))
    {
        const Face& a = faces[first]; // faces are in block order: a's block comes first
        const Face& b = faces[second];
        const bool bothFixed = assembly.blocks[a.block].support >= 0 && assembly.blocks[b.block].support >= 0;
        if (a.block != b.block && !bothFixed)
        {
            findPatches(assembly, a, b, tolerance, patches);
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
