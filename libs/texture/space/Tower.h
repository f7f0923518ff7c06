// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The texture `tower`: rings of blocks on each other, round or polygonal.
#pragma once

#include "assembly/Assembly.h"
#include "dictionary/Options.h"

#include <array>
#include <string_view>
#include <utility>

namespace drystone
{

/// How the courses of a tower lie on each other.
enum class TowerBond
{
    turned,  ///< odd courses turned by half a side: round towers
    toothed, ///< all polygons above each other, joints at corners and in the middle of sides in turn
    stacked  ///< all joints at the corners
};

inline std::array<std::pair<std::string_view, TowerBond>, 3> namesOf(TowerBond)
{
    return {
        {{"turned", TowerBond::turned}, {"toothed", TowerBond::toothed}, {"stacked", TowerBond::stacked}}};
}

struct Tower
{
    double innerRadius = 0.8; ///< of the corners [m]
    double outerRadius = 1;   ///< likewise [m]
    int around = 8;           ///< blocks of a course, sides of its polygon
    int courses = 6;
    double courseHeight = 0.25; ///< [m]
    TowerBond bond = TowerBond::turned;
};

void declare(Options& options, Tower& tower);

/// Courses from the bottom, in each anticlockwise from the x axis, all free. The axis is z.
Assembly<3> makeAssembly(const Tower& tower);

} // namespace drystone
