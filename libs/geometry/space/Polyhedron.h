// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Polyhedra with plane faces, the shape of a block in space, with the integrals that mass and inertia are
/// made of.
#pragma once

#include "geometry/Vector.h"

#include <vector>

namespace drystone
{

/// A solid bounded by plane faces, convex or not. Every face is a simple polygon, given by the indices of its
/// vertices in order round it, counter-clockwise seen from outside (right-hand rule: its normal points out of
/// the solid). Faces have no holes: a face that would have one is split into several.
struct Polyhedron
{
    std::vector<Vector<3>> vertices;     ///< [m]
    std::vector<std::vector<int>> faces; ///< indices into vertices, each face from any vertex on

    friend bool operator==(const Polyhedron&, const Polyhedron&) = default;
};

/// Volume and its first and second moments, which times density are mass and inertia.
struct VolumeProperties
{
    double volume = 0;                                 ///< [m3], positive when the faces are turned outwards
    Vector<3> centroid = Vector<3>::Zero();            ///< [m]
    Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero(); ///< about the centroid, for unit density [m5]
};

/// Volume properties of a closed polyhedron with plane faces, exact but for rounding (divergence theorem,
/// taken about the first vertex to avoid cancellation in a block far from the origin).
VolumeProperties volumeProperties(const Polyhedron& polyhedron);

/// Area vector of a face [m2]: its norm is the area, its direction the outward normal. Exact for concave
/// faces too; for a face that is not plane, of the surface spanned by its edges.
Vector<3> areaVector(const Polyhedron& polyhedron, const std::vector<int>& face);

/// How far vertices of a face are from its plane at most, that through their mean with the normal of the
/// area: more than rounding where a file has few decimals [m].
double unevenness(const Polyhedron& polyhedron);

/// The box between two corners. Faces: bottom, top, front (-y), right (+x), back (+y), left (-x).
/// \param lower smaller than `upper` in each coordinate [m]
Polyhedron makeBox(const Vector<3>& lower, const Vector<3>& upper);

/// A solid between two polygons with the same number of corners, joined corner by corner: a prism, a frustum
/// or a voussoir. Faces: `bottom` reversed, `top`, then the sides, side i between corners i and i + 1. \param
/// bottom seen from `top`, counter-clockwise [m]
Polyhedron makePrism(const std::vector<Vector<3>>& bottom, const std::vector<Vector<3>>& top);

} // namespace drystone
