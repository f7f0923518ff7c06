// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Vectors of the space a structure stands in, and the rows of a rigid body in it: the types that every other
/// library shares.
#pragma once

#include <Eigen/Core>

namespace drystone
{

/// A point or direction in space [m]. In 2D the plane is x-y, gravity along -y, rotations positive
/// counter-clockwise.
template<int Dim>
using Vector = Eigen::Matrix<double, Dim, 1>;

template<int Dim>
inline constexpr int rotationCount = Dim == 2 ? 1 : 3;

/// Rows of one block in every equilibrium equation: forces first, then moments about the block's centroid
/// (ux uy rz in 2D; ux uy uz rx ry rz in 3D).
template<int Dim>
inline constexpr int freedomCount = Dim + rotationCount<Dim>;

/// z component of the cross product of two plane vectors.
inline double cross(const Vector<2>& a, const Vector<2>& b)
{
    return a.x() * b.y() - a.y() * b.x();
}

/// The vector turned by +90 degrees.
inline Vector<2> perpendicular(const Vector<2>& a)
{
    return {-a.y(), a.x()};
}

} // namespace drystone
