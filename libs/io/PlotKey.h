// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Looks of many curves that differ in several settings: a colour, a line and a marker for each value of a
/// setting, instead of one for each curve, so that the legend has the values and not their combinations.
#pragma once

#include "io/Plot.h"

#include <string>
#include <vector>

namespace drystone
{

/// Gives the curves colours, lines and markers by their settings, takes their names away and adds curves
/// without points that stand in the legend for each value. The setting with most values has the colours, the
/// one with fewest the lines, all others together the markers.
/// \param words of each curve, one for each setting, as ("theta 1" "gaussSeidel")
/// \return whether it is possible: there are 7 colours, 3 lines and 4 markers; else nothing is changed
bool lookBySettings(std::vector<PlotCurve>& curves, const std::vector<std::vector<std::string>>& words);

} // namespace drystone
