// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Generator of blocks given by their corners.
#include "texture/Polygons.h"

#include <algorithm>

namespace drystone
{

Assembly<2> makeAssembly(const Polygons& polygons)
{
    Assembly<2> assembly;
    assembly.blocks.reserve(polygons.blocks.size());
    for (Polygon outline : polygons.blocks)
    {
        if (areaProperties(outline).area < 0)
        {
            // The first corner stays the first.
            std::reverse(outline.begin() + 1, outline.end());
        }
        assembly.blocks.push_back({std::move(outline), polygons.thickness});
    }
    return assembly;
}

} // namespace drystone
