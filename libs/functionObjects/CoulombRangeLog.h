// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The sentences on the collapses by Coulomb's law that a limit analysis has found.
#pragma once

#include "statics/LimitAnalysisCase.h"

#include <string>
#include <vector>

namespace drystone
{

/// What is questioned of a lowest collapse by Coulomb's law that is far below the associative multiplier;
/// empty where it is not.
std::string questionOfLowest(const CoulombRange& range);

/// What is known of the collapses by Coulomb's law: each is an upper bound of the least, for the live load
/// reversed a lower bound. \param result of the analysis that the range is of
void printCoulombRange(const CoulombRange& range, const LimitAnalysis& result);

/// Warns of the searches that maximumTime has ended, and says what to do.
template<int Dim>
void printCutShort(const LimitAnalysisCase<Dim>& structure, const std::vector<LimitAnalysis>& results);

} // namespace drystone
