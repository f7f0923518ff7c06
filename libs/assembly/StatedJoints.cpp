// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Reading of stated joints.
#include "assembly/StatedJoints.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace drystone
{

void read(TokenCursor& cursor, StatedJoints& stated)
{
    std::vector<Dictionary> entries;
    read(cursor, entries);
    for (const Dictionary& entry : entries)
    {
        StatedJoint<3> joint;
        const auto blocks = entry.get<std::vector<int>>("blocks");
        if (blocks.size() != 2)
        {
            throw FatalIOError(fmt::format("A joint has 2 blocks, not {}.", blocks.size()),
                               entry.locationOf("blocks"));
        }
        joint.block = blocks[0];
        joint.neighbour = blocks[1];
        joint.normal = entry.get<Vector<3>>("normal");
        joint.points = entry.get<std::vector<Vector<3>>>("points");
        const double length = joint.normal.norm();
        if (!(length > 1e-300) || !std::isfinite(length))
        {
            throw FatalIOError("The normal of this joint has no direction.", entry.locationOf("normal"));
        }
        if (std::abs(length - 1) > 1e-14) // else it stays as it was written, to the last bit
        {
            joint.normal /= length;
        }
        if (joint.points.empty())
        {
            throw FatalIOError("This joint has no points: give at least one, or leave the joint out.",
                               entry.locationOf("points"));
        }
        stated.joints.push_back(std::move(joint));
    }
}

void requireBlocks(const Assembly<3>& assembly, const SourceLocation& place)
{
    const int count = static_cast<int>(assembly.blocks.size());
    for (std::size_t i = 0; i < assembly.statedJoints.size(); ++i)
    {
        const StatedJoint<3>& joint = assembly.statedJoints[i];
        if (!(joint.block >= 0 && joint.block < joint.neighbour && joint.neighbour < count))
        {
            throw FatalIOError(fmt::format("Joint {} is between blocks {} and {}: give two different blocks "
                                           "from 0 to {}, the lower index first.",
                                           i, joint.block, joint.neighbour, count - 1),
                               place);
        }
    }
}

void sortByPair(std::vector<StatedJoint<3>>& joints)
{
    std::stable_sort(joints.begin(), joints.end(),
                     [](const StatedJoint<3>& a, const StatedJoint<3>& b)
                     { return std::pair(a.block, a.neighbour) < std::pair(b.block, b.neighbour); });
}

} // namespace drystone
