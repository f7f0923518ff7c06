// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The shape of a block of space: its polyhedron.
#include "assembly/BlockShape.h"

#include "geometry/BroadPhase.h"
#include "geometry/space/FacePolygon.h"

#include <cmath>

namespace drystone
{

template<>
Box<3> boundingBox(const Block<3>& block)
{
    return boundingBox(block.shape);
}

double distanceFrom(const Block<3>& block, const Vector<3>& point)
{
    return distance(block.shape, point);
}

std::vector<double> placesToCut(const Block<3>& block, const Vector<3>& from, const Vector<3>& along)
{
    // At the planes of the faces, and near the corners.
    std::vector<double> places;
    for (const Vector<3>& vertex : block.shape.vertices)
    {
        places.push_back((vertex - from).dot(along) / along.squaredNorm());
    }
    for (const std::vector<int>& face : block.shape.faces)
    {
        const Vector<3> normal = areaVector(block.shape, face).normalized();
        if (const double slope = normal.dot(along); std::abs(slope) > 1e-12 * along.norm())
        {
            places.push_back(normal.dot(block.shape.vertices[static_cast<std::size_t>(face.front())] - from)
                             / slope);
        }
    }
    return places;
}

} // namespace drystone
