// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Outlines in paths and lists of points of SVG, in units of the file.
#pragma once

#include "geometry/Polygon.h"
#include "import/SvgScanner.h"

#include <vector>

namespace drystone
{

/// What a shape consists of.
struct SvgOutlines
{
    std::vector<Polygon> closed; ///< the last corner may be the first again
    int open = 0;                ///< those of more than one point that are not closed
    int openOfThree = 0;         ///< of these those of three and more points
};

/// Whether outlines that nothing closes end where they begin.
bool endsMeet(const Polygon& corners);

/// The attribute `points` of a polygon, or of a line. \param digits counts those of the numbers
/// \throws FatalIOError for what is no number
Polygon svgPoints(SvgScanner points, DigitCount& digits);

/// The attribute `d` of a path of straight lines. \param digits counts those of the numbers
/// \throws FatalIOError for curves, which no block has, and for what is no path
SvgOutlines svgPath(SvgScanner path, DigitCount& digits);

} // namespace drystone
