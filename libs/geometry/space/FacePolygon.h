// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// A face of a polyhedron as a polygon in its own plane, where the geometry of the plane applies.
#pragma once

#include "geometry/Polygon.h"
#include "geometry/space/Polyhedron.h"

namespace drystone
{

/// A face seen along its normal.
struct FacePolygon
{
    Vector<3> origin = Vector<3>::Zero(); ///< a point of the plane: the mean of the corners [m]
    Eigen::Matrix3d frame =
        Eigen::Matrix3d::Identity(); ///< columns: outward normal, and the axes of the outline
    Polygon outline;                 ///< counter-clockwise seen from outside [m]
};

/// \param face corners by index, counter-clockwise seen from outside; not plane: seen along its area vector
FacePolygon facePolygon(const Polyhedron& polyhedron, const std::vector<int>& face);

/// The coordinates of a point in the axes of the outline, seen along the normal [m].
inline Vector<2> inPlane(const FacePolygon& face, const Vector<3>& point)
{
    const Vector<3> arm = point - face.origin;
    return {face.frame.col(1).dot(arm), face.frame.col(2).dot(arm)};
}

/// Distance of a point from the nearest face [m], inside the solid too.
double distanceFromSurface(const Polyhedron& polyhedron, const Vector<3>& point);

/// Distance of a point from the solid [m]: 0 inside and on it.
double distance(const Polyhedron& polyhedron, const Vector<3>& point);

} // namespace drystone
