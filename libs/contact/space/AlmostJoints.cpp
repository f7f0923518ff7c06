// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The search for faces that almost meet.
#include "contact/AlmostJoints.h"

#include "contact/JointClosure.h"
#include "geometry/space/PolyhedronOverlap.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace drystone
{

double openness(const FacingPatch& patch)
{
    double most = 0;
    for (const double gap : patch.gaps)
    {
        most = std::max(most, std::abs(gap));
    }
    return most;
}

bool isApart(const FacingPatch& patch)
{
    return std::accumulate(patch.gaps.begin(), patch.gaps.end(), 0.0) > 0;
}

std::vector<FacingPatch> findAlmostJoints(const Assembly<3>& assembly, const CheckLimits& limits)
{
    if (!assembly.statedJoints.empty())
    {
        return {}; // what is a joint does not depend on distances
    }
    const double size = meanBlockSize(assembly);
    const double straight = std::max(limits.jointTolerance * size, usualToleranceAlongAxes(assembly));
    const double oblique = usualObliqueTolerance(assembly);
    FacingTolerance tolerance = facingTolerance(limits.gap * size, oblique);
    tolerance.angle = limits.gapAngle;
    std::vector<FacingPatch> patches = findFacingPatches(assembly, tolerance);
    std::erase_if(patches,
                  [&](const FacingPatch& patch)
                  {
                      const double jointTolerance =
                          patch.isOblique ? std::max(limits.jointTolerance * size, oblique) : straight;
                      // Outer faces of thin blocks that lie on each other have passed each other, too.
                      return openness(patch) <= jointTolerance
                             || (!isApart(patch)
                                 && overlapDepth(assembly.blocks[patch.block].shape,
                                                 assembly.blocks[patch.neighbour].shape)
                                        <= jointTolerance / 2);
                  });
    return patches;
}

} // namespace drystone
