// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The order in which bodies are eliminated, which decides how many numbers a factor has.
#pragma once

#include "linear/BlockPattern.h"

#include <vector>

namespace drystone
{

/// An order of the bodies that keeps the factor sparse: entry k is the body that is eliminated k-th. Minimum
/// degree (Amestoy, Davis & Duff 2004) for some thousand bodies, nested dissection (Karypis & Kumar 1998) for
/// more; then in postorder of the elimination tree, in which bodies whose columns are alike follow each
/// other. The same for the same couplings in any order. \param couplings pairs of bodies, either way round
/// and as often as you like
std::vector<int> eliminationOrder(int bodies, const std::vector<Coupling>& couplings);

/// For each body its place in the order: the inverse of eliminationOrder.
std::vector<int> placesIn(const std::vector<int>& order);

/// Couplings of bodies as couplings of their places.
std::vector<Coupling> couplingsByPlace(std::vector<Coupling> couplings, const std::vector<int>& places);

} // namespace drystone
