// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Courses of blocks round a vertical axis, which towers, drums and columns have in common.
#pragma once

#include "assembly/Assembly.h"

#include <vector>

namespace drystone
{

/// Where the joints of a course lie relative to the corners of its polygon.
enum class RingJoints
{
    atCorners, ///< each block is one side
    atMidSides ///< each block goes round a corner
};

/// A course of blocks round the z axis: a ring between two regular polygons.
struct Ring
{
    int sides = 8;
    double innerRadius = 0.8; ///< of the corners [m]
    double outerRadius = 1;   ///< likewise [m]
    double lower = 0;         ///< [m]
    double upper = 1;         ///< [m]
    double turn = 0;          ///< azimuth of the first corner, in parts of a side
    RingJoints joints = RingJoints::atCorners;
};

/// A point at an azimuth in parts of a side from the x axis, on the circle of a radius. Azimuths of whole
/// quarters of the circle have exact coordinates.
Vector<2> ringPoint(int sides, double parts, double radius);

/// Its blocks, anticlockwise.
void addRing(std::vector<Block<3>>& blocks, const Ring& ring);

} // namespace drystone
