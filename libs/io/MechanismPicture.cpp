// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Resultants of joints, for pictures and tables; the pictures themselves are in plane/ and space/.
#include "io/MechanismPicture.h"

#include "core/Error.h"
#include "io/SvgText.h"

#include <fmt/format.h>

namespace drystone
{

template<int Dim>
std::vector<JointForce<Dim>> jointForces(const std::vector<ContactPoint<Dim>>& points,
                                         const std::vector<Vector<Dim>>& forces)
{
    if (forces.size() != points.size())
    {
        throw FatalError(
            fmt::format("{} forces were given for {} contact points.", forces.size(), points.size()));
    }
    std::vector<JointForce<Dim>> joints;
    for (std::size_t begin = 0; begin < points.size();)
    {
        JointForce<Dim> joint;
        joint.block = points[begin].block;
        joint.neighbour = points[begin].neighbour;
        double pressure = 0;
        double size = 0;
        std::size_t i = begin;
        for (; i < points.size() && points[i].joint == points[begin].joint; ++i)
        {
            joint.force += contactFrame(points[i]) * forces[i];
            joint.centre += forces[i].x() * points[i].position;
            pressure += forces[i].x();
            size += forces[i].norm();
        }
        if (pressure > 0 && hasCentreOfPressure(pressure, size))
        {
            joint.centre /= pressure;
            joints.push_back(joint);
        }
        begin = i;
    }
    return joints;
}

template<int Dim>
std::string mechanismSvg(const Assembly<Dim>& assembly, const std::vector<Placement<Dim>>& placements,
                         const MechanismPicture& picture)
{
    return svgText(drawnMechanism(assembly, placements, picture));
}

template std::string mechanismSvg(const Assembly<2>& assembly, const std::vector<Placement<2>>& placements,
                                  const MechanismPicture& picture);
template std::string mechanismSvg(const Assembly<3>& assembly, const std::vector<Placement<3>>& placements,
                                  const MechanismPicture& picture);
template std::vector<JointForce<2>> jointForces(const std::vector<ContactPoint<2>>& points,
                                                const std::vector<Vector<2>>& forces);
template std::vector<JointForce<3>> jointForces(const std::vector<ContactPoint<3>>& points,
                                                const std::vector<Vector<3>>& forces);

} // namespace drystone
