// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// A collapse mechanism as motion: turns displacement rates into the displaced blocks that animations and
/// pictures show.
#pragma once

#include "assembly/Assembly.h"
#include "io/VtkSeries.h"

#include <Eigen/Core>

#include <vector>

namespace drystone
{

/// Displacement rates of all blocks from those of the free blocks.
/// \param freeRates 3 per free block: ux uy rz, in the order of freeIndices
/// \return 3 x blocks: rows ux uy [m] rz [rad], one column per block; zero for fixed blocks
Eigen::Matrix3Xd ratesOfAllBlocks(const Assembly<2>& assembly, const Eigen::VectorXd& freeRates);

/// Largest displacement of any block corner under the rates, to first order [m].
double largestDisplacement(const Assembly<2>& assembly, const Eigen::Matrix3Xd& rates);

/// Blocks displaced so that the corner that moves most moves by `amplitude` [m]: rates times a common factor,
/// rotations applied as finite ones so that blocks keep their shape. If all rates are zero the blocks are
/// left as built.
std::vector<Placement<2>> mechanismPlacements(const Assembly<2>& assembly, const Eigen::Matrix3Xd& rates,
                                              double amplitude);

/// Writes the mechanism as an animation: `frames` frames at the times 0 to 1, from the structure as built to
/// a largest displacement of half a mean block, growing linearly; fields `displacementRate` and
/// `rotationRate`, scaled so that the largest corner displacement rate is 1, in addition to those of
/// blockFrame. Where nothing moves there is one frame, at time 0.
void writeMechanism(VtkSeries& series, const Assembly<2>& assembly, const Eigen::Matrix3Xd& rates,
                    int frames = 21);

} // namespace drystone
