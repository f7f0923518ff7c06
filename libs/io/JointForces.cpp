// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Adds up the forces of a joint, whose points follow each other.
#include "io/JointForces.h"

#include "core/Error.h"

#include <fmt/format.h>

namespace drystone
{

template<int Dim>
std::vector<JointSum<Dim>> jointSums(const std::vector<ContactPoint<Dim>>& points,
                                     const std::vector<Vector<Dim>>& forces)
{
    if (forces.size() != points.size())
    {
        throw FatalError(
            fmt::format("{} forces were given for {} contact points.", forces.size(), points.size()));
    }
    std::vector<JointSum<Dim>> joints;
    for (const PointRange& range : pointsOfJoints(points))
    {
        JointSum<Dim>& joint = joints.emplace_back();
        joint.points = range;
        for (std::size_t i = range.begin; i < range.end; ++i)
        {
            joint.inJoint += forces[i];
            joint.force += contactFrame(points[i]) * forces[i];
            joint.leverage += forces[i].x() * points[i].position;
            joint.size += forces[i].norm();
        }
    }
    return joints;
}

template<int Dim>
std::vector<JointForce<Dim>> jointForces(const std::vector<ContactPoint<Dim>>& points,
                                         const std::vector<Vector<Dim>>& forces)
{
    std::vector<JointForce<Dim>> pressed;
    for (const JointSum<Dim>& joint : jointSums(points, forces))
    {
        if (joint.normalForce() > 0 && joint.hasCentreOfPressure())
        {
            const ContactPoint<Dim>& point = points[joint.points.begin];
            pressed.push_back({joint.centreOfPressure(), joint.force, point.block, point.neighbour});
        }
    }
    return pressed;
}

template std::vector<JointSum<2>> jointSums(const std::vector<ContactPoint<2>>& points,
                                            const std::vector<Vector<2>>& forces);
template std::vector<JointSum<3>> jointSums(const std::vector<ContactPoint<3>>& points,
                                            const std::vector<Vector<3>>& forces);
template std::vector<JointForce<2>> jointForces(const std::vector<ContactPoint<2>>& points,
                                                const std::vector<Vector<2>>& forces);
template std::vector<JointForce<3>> jointForces(const std::vector<ContactPoint<3>>& points,
                                                const std::vector<Vector<3>>& forces);

} // namespace drystone
