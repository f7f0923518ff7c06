// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// How deep polyhedra are in each other.
#include "contact/Penetration.h"

#include "geometry/BroadPhase.h"
#include "geometry/space/PolyhedronOverlap.h"

namespace drystone
{

Penetration penetration(const Assembly<3>& assembly, const std::vector<Placement<3>>& placements)
{
    std::vector<Polyhedron> shapes;
    std::vector<Box<3>> boxes;
    for (std::size_t block = 0; block < placements.size(); ++block)
    {
        shapes.push_back(placedShape(assembly.blocks[block], placements[block]));
        boxes.push_back(boundingBox(shapes.back()));
    }
    Penetration deepest;
    for (const auto& [block, neighbour] : findMeetingPairs(boxes))
    {
        const auto one = static_cast<std::size_t>(block);
        const auto other = static_cast<std::size_t>(neighbour);
        if (assembly.blocks[one].support >= 0 && assembly.blocks[other].support >= 0)
        {
            continue;
        }
        const double depth = overlapDepth(shapes[one], shapes[other]);
        if (depth > deepest.depth)
        {
            deepest = {depth, block, neighbour};
        }
    }
    return deepest;
}

} // namespace drystone
