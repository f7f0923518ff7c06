// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Makes the blocks of the texture `extrusion` from its settings.
#include "texture/space/Extrusion.h"

namespace drystone
{

void declare(Options& options, Extrusion& extrusion)
{
    options.required("of", extrusion.of, textureTypes<2>(), "the texture of the plane; its x-y becomes x-z");
    options
        .optional("thickness", extrusion.thickness,
                  "of all blocks, from y = 0; absent: that of each in the plane")
        .unit("m")
        .above(0)
        .example("0.4");
}

Polyhedron extruded(const Polygon& outline, double front, double back)
{
    // Counter-clockwise in x-z is counter-clockwise seen against y, from the front.
    std::vector<Vector<3>> atBack;
    std::vector<Vector<3>> atFront;
    for (const Vector<2>& corner : outline)
    {
        atBack.emplace_back(corner.x(), back, corner.y());
        atFront.emplace_back(corner.x(), front, corner.y());
    }
    return makePrism(atBack, atFront);
}

Assembly<3> makeAssembly(const Extrusion& extrusion)
{
    Assembly<3> assembly;
    assembly.supports = extrusion.of.assembly.supports;
    assembly.zones = extrusion.of.assembly.zones;
    assembly.jointTolerance = extrusion.of.assembly.jointTolerance;
    for (const Block<2>& block : extrusion.of.assembly.blocks)
    {
        const double thickness = extrusion.thickness.value_or(block.thickness);
        assembly.blocks.push_back({extruded(block.outline, 0, thickness), block.support});
    }
    return assembly;
}

} // namespace drystone
