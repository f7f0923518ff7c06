// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The cone program of a structure at rest, of the plane or of space.
#pragma once

#include "conic/InteriorPoint.h"
#include "geometry/Vector.h"

namespace drystone
{

/// Plane: 3 rows a body, 2 forces a point. Space: 6 rows and 3 forces.
template<int Dim>
using StaticProgram = ConeProgram<freedomCount<Dim>, Dim>;

} // namespace drystone
