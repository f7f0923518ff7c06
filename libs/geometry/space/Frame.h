// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Coordinates in a plane of space: which two directions belong to a normal.
#pragma once

#include "geometry/Vector.h"

namespace drystone
{

/// A right-handed orthonormal frame with a given normal: columns normal, tangent1, tangent2 = normal x
/// tangent1. tangent1 is horizontal (z up), so that tangent2 of a vertical face is vertical; of a normal
/// along +-z it is x. Frames of normals along an axis consist of axes, without rounding. \param normal of
/// length 1
Eigen::Matrix3d frameOf(const Vector<3>& normal);

} // namespace drystone
