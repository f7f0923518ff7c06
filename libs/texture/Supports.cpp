// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Makers of supports.
#include "texture/Supports.h"

#include "geometry/BroadPhase.h"

#include <algorithm>
#include <cmath>

namespace drystone
{

void addGround(Assembly<2>& assembly, const std::string& name, const Ground& ground)
{
    BoundingBox bounds;
    double thickness = 0;
    for (const Block<2>& block : assembly.blocks)
    {
        for (const Vector<2>& vertex : block.outline)
        {
            bounds.lower = bounds.lower.cwiseMin(vertex);
            bounds.upper = bounds.upper.cwiseMax(vertex);
        }
        thickness = std::max(thickness, block.thickness);
    }
    const double left = bounds.lower.x();
    const double right = bounds.upper.x();
    const double size = (bounds.upper - bounds.lower).maxCoeff();
    const double bottom = -(ground.depth > 0 ? ground.depth : 0.1 * size);
    const double margin = ground.margin >= 0 ? ground.margin : 3 * size;

    // A remainder below a millionth of a segment is rounding, not a block.
    const double count = std::max(1.0, std::ceil((right - left) / ground.segment - 1e-6));
    const int support = static_cast<int>(assembly.supports.size());
    assembly.supports.push_back({name, "ground"});
    for (int i = 0; i < static_cast<int>(count); ++i)
    {
        const double from = i == 0 ? left - margin : left + i * ground.segment;
        const double to = i + 1 == count ? right + margin : left + (i + 1) * ground.segment;
        assembly.blocks.push_back({{{from, bottom}, {to, bottom}, {to, 0}, {from, 0}}, thickness, support});
    }
}

} // namespace drystone
