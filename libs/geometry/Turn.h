// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// On which side of a line a point of the plane lies.
#pragma once

#include "geometry/Vector.h"

namespace drystone
{

/// Twice the area of the triangle a b c [m2]: positive where c is on the left of the way from a to b.
inline double turn(const Vector<2>& a, const Vector<2>& b, const Vector<2>& c)
{
    return cross(b - a, c - a);
}

} // namespace drystone
