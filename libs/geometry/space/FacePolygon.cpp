// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Faces in their planes, and the distance of points from them.
#include "geometry/space/FacePolygon.h"

#include "geometry/PolygonShape.h"
#include "geometry/space/Frame.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace drystone
{

FacePolygon facePolygon(const Polyhedron& polyhedron, const std::vector<int>& face)
{
    FacePolygon result;
    for (const int corner : face)
    {
        result.origin += polyhedron.vertices[corner] / static_cast<double>(face.size());
    }
    result.frame = frameOf(areaVector(polyhedron, face).normalized());
    result.outline.reserve(face.size());
    for (const int corner : face)
    {
        result.outline.push_back(inPlane(result, polyhedron.vertices[corner]));
    }
    return result;
}

namespace
{

/// Solid angle of a triangle seen from the origin, with the sign of its turn (Van Oosterom & Strackee 1983).
double solidAngle(const Vector<3>& a, const Vector<3>& b, const Vector<3>& c)
{
    const double la = a.norm();
    const double lb = b.norm();
    const double lc = c.norm();
    return 2 * std::atan2(a.dot(b.cross(c)), la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
}

} // namespace

double distanceFromSurface(const Polyhedron& polyhedron, const Vector<3>& point)
{
    double least = std::numeric_limits<double>::max();
    for (const std::vector<int>& corners : polyhedron.faces)
    {
        const FacePolygon face = facePolygon(polyhedron, corners);
        const double height = face.frame.col(0).dot(point - face.origin);
        least = std::min(
            least, std::hypot(height, std::max(0.0, signedDistance(face.outline, inPlane(face, point)))));
    }
    return least;
}

double distance(const Polyhedron& polyhedron, const Vector<3>& point)
{
    // From inside all faces together are seen under the full angle, from outside under none. The triangles of
    // a face in whose plane the point lies are seen under 0 or half the full angle, with a sign of rounding:
    // left out, as where the point is on such a face itself it has half the angle by the others.
    constexpr double inPlaneOf = 1e-9;
    double angle = 0;
    for (const std::vector<int>& corners : polyhedron.faces)
    {
        const Vector<3> fromPoint = polyhedron.vertices[corners[0]] - point;
        if (std::abs(areaVector(polyhedron, corners).normalized().dot(fromPoint))
            <= inPlaneOf * fromPoint.norm())
        {
            continue;
        }
        for (std::size_t i = 1; i + 1 < corners.size(); ++i)
        {
            angle +=
                solidAngle(polyhedron.vertices[corners[0]] - point, polyhedron.vertices[corners[i]] - point,
                           polyhedron.vertices[corners[i + 1]] - point);
        }
    }
    return angle > 2 * std::numbers::pi ? 0 : distanceFromSurface(polyhedron, point);
}

} // namespace drystone
