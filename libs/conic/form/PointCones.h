// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Which standard cones make up the set of a contact point: the one place where the plane and space differ,
/// and where friction and strength become rays and round cones (Form.h). Internal to the form and to solvers
/// that have one of their own.
#pragma once

#include "conic/ConeProgram.h"

#include <array>

namespace drystone
{

/// Friction from which a point gets a ray along the normal in addition to its cone, which has hardly a normal
/// component where mu is large: a force along the normal is then the difference of forces mu times as large,
/// and their openings are those of slip alone. Points with strength do without, since a limit to crushing
/// needs equal normal components.
inline constexpr double largeFriction = 5;

/// The cones that make up the set of a point: directions of its rays, diagonals of T of its round cones.
template<int Forces>
struct PointCones
{
    std::array<Eigen::Matrix<double, Forces, 1>, 3> ray;
    std::array<Eigen::Vector3d, 2> round;
    int pressingRays = 0; ///< they come first, with the same normal component where there is strength
    int rays = 0;
    int rounds = 0; ///< the first one presses where there is friction

    void addRay(const Eigen::Matrix<double, Forces, 1>& direction) { ray[rays++] = direction; }
    void addRound(const Eigen::Vector3d& scale) { round[rounds++] = scale; }
};

/// In the plane (1, mu), (1, -mu), then (1, 0) where mu is large; (1, 0) alone without friction; then (0, 1)
/// where there is cohesion.
PointCones<2> pointCones(const PlaneConeProgram& program, int point);

/// In space T, then (1, 0, 0) where mu is large; (1, 0, 0) alone without friction; then (p0, t) where there
/// is cohesion.
PointCones<3> pointCones(const SpaceConeProgram& program, int point);

/// Half the length of the piece of the shear axis, or the radius of the disc, that a point's set contains:
/// what cohesion allows at the least normal force.
template<int Rows, int Forces>
double shearAlone(const ConeProgram<Rows, Forces>& program, int point);

/// c0 of a point: what its cones start from.
template<int Rows, int Forces>
Eigen::Matrix<double, Forces, 1> origin(const ConeProgram<Rows, Forces>& program, int point);

} // namespace drystone
