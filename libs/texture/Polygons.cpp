// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Makes the blocks of the texture `polygons` from its settings.
#include "texture/Polygons.h"

namespace drystone
{

void declare(Options& options, Polygons& polygons)
{
    options.optional("thickness", polygons.thickness, "out of plane").unit("m").above(0);
    options
        .required("blocks", polygons.blocks,
                  "corners of each block [m]: a simple polygon, in either orientation")
        .example("(((0 0) (1 0) (1 0.5) (0 0.5)) ((0 0.5) (1 0.5) (0.5 1.2)))");
}

Assembly<2> makeAssembly(const Polygons& polygons)
{
    Assembly<2> assembly;
    assembly.blocks.reserve(polygons.blocks.polygons.size());
    for (const Polygon& outline : polygons.blocks.polygons)
    {
        assembly.blocks.push_back({outline, polygons.thickness});
    }
    return assembly;
}

} // namespace drystone
