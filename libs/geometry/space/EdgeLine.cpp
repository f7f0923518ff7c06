// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Nearest points of lines, and of segments of them.
#include "geometry/space/EdgeLine.h"

#include <Eigen/Geometry>

#include <algorithm>

namespace drystone
{

std::vector<EdgeLine> edgesOf(const Polyhedron& polyhedron)
{
    std::vector<EdgeLine> edges;
    for (const std::vector<int>& face : polyhedron.faces)
    {
        for (std::size_t i = 0; i < face.size(); ++i)
        {
            const int next = face[(i + 1) % face.size()];
            if (face[i] < next) // each belongs to two faces
            {
                const Vector<3>& start = polyhedron.vertices[face[i]];
                edges.push_back({start, polyhedron.vertices[next] - start});
            }
        }
    }
    return edges;
}

std::optional<double> nearestToLine(const EdgeLine& edge, const EdgeLine& other)
{
    // From nearest point to nearest point is perpendicular to both lines, along their normal: the rest of the
    // way from start to start lies in the plane of both.
    constexpr double parallel = 1e-9;
    const Vector<3> normal = edge.along.cross(other.along);
    if (!(normal.norm() > parallel * edge.along.norm() * other.along.norm()))
    {
        return {};
    }
    return (other.start - edge.start).cross(other.along).dot(normal) / normal.squaredNorm();
}

double distance(const EdgeLine& one, const EdgeLine& other)
{
    // Where the lines are nearest beyond the end of one edge, that end is nearest (Ericson, Real-Time
    // Collision Detection, 2004, 5.1.9). Of parallel edges any part of the first will do to begin with.
    double part = std::clamp(nearestToLine(one, other).value_or(0), 0.0, 1.0);
    const double ofOther = std::clamp(other.nearest(one.at(part)), 0.0, 1.0);
    part = std::clamp(one.nearest(other.at(ofOther)), 0.0, 1.0);
    return (one.at(part) - other.at(ofOther)).norm();
}

} // namespace drystone
