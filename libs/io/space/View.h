// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// How pictures of space are seen: a view without perspective.
#pragma once

#include "geometry/Box.h"

namespace drystone
{

/// A view without perspective.
struct View
{
    Vector<3> right; ///< unit vectors
    Vector<3> up;
    Vector<3> towardsViewer;
    Box<2> world;     ///< what is shown, along right and up [m]
    Vector<2> corner; ///< of the drawing area, upper left [px]
    double scale = 1; ///< [px/m]

    Vector<2> seen(const Vector<3>& point) const { return {right.dot(point), up.dot(point)}; }
    Vector<2> onPage(const Vector<3>& point) const
    {
        const Vector<2> place = seen(point);
        return corner + scale * Vector<2>(place.x() - world.lower.x(), world.upper.y() - place.y());
    }
};

/// The view from a direction, z upwards; straight from above x runs to the right. \param towardsViewer unit
/// vector
View axonometricView(const Vector<3>& towardsViewer);

} // namespace drystone
