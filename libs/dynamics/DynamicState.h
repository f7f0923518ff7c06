// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Where the blocks are and how fast they move at one instant.
#pragma once

#include "assembly/Assembly.h"

#include <vector>

namespace drystone
{

/// The state of a structure in motion, relative to the moving ground.
struct DynamicState
{
    double time = 0;                      ///< [s]
    std::vector<Placement<2>> placements; ///< one a block, fixed ones too
    Eigen::VectorXd velocity;             ///< (ux uy rz) of each free block [m/s, m/s, rad/s]
};

/// The structure as built and at rest.
DynamicState stateAtRest(const Assembly<2>& assembly);

/// The mass properties with the centroids where the blocks are now: lever arms of contact forces are taken
/// to these.
std::vector<BlockMass<2>> placedMasses(std::vector<BlockMass<2>> blocks,
                                       const std::vector<Placement<2>>& placements);

} // namespace drystone
