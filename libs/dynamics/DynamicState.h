// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Where the blocks are and how fast they move at one instant.
#pragma once

#include "assembly/Assembly.h"

#include <vector>

namespace drystone
{

/// The state of a structure in motion, relative to the moving ground.
template<int Dim>
struct DynamicState
{
    double time = 0;                        ///< [s]
    std::vector<Placement<Dim>> placements; ///< one a block, fixed ones too
    Eigen::VectorXd velocity;               ///< (ux uy rz; ux uy uz rx ry rz) of each free block [m/s, rad/s]
};

/// Velocities of free blocks in axes that turn with them over a step: in space angular velocities are turned
/// by the rotations of the step, in the plane they stay as they are. \param displacement of the free blocks
template<int Dim>
Eigen::VectorXd turnedWithBlocks(Eigen::VectorXd velocity, const Eigen::VectorXd& displacement);

/// The structure as built and at rest.
template<int Dim>
DynamicState<Dim> stateAtRest(const Assembly<Dim>& assembly);

/// The mass properties with the centroids where the blocks are now: lever arms of contact forces are taken
/// to these.
template<int Dim>
std::vector<BlockMass<Dim>> placedMasses(std::vector<BlockMass<Dim>> blocks,
                                         const std::vector<Placement<Dim>>& placements);

} // namespace drystone
