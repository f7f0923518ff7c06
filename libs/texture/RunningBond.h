// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The texture `runningBond`: courses of equal blocks, shifted by half a block from one course to the next.
#pragma once

#include "assembly/Assembly.h"
#include "dictionary/Options.h"

#include <array>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

namespace drystone
{

/// How the bottom course of a running bond starts and ends (for a length of whole units).
enum class FirstCourse
{
    half, ///< with half a block; the next course with a full one
    full
};

inline std::array<std::pair<std::string_view, FirstCourse>, 2> namesOf(FirstCourse)
{
    return {{{"half", FirstCourse::half}, {"full", FirstCourse::full}}};
}

/// A window or door in a wall: a rectangle between two corners, in (units, courses) from the wall's lower
/// left corner.
struct Opening
{
    Vector<2> from;
    Vector<2> to;
    std::optional<double> lintel =
        {}; ///< bearing at both ends of one block in the course above [units]; absent: none
};

void declare(Options& options, Opening& opening);

struct RunningBond
{
    Vector<2> unit{0.4, 0.175}; ///< length of a full block, height of a course [m]
    double thickness = 1;       ///< out of plane [m]
    double length = 5;          ///< of the wall [units]
    int courses = 6;
    FirstCourse firstCourse = FirstCourse::half;
    std::vector<Opening> openings; ///< blocks inside one are removed, those crossing a jamb are cut there
};

void declare(Options& options, RunningBond& bond);

/// The wall's blocks, all free, by course from the bottom and from left to right in a course. Its lower left
/// corner is the origin. Corners that coincide have bitwise equal coordinates.
Assembly<2> makeAssembly(const RunningBond& bond);

} // namespace drystone
