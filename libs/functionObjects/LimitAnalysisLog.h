// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// What a limit analysis prints: it combines statics with the meaning of loads, which statics does not see.
#pragma once

#include "statics/LimitAnalysisCase.h"

#include <filesystem>
#include <string>
#include <vector>

namespace drystone
{

/// Counts, effects and solver, for the log before the solution. \param caseDirectory where effects and
/// motions may be given that are no part of the analysis
template<int Dim>
void printLimitAnalysisCase(const LimitAnalysisCase<Dim>& structure,
                            const std::filesystem::path& caseDirectory);

/// Multiplier, status and certificate. No multiplier is printed for what did not converge.
template<int Dim>
void printLimitAnalysis(const LimitAnalysisCase<Dim>& structure, const std::vector<LimitAnalysis>& results);

} // namespace drystone
