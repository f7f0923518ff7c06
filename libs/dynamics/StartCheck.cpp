// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Checks of 0/motion against the blocks.
#include "dynamics/StartCheck.h"

#include "contact/AlmostJoints.h"
#include "contact/Penetration.h"

#include <fmt/format.h>

#include <cmath>

namespace drystone
{

void refuseStartOverlaps(const Assembly<2>& assembly, const std::vector<Placement<2>>& placements,
                         const std::vector<SourceLocation>& places)
{
    if (places.empty())
    {
        return;
    }
    const double asBuilt = penetration(assembly, std::vector<Placement<2>>(assembly.blocks.size())).depth;
    const Penetration deepest = penetration(assembly, placements);
    if (deepest.depth <= asBuilt + CheckLimits{}.jointTolerance * meanBlockSize(assembly))
    {
        return;
    }
    const auto isDisplaced = [&](int block)
    { return placements[block].rotation != 0 || !placements[block].translation.isZero(0); };
    const int displaced = isDisplaced(deepest.block) ? deepest.block : deepest.neighbour;
    const int other = displaced == deepest.block ? deepest.neighbour : deepest.block;
    throw FatalIOError(
        fmt::format(
            "At the start {} is {:.3g} m deep in {}. Blocks may touch, but not share space: correct "
            "displacement and rotation. A block that starts tilted about one of its corners has no "
            "displacement but, beside its rotation, `about (x y);`, the place of that corner as built.",
            blockName(assembly, displaced), deepest.depth, blockName(assembly, other)),
        places[static_cast<std::size_t>(displaced)]);
}

void questionRotation(const BlockStart& start, const SourceLocation& place)
{
    if (std::abs(start.rotation) > EIGEN_PI / 2)
    {
        printWarning(
            fmt::format("A rotation of {:g} rad is {:.4g} degrees. Angles are in rad: {:g} degrees would be "
                        "`rotation {:.9g};`.",
                        start.rotation, start.rotation * 180 / EIGEN_PI, start.rotation,
                        start.rotation * EIGEN_PI / 180),
            place);
    }
}

} // namespace drystone
