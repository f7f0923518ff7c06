// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Which blocks nothing holds: no path through joints leads from them to a support.
#pragma once

#include "contact/ContactPoint.h"

#include <string>
#include <vector>

namespace drystone
{

/// Blocks from which no path through joints leads to a fixed block, by index.
template<int Dim>
std::vector<int> blocksWithoutSupport(const Assembly<Dim>& assembly,
                                      const std::vector<ContactPoint<Dim>>& points);

/// `block 4 touches block 2 at a corner only: a joint needs ...`: the first pair without a joint of which one
/// stands on a face of the other on its corner or edge, where no force acts as built; or nothing. Bricks of a
/// bond, which meet those diagonally above them at edges, do not count. Takes time of order n log n in the
/// number of blocks.
template<int Dim>
std::string touchWithoutJoint(const Assembly<Dim>& assembly, const std::vector<ContactPoint<Dim>>& points);

/// The same as a warning of an analysis of the structure as built; empty where no blocks touch so.
template<int Dim>
std::string missingForceText(const Assembly<Dim>& assembly, const std::vector<ContactPoint<Dim>>& points);

/// What is known, from the joints alone, of why a structure cannot stand: no block is fixed, or some have no
/// path to a support through joints, those among them named that touch others at corners only, or all have
/// one and some stand on others on a corner or an edge too. Lines for the log, each with the repair; empty
/// when only equilibrium tells.
template<int Dim>
std::string instabilityCause(const Assembly<Dim>& assembly, const std::vector<ContactPoint<Dim>>& points);

/// Whether two blocks touch within a tolerance [m], if only at a corner or, in space, along an edge.
bool touch(const Block<2>& one, const Block<2>& other, double tolerance);
bool touch(const Block<3>& one, const Block<3>& other, double tolerance);

} // namespace drystone
