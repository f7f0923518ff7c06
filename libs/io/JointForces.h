// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Resultants of the forces at the points of each joint, for tables, fields and pictures.
#pragma once

#include "contact/PointsOfJoints.h"

#include <cmath>
#include <vector>

namespace drystone
{

/// The forces at the points of one joint, added up in the order of the points.
template<int Dim>
struct JointSum
{
    PointRange points = {};                     ///< of the joint
    Vector<Dim> inJoint = Vector<Dim>::Zero();  ///< on the first block along (normal, tangents) [N]
    Vector<Dim> force = Vector<Dim>::Zero();    ///< the same along the axes of the world [N]
    Vector<Dim> leverage = Vector<Dim>::Zero(); ///< normal forces times the places where they act [N m]
    double size = 0;                            ///< lengths of the forces, added up [N]

    double normalForce() const { return inJoint.x(); } ///< pressure is positive [N]
    /// Whether normal forces meet in a point: where the joint bends or shears without a normal force, what
    /// rounding leaves of this is no lever.
    bool hasCentreOfPressure() const { return std::abs(normalForce()) > 1e-8 * size; }
    /// Where they meet [m]; only for joints that have such a point.
    Vector<Dim> centreOfPressure() const { return leverage / normalForce(); }
};

/// The sums of all joints, in their order.
/// \param points points of one joint follow each other
/// \param forces (normal, tangent) of each point, in space (normal, tangent1, tangent2) [N]
/// \throws FatalError where there is not one force a point
template<int Dim>
std::vector<JointSum<Dim>> jointSums(const std::vector<ContactPoint<Dim>>& points,
                                     const std::vector<Vector<Dim>>& forces);

/// The resultant contact force of one joint.
template<int Dim>
struct JointForce
{
    Vector<Dim> centre = Vector<Dim>::Zero(); ///< centre of pressure [m]
    Vector<Dim> force = Vector<Dim>::Zero();  ///< on the first block of the joint [N]
    int block = -1;                           ///< the first
    int neighbour = -1;                       ///< the other
};

/// Resultant and centre of pressure of each joint that is pressed together; parameters as of jointSums.
template<int Dim>
std::vector<JointForce<Dim>> jointForces(const std::vector<ContactPoint<Dim>>& points,
                                         const std::vector<Vector<Dim>>& forces);

} // namespace drystone
