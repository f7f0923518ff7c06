// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Random structures and loads, each reproduced by its seed.
#pragma once

#include "assembly/Loads.h"
#include "contact/Equilibrium.h"

#include <string>

namespace drystone
{

/// A structure with what limit analysis and one time step need of it.
struct RandomAssembly
{
    std::string family; ///< stack, courses, polygons, arch
    double mu = 0;
    double size = 1; ///< of a block, about [m]
    Assembly<2> assembly;
    std::vector<BlockMass<2>> blocks;
    std::vector<double> masses; ///< of all blocks [kg]
    std::vector<int> free;      ///< see freeIndices
    std::vector<ContactPoint<2>> points;
    CaseLoads<2> loads;

    int freeBlocks() const { return static_cast<int>(loads.dead.size()) / 3; }
};

/// The same on all machines: it draws from std::mt19937_64 alone.
RandomAssembly randomAssembly(unsigned seed);

/// Structures of the same families, their ground cut into pieces, and slabs on pads; one support moves, most
/// often down, and often it need not carry anything, or just so.
RandomAssembly randomSettlement(unsigned seed);

} // namespace drystone
