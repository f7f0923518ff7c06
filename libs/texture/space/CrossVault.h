// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The texture `crossVault`: two semicircular barrels that cross each other at right angles in groins.
#pragma once

#include "assembly/Assembly.h"
#include "dictionary/Options.h"

namespace drystone
{

struct CrossVault
{
    double radius = 1;      ///< of the middle surface of both barrels [m]
    double thickness = 0.2; ///< [m]
    int voussoirs = 8;      ///< of equal angle across each web, even: a joint is at the crown
    double reach = 1.4;     ///< from the centre to the free edge of each web [m]
};

void declare(Options& options, CrossVault& vault);

/// Web by web (+y, -x, -y, +x), in each the voussoirs from springing to springing, anticlockwise seen from
/// the free edge; all free. Each reaches in one block from the groin planes x = +-y to the free edge. The
/// vault springs from z = 0.
Assembly<3> makeAssembly(const CrossVault& vault);

} // namespace drystone
