// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Whether outlines touch.
#include "contact/SupportPaths.h"

#include "geometry/PolygonShape.h"

#include <algorithm>
#include <cmath>

namespace drystone
{

bool touch(const Block<2>& one, const Block<2>& other, double tolerance)
{
    const auto isOn = [tolerance](const Polygon& outline)
    {
        return [&outline, tolerance](const Vector<2>& corner)
        { return std::abs(signedDistance(outline, corner)) <= tolerance; };
    };
    return std::any_of(one.outline.begin(), one.outline.end(), isOn(other.outline))
           || std::any_of(other.outline.begin(), other.outline.end(), isOn(one.outline));
}

} // namespace drystone
