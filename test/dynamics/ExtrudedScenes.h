// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Scenes of the plane stood up in space, and how far their motions are apart.
#pragma once

#include "dynamics/DynamicState.h"
#include "geometry/space/Polyhedron.h"

#include <algorithm>

namespace drystone
{

/// Blocks of the plane, 1 m deep, stood up in x-z; the first is fixed.
inline Assembly<3> extruded(const Assembly<2>& plane)
{
    Assembly<3> space;
    space.supports.push_back({"ground", "ground"});
    for (const Block<2>& block : plane.blocks)
    {
        std::vector<Vector<3>> front, back;
        for (const Vector<2>& corner : block.outline)
        {
            front.emplace_back(corner.x(), 0, corner.y());
            back.emplace_back(corner.x(), 1, corner.y());
        }
        // Counter-clockwise in x-z, seen from -y.
        Block<3> solid;
        solid.shape = makePrism(back, front);
        solid.support = block.support;
        space.blocks.push_back(std::move(solid));
    }
    return space;
}

/// How far blocks of the plane and the same of space are apart, places and turns [m, rad].
inline double apart(const DynamicState<2>& plane, const DynamicState<3>& space)
{
    double worst = 0;
    for (std::size_t block = 0; block < plane.placements.size(); ++block)
    {
        const Placement<2>& a = plane.placements[block];
        const Placement<3>& b = space.placements[block];
        const Vector<3> ways(b.translation.x() - a.translation.x(), b.translation.y(),
                             b.translation.z() - a.translation.y());
        worst = std::max({worst, ways.norm(), Vector<3>(b.rotation + Vector<3>(0, a.rotation, 0)).norm()});
    }
    return worst;
}

} // namespace drystone
