// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The texture `boxes`: blocks in space given by two corners each.
#pragma once

#include "assembly/Assembly.h"
#include "dictionary/Options.h"

#include <string>
#include <utility>
#include <vector>

namespace drystone
{

/// Boxes along the axes.
struct Boxes
{
    std::vector<std::pair<Vector<3>, Vector<3>>> blocks; ///< lower and upper corner of each [m]
};

void declare(Options& options, Boxes& boxes);

/// The first box without volume, as a message; empty when all have one.
std::string boxFault(const std::vector<std::pair<Vector<3>, Vector<3>>>& boxes);

/// The blocks, all free, in the order given.
Assembly<3> makeAssembly(const Boxes& boxes);

} // namespace drystone
