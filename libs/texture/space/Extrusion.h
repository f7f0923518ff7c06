// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The texture `extrusion`: a texture of the plane given depth, its x-y becoming x-z.
#pragma once

#include "assembly/Assembly.h"
#include "texture/Texture.h"

#include <optional>

namespace drystone
{

struct Extrusion
{
    Texture<2> of;
    std::optional<double> thickness = {}; ///< of all blocks [m]; absent: each has its own
};

void declare(Options& options, Extrusion& extrusion);

/// The prism over an outline of the plane, x-y become x-z, from y = `front` to y = `back` [m]. Faces: back,
/// front, then one for each edge of the outline.
Polyhedron extruded(const Polygon& outline, double front, double back);

/// The blocks of the plane texture with its supports, in its order, from y = 0 on.
Assembly<3> makeAssembly(const Extrusion& extrusion);

} // namespace drystone
