// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// How pictures of the plane are seen: which part of the world is where on the page.
#pragma once

#include "geometry/Polygon.h"

#include <Eigen/Geometry>

namespace drystone
{

/// From metres, y upwards, to pixels, y downwards.
struct PlaneView
{
    Eigen::AlignedBox2d world; ///< [m]
    Vector<2> corner;          ///< of the drawing area, upper left [px]
    double scale = 1;          ///< [px/m]

    Vector<2> operator()(const Vector<2>& point) const
    {
        return corner + scale * Vector<2>(point.x() - world.min().x(), world.max().y() - point.y());
    }
    Polygon operator()(Polygon outline) const
    {
        for (Vector<2>& vertex : outline)
        {
            vertex = (*this)(vertex);
        }
        return outline;
    }
};

} // namespace drystone
