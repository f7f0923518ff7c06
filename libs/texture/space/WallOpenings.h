// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Doors and windows of the texture `walls` next to each other and where walls meet.
#pragma once

#include "texture/space/WallPlan.h"

#include <string>
#include <vector>

namespace drystone
{

/// What an opening of another wall cuts out of a wall that runs through at their junction.
struct JunctionHole
{
    Interval along;    ///< of the wall [m]
    double bottom = 0; ///< first course
    double top = 0;    ///< first course above
};

/// For each wall its holes. An opening that goes over the whole of a junction is open in all of its courses.
std::vector<std::vector<JunctionHole>> junctionHoles(const Walls& settings,
                                                     const std::vector<WallInPlan>& walls,
                                                     const std::vector<std::vector<WallCrossing>>& crossings);

/// What is wrong with an opening or its lintel, as a predicate that continues "Opening 3 "; empty where
/// nothing is. \param settings with walls that meet as they may
std::string wallOpeningFault(const Walls& settings, const WallOpening& opening);

} // namespace drystone
