// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The texture `column`: columns of drums, alone or under an architrave.
#pragma once

#include "assembly/Assembly.h"
#include "dictionary/Options.h"

#include <optional>
#include <vector>

namespace drystone
{

/// One beam over all columns of a row.
struct Architrave
{
    double width = 0.6;  ///< across the row [m]
    double height = 0.5; ///< [m]
    double overhang = 0; ///< past the axes of the outermost columns [m]
};

void declare(Options& options, Architrave& architrave);

struct Column
{
    double radius = 0.3; ///< of the corners at the foot [m]
    int sides = 8;       ///< of its section; one of them faces along x
    int drums = 5;
    double drumHeight = 0.4; ///< [m]
    double taper = 0;        ///< by which part the radius is smaller at the top than at the foot
    std::vector<Vector<2>> at{Vector<2>(0, 0)}; ///< axes of the columns in plan [m]
    std::optional<Architrave> architrave = {};
};

void declare(Options& options, Column& column);

/// Column by column in the order given, each by drum from the foot, then the architrave; all free. Feet stand
/// on z = 0.
Assembly<3> makeAssembly(const Column& column);

} // namespace drystone
