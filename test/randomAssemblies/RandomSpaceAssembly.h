// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Random structures of space with loads and strengths, each reproduced by its seed.
#pragma once

#include "assembly/Loads.h"
#include "conic/ConeProgram.h"
#include "contact/ContactPoint.h"

#include <string>

namespace drystone
{

/// A structure with what limit analysis needs of it.
struct RandomSpaceAssembly
{
    std::string family; ///< boxes, cuts, walls
    double mu = 0;
    Assembly<3> assembly;
    std::vector<BlockMass<3>> blocks;
    std::vector<int> free; ///< see freeIndices
    std::vector<ContactPoint<3>> points;
    std::vector<Strength> strength; ///< of each point, or empty
    LoadVectors loads;

    int freeBlocks() const { return static_cast<int>(loads.dead.size()) / 6; }
};

/// Turned boxes on each other; boxes cut by random planes, which are all there is between their parts; walls
/// of any bond, some with a return. Friction of 0.1 to 2, loads in all directions or at a point, strengths or
/// none. The same on all machines: it draws from std::mt19937_64 alone.
RandomSpaceAssembly randomSpaceAssembly(unsigned seed);

} // namespace drystone
