// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// A collapse mechanism as motion: from displacement rates to displaced blocks.
#pragma once

#include "assembly/Assembly.h"
#include "io/VtkSeries.h"

#include <Eigen/Core>

#include <vector>

namespace drystone
{

/// Displacement rates of all blocks from those of the free ones.
/// \param freeRates 3 a free block: ux uy rz, in the order of freeIndices
/// \return 3 x blocks: rows ux uy [m] rz [rad], a column a block; zero for fixed blocks
Eigen::Matrix3Xd ratesOfAllBlocks(const Assembly<2>& assembly, const Eigen::VectorXd& freeRates);

/// Largest displacement of any block corner under the rates, to first order [m].
double largestDisplacement(const Assembly<2>& assembly, const Eigen::Matrix3Xd& rates);

/// Blocks displaced so that the corner that moves most moves by `amplitude` [m]: rates times a common factor,
/// rotations taken as finite ones so that blocks keep their shape. Rates that are all zero leave the blocks
/// as built.
std::vector<Placement<2>> mechanismPlacements(const Assembly<2>& assembly, const Eigen::Matrix3Xd& rates,
                                              double amplitude);

/// Writes the mechanism as an animation: `frames` frames at the times 0 to 1, as built at first, the largest
/// displacement growing evenly to half a mean block at last; fields `displacementRate` and `rotationRate`,
/// scaled so that the largest corner displacement rate is 1, besides those of blockFrame. Where nothing moves
/// there is one frame, at time 0.
void writeMechanism(VtkSeries& series, const Assembly<2>& assembly, const Eigen::Matrix3Xd& rates,
                    int frames = 21);

} // namespace drystone
