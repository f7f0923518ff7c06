// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The texture `courses`, given block by block: coursed rubble, quoins, anything built in layers of equal
/// height.
#pragma once

#include "assembly/Assembly.h"
#include "dictionary/Options.h"

#include <vector>

namespace drystone
{

struct Courses
{
    Vector<2> unit{0.4, 0.175}; ///< unit of the lengths in `rows`, height of a course [m]
    double thickness = 1;       ///< out of plane [m]
    std::vector<std::vector<double>>
        rows; ///< bottom course first, from left to right [units]; negative: a void
};

void declare(Options& options, Courses& courses);

/// The blocks, all free, by course from the bottom and from left to right. The lower left corner is the
/// origin.
Assembly<2> makeAssembly(const Courses& courses);

} // namespace drystone
