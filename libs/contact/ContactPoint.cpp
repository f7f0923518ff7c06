// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Contact points at the ends of the joints.
#include "contact/ContactPoint.h"

#include "contact/Facing.h"
#include "contact/JointClosure.h"

namespace drystone
{

template<>
std::vector<ContactPoint<2>> findContactPoints(const Assembly<2>& assembly)
{
    const std::vector<FacingPiece> joints = findFacingPieces(assembly, closedFacing(assembly));

    std::vector<ContactPoint<2>> points;
    points.reserve(2 * joints.size());
    for (std::size_t i = 0; i < joints.size(); ++i)
    {
        const FacingPiece& joint = joints[i];
        for (const Vector<2>& end : {joint.from, joint.to})
        {
            // A joint is closed as built: what the tolerance let through is not a gap.
            points.push_back(
                {joint.block, joint.neighbour, static_cast<int>(i), end, joint.normal, 0, ContactFeature{}});
        }
    }
    return points;
}

std::vector<ContactPoint<2>> divideJoints(const std::vector<ContactPoint<2>>& ends, int pointsPerJoint)
{
    std::vector<ContactPoint<2>> points;
    points.reserve(ends.size() / 2 * static_cast<std::size_t>(pointsPerJoint));
    for (std::size_t end = 0; end + 1 < ends.size(); end += 2)
    {
        const int last = pointsPerJoint - 1;
        for (int i = 0; i <= last; ++i)
        {
            ContactPoint<2> point = ends[end];
            // From either end, so that the ends themselves keep their last digit.
            point.position =
                (double(last - i) * ends[end].position + double(i) * ends[end + 1].position) / last;
            points.push_back(point);
        }
    }
    return points;
}

} // namespace drystone
