// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Makes the blocks of the texture `polyhedra` from its settings.
#include "texture/space/PolyhedronBlocks.h"

namespace drystone
{

void declare(Options& options, PolyhedronBlocks& polyhedra)
{
    options
        .required("blocks", polyhedra.blocks,
                  "vertices of each block [m], and its faces by the indices of their vertices (from 0), "
                  "counter-clockwise seen from outside")
        .example(
            "({ vertices ((0 0 0) (1 0 0) (0 1 0) (0 0 1)); faces ((0 2 1) (0 1 3) (1 2 3) (2 0 3)); })");
}

Assembly<3> makeAssembly(const PolyhedronBlocks& polyhedra)
{
    Assembly<3> assembly;
    assembly.blocks.reserve(polyhedra.blocks.shapes.size());
    for (const Polyhedron& shape : polyhedra.blocks.shapes)
    {
        assembly.blocks.push_back({shape});
    }
    return assembly;
}

} // namespace drystone
