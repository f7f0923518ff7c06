// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Correlated variables of any distributions, as functions of correlated normal ones.
#pragma once

#include "ensembles/Distribution.h"

#include <optional>

namespace drystone
{

/// Correlation of two standard normal variables for which two others, functions of them, are correlated by
/// `wanted` (Nataf 1962; Liu and Der Kiureghian 1986). \return nothing where no correlation is enough
std::optional<double> natafCorrelation(const Distribution& first, const Distribution& second, double wanted);

} // namespace drystone
