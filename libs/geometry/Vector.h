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

/// Moment of a force at the end of an arm: one row in the plane, three in space.
inline Eigen::Matrix<double, 1, 1> momentOf(const Vector<2>& arm, const Vector<2>& force)
{
    return Eigen::Matrix<double, 1, 1>(cross(arm, force));
}
inline Vector<3> momentOf(const Vector<3>& arm, const Vector<3>& force)
{
    return {arm.y() * force.z() - arm.z() * force.y(), arm.z() * force.x() - arm.x() * force.z(),
            arm.x() * force.y() - arm.y() * force.x()};
}

/// The vector turned by +90 degrees.
inline Vector<2> perpendicular(const Vector<2>& a)
{
    return {-a.y(), a.x()};
}

} // namespace drystone
