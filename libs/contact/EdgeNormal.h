// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The normal of an edge of an outline, for the parts of MovingContacts.
#pragma once

#include "geometry/Vector.h"

namespace drystone
{

/// Of a block that lies left of its edges. \param tangent unit vector along the edge
inline Vector<2> outwardNormal(const Vector<2>& tangent)
{
    return {tangent.y(), -tangent.x()};
}

} // namespace drystone
