// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The texture `walls` in plan: where its walls stand and where they cross each other.
#pragma once

#include "texture/space/WallBond.h"
#include "texture/space/Walls.h"

#include <string>
#include <vector>

namespace drystone
{

/// A wall in plan, with all that its courses depend on.
struct WallInPlan
{
    Vector<2> from;
    Vector<2> along;      ///< unit vector
    Vector<2> across;     ///< unit vector from the line into the wall
    double length = 0;    ///< [m]
    double thickness = 0; ///< [m]
    int firstCourse = 0;  ///< 0: course 0 is an even one of the bond, 1: an odd one
};

/// Where a wall crosses another, in the other's coordinates.
struct WallCrossing
{
    int other = -1;          ///< index of the wall that runs through
    Interval along = {0, 0}; ///< of it, along this wall [m]
    bool onEven = true;      ///< whether the other runs through on even courses
};

/// The walls in the order given, all with their bond's course 0 at the bottom.
std::vector<WallInPlan> wallsInPlan(const Walls& settings);

/// Whether two intervals have more in common than rounding.
bool overlap(const Interval& a, const Interval& b, double tolerance);

/// What is rounding between the walls [m].
double planTolerance(const Walls& settings);

/// For each wall the crossings at which it stops, along it. \param fault what is wrong with walls that meet,
/// if anything
std::vector<std::vector<WallCrossing>>
findCrossings(const Walls& settings, const std::vector<WallInPlan>& walls, std::string& fault);

} // namespace drystone
