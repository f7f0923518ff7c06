// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Walls of running bond with a window, drawn at random: sizes, friction, windows with and without lintel.
#pragma once

#include "statics/Structures.h"

#include <random>

namespace drystone
{

struct RandomWall
{
    RunningBond bond;
    double friction = 0;
};

/// The wall of a number: the same on every machine. Units of 0.3 to 0.6 m by 0.1 to 0.25 m, 4 to 8 units by 6
/// to 14 courses, friction 0.2 to 1, one window of 0.5 to 3 units by 2 to 5 courses, half of them with a
/// lintel.
inline RandomWall randomWall(unsigned number)
{
    std::mt19937 random(number);
    const auto uniform = [&](double from, double to)
    { return from + (to - from) * (static_cast<double>(random()) / 4294967296.0); };
    const auto among = [&](int from, int to)
    { return from + static_cast<int>(uniform(0, 1) * (to - from + 1)); };
    RandomWall wall;
    wall.friction = uniform(0.2, 1);
    wall.bond.unit = {uniform(0.3, 0.6), uniform(0.1, 0.25)};
    wall.bond.length = among(4, 8);
    wall.bond.courses = among(6, 14);
    wall.bond.firstCourse = among(0, 1) == 0 ? FirstCourse::half : FirstCourse::full;
    const double width = 0.5 * among(1, 6);
    const int height = among(2, std::min(5, wall.bond.courses - 3));
    const double left = 0.5 * among(1, static_cast<int>(2 * (wall.bond.length - width)) - 1);
    const int sill = among(0, wall.bond.courses - height - 2);
    Opening opening{{left, static_cast<double>(sill)}, {left + width, static_cast<double>(sill + height)}};
    if (among(0, 1) == 1)
    {
        opening.lintel = 0.5;
    }
    wall.bond.openings = {opening};
    return wall;
}

} // namespace drystone
