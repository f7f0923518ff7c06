// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// A collapse mechanism as motion: turns displacement rates into the displaced blocks that animations and
/// pictures show.
#pragma once

#include "assembly/Assembly.h"
#include "io/VtkSeries.h"

#include <Eigen/Core>

#include <type_traits>
#include <vector>

namespace drystone
{

/// Displacement rates of blocks, a column each: rows ux uy [m] rz [rad], in space ux uy uz [m] rx ry rz
/// [rad].
template<int Dim>
using Rates = Eigen::Matrix<double, freedomCount<Dim>, Eigen::Dynamic>;

/// Displacement rates of all blocks from those of the free blocks; zero for fixed blocks.
/// \param freeRates the rows of one free block after the other, in the order of freeIndices
template<int Dim>
Rates<Dim> ratesOfAllBlocks(const Assembly<Dim>& assembly, const Eigen::VectorXd& freeRates);

/// Largest displacement of any block corner under the rates, to first order [m].
template<int Dim>
double largestDisplacement(const Assembly<Dim>& assembly, const std::type_identity_t<Rates<Dim>>& rates);

/// Blocks displaced so that the corner that moves most moves by `amplitude` [m]: rates times a common factor,
/// rotations applied as finite ones so that blocks keep their shape. If all rates are zero the blocks are
/// left as built.
template<int Dim>
std::vector<Placement<Dim>> mechanismPlacements(const Assembly<Dim>& assembly,
                                                const std::type_identity_t<Rates<Dim>>& rates,
                                                double amplitude);

/// Writes the mechanism as an animation: `frames` frames at the times 0 to 1, from the structure as built to
/// a largest displacement of half a mean block, growing linearly; fields `displacementRate[-]` and
/// `rotationRate[rad/m]`, scaled so that the largest corner displacement rate is 1, in addition to those of
/// blockFrame. Where nothing moves there is one frame, at time 0. \param more fields, one value a block
template<int Dim>
void writeMechanism(VtkSeries& series, const Assembly<Dim>& assembly,
                    const std::type_identity_t<Rates<Dim>>& rates, const std::vector<Field>& more = {},
                    int frames = 21);

} // namespace drystone
