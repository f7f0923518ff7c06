// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// What loads do to blocks that have turned since they were built: at rest and in motion the same.
#pragma once

#include "assembly/Assembly.h"
#include "assembly/Loads.h"

namespace drystone
{

/// The rows of a load with the blocks where they are: forces as they were, and of a block that has turned by
/// R the moment sum (R a) x f about its mass centre. Of blocks that have not turned the same to the last bit.
/// \param free see freeIndices
template<int Dim>
Eigen::VectorXd turnedLoad(const Load& load, const std::vector<int>& free,
                           const std::vector<Placement<Dim>>& placements);

/// Work that the forces of a load on one block do as it turns about its mass centre from where it was built:
/// sum f'(R - 1) a [J]. \param freeIndex of the block
template<int Dim>
double workOfTurning(const Load& load, int freeIndex, const Placement<Dim>& placement);

} // namespace drystone
