// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Contact points at the corners of the patches where faces lie on each other, or in a grid over these.
#include "contact/ContactPoint.h"

#include "contact/JointClosure.h"
#include "contact/space/FacingPatches.h"
#include "contact/space/PatchCells.h"

namespace drystone
{

namespace
{

/// Of the joints that the assembly states, but for those of two fixed blocks.
std::vector<ContactPoint<3>> statedPoints(const Assembly<3>& assembly)
{
    std::vector<ContactPoint<3>> points;
    int index = 0;
    for (const StatedJoint<3>& joint : assembly.statedJoints)
    {
        if (assembly.blocks[joint.block].support >= 0 && assembly.blocks[joint.neighbour].support >= 0)
        {
            continue;
        }
        for (const Vector<3>& point : joint.points)
        {
            points.push_back({joint.block, joint.neighbour, index, point, joint.normal, 0, ContactFeature{}});
        }
        ++index;
    }
    return points;
}

} // namespace

template<>
std::vector<ContactPoint<3>> findContactPoints(const Assembly<3>& assembly)
{
    if (!assembly.statedJoints.empty())
    {
        return statedPoints(assembly);
    }
    const std::vector<FacingPatch> joints = findFacingPatches(assembly, closedFacing(assembly));

    std::vector<ContactPoint<3>> points;
    points.reserve(4 * joints.size());
    for (std::size_t i = 0; i < joints.size(); ++i)
    {
        const FacingPatch& joint = joints[i];
        for (const Vector<3>& corner : joint.corners)
        {
            // A joint is closed as built: what the tolerance let through is not a gap.
            points.push_back({joint.block, joint.neighbour, static_cast<int>(i), corner, joint.normal, 0,
                              ContactFeature{}});
        }
    }
    return points;
}

std::vector<ContactPoint<3>> divideJoints(const std::vector<ContactPoint<3>>& corners, int perSide)
{
    std::vector<PatchCells> patches = patchCells(corners);
    for (PatchCells& patch : patches)
    {
        cutIntoGrid(patch, perSide);
    }
    return pointsOf(patches);
}

} // namespace drystone
