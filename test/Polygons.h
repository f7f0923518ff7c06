// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Outlines that tests of the plane share. Header only: targets that include it link geometry.
#pragma once

#include "geometry/Polygon.h"

#include <cmath>
#include <numbers>
#include <random>

namespace drystone::test
{

inline const Polygon letterL{{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}};

/// \param x0, y0 lower left corner \param x1, y1 upper right corner
inline Polygon rectangle(double x0, double y0, double x1, double y1)
{
    return {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}};
}

/// \param left, bottom lower left corner
inline Polygon rectangleOfSize(double left, double bottom, double width, double height)
{
    return rectangle(left, bottom, left + width, bottom + height);
}

/// Rotated about the origin, then shifted. \param angle counter-clockwise [rad]
inline Polygon turned(Polygon polygon, double angle, const Vector<2>& shift)
{
    Eigen::Matrix2d rotation;
    rotation << std::cos(angle), -std::sin(angle), std::sin(angle), std::cos(angle);
    for (Vector<2>& vertex : polygon)
    {
        vertex = (rotation * vertex + shift).eval();
    }
    return polygon;
}

/// A star-shaped polygon: simple by construction, mostly concave, counter-clockwise.
inline Polygon randomStar(std::mt19937& random, int corners)
{
    std::uniform_real_distribution<double> radius(0.3, 1);
    Polygon polygon;
    for (int i = 0; i < corners; ++i)
    {
        const double angle = 2 * std::numbers::pi * i / corners;
        polygon.push_back(radius(random) * Vector<2>(std::cos(angle), std::sin(angle)));
    }
    return polygon;
}

} // namespace drystone::test
