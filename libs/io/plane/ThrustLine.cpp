// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Connects centres of pressure to a line of thrust.
#include "io/plane/ThrustLine.h"

#include <algorithm>

namespace drystone
{

std::vector<ThrustSegment> thrustSegments(const std::vector<JointForce<2>>& joints,
                                          const std::vector<bool>& free, double least)
{
    double largest = 0;
    for (const JointForce<2>& joint : joints)
    {
        largest = std::max(largest, joint.force.norm());
    }
    std::vector<std::vector<const JointForce<2>*>> jointsOf(free.size());
    for (const JointForce<2>& joint : joints)
    {
        if (!(joint.force.norm() > least * largest))
        {
            continue;
        }
        for (const int block : {joint.block, joint.neighbour})
        {
            const auto index = static_cast<std::size_t>(block);
            if (block >= 0 && index < free.size() && free[index])
            {
                jointsOf[index].push_back(&joint);
            }
        }
    }
    std::vector<ThrustSegment> segments;
    for (const auto& own : jointsOf)
    {
        if (own.size() == 2)
        {
            segments.push_back(
                {own[0]->centre, own[1]->centre, std::max(own[0]->force.norm(), own[1]->force.norm())});
            continue;
        }
        Vector<2> middle = Vector<2>::Zero();
        double sum = 0;
        for (const JointForce<2>* joint : own)
        {
            middle += joint->force.norm() * joint->centre;
            sum += joint->force.norm();
        }
        for (const JointForce<2>* joint : own)
        {
            segments.push_back({joint->centre, middle / sum, joint->force.norm()});
        }
    }
    return segments;
}

} // namespace drystone
