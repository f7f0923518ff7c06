// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The bonds of the texture `walls`: which bricks one course of a straight wall consists of.
#pragma once

#include "texture/Interval.h"
#include "texture/space/Walls.h"

#include <string>
#include <vector>

namespace drystone
{

/// A brick in plan, along the wall from where it begins and across it from its line [m].
struct Brick
{
    Interval along;
    Interval across;
};

/// What the bond requires of unit, lengths and leaves, as a message; empty when all is well.
std::string bondFault(const Walls& walls);

/// Length of a wall of so many bricks [m].
double wallLength(const Walls& walls, double bricks);

double wallThickness(const Walls& walls);

/// The bricks of a course. \param length of the wall [m] \param firstCourse 0, or 1 for a wall whose course 0
/// is an odd one of the bond
std::vector<Brick> bondCourse(const Walls& walls, double length, int course, int firstCourse);

/// Cuts what lies in an interval along the wall out of the bricks; what is left of a brick may be two.
void subtract(std::vector<Brick>& bricks, const Interval& hole);

} // namespace drystone
