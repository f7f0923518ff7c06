// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Distances of points from both surfaces, and the contacts that there would be without statements.
#include "contact/space/StatedJointChecks.h"

#include "contact/ContactPoint.h"
#include "contact/JointClosure.h"
#include "geometry/space/FacePolygon.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

namespace drystone
{

double statedJointTolerance(const Assembly<3>& assembly)
{
    constexpr double ofSize = 1e-2;
    return std::max(jointTolerance(assembly).oblique, ofSize * meanBlockSize(assembly));
}

std::vector<MisplacedJoint> misplacedJoints(const Assembly<3>& assembly)
{
    const double tolerance = statedJointTolerance(assembly);
    std::vector<MisplacedJoint> misplaced;
    for (std::size_t i = 0; i < assembly.statedJoints.size(); ++i)
    {
        const StatedJoint<3>& joint = assembly.statedJoints[i];
        MisplacedJoint worst;
        for (const int block : {joint.block, joint.neighbour})
        {
            for (const Vector<3>& point : joint.points)
            {
                const double farOff =
                    distanceFromSurface(assembly.blocks[static_cast<std::size_t>(block)].shape, point);
                if (!(farOff <= worst.farOff))
                {
                    worst = {static_cast<int>(i), block, point, farOff};
                }
            }
        }
        if (!(worst.farOff <= tolerance))
        {
            misplaced.push_back(worst);
        }
    }
    std::stable_sort(misplaced.begin(), misplaced.end(),
                     [](const MisplacedJoint& a, const MisplacedJoint& b) { return a.farOff > b.farOff; });
    return misplaced;
}

std::vector<std::pair<int, int>> facesWithoutStatedJoint(const Assembly<3>& assembly)
{
    if (assembly.statedJoints.empty())
    {
        return {};
    }
    Assembly<3> bare = assembly;
    bare.statedJoints.clear();
    std::set<std::pair<int, int>> pairs;
    for (const ContactPoint<3>& point : findContactPoints(bare))
    {
        pairs.emplace(point.block, point.neighbour);
    }
    for (const StatedJoint<3>& joint : assembly.statedJoints)
    {
        pairs.erase({joint.block, joint.neighbour});
    }
    return {pairs.begin(), pairs.end()};
}

std::string misplacedJointsText(const Assembly<3>& assembly)
{
    const std::vector<MisplacedJoint> misplaced = misplacedJoints(assembly);
    if (misplaced.empty())
    {
        return {};
    }
    const MisplacedJoint& worst = misplaced.front();
    const StatedJoint<3>& joint = assembly.statedJoints[static_cast<std::size_t>(worst.joint)];
    return fmt::format(
        "The joint that is stated between blocks {} and {} has a point at ({:.6g} {:.6g} {:.6g}), {:.3g} m "
        "off the surface of block {}, more than {:.2g} m.{} Joints lie on the faces of both blocks; with "
        "these the answer would be that of another structure.\n\nCorrect the interface in the file, or leave "
        "the joints to the shapes of the blocks: state `interfaces ignored;` in "
        "system/blockTextureDict. Then run blockTexture again.",
        joint.block, joint.neighbour, worst.point.x(), worst.point.y(), worst.point.z(), worst.farOff,
        worst.block, statedJointTolerance(assembly),
        misplaced.size() > 1 ? fmt::format(" {} joints are off.", misplaced.size()) : "");
}

std::string facesWithoutStatedJointText(const Assembly<3>& assembly)
{
    const std::vector<std::pair<int, int>> pairs = facesWithoutStatedJoint(assembly);
    return pairs.empty()
               ? ""
               : fmt::format("Blocks {} and {} share a face, and the file has no interface of them: "
                             "nothing passes between them.{} Add it there, or leave the joints to "
                             "the shapes of the blocks: state `interfaces ignored;`.",
                             pairs.front().first, pairs.front().second,
                             pairs.size() > 1 ? fmt::format(" {} pairs do so.", pairs.size()) : "");
}

} // namespace drystone
