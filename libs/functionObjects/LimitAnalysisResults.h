// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// What limit analysis leaves in a case: the table, the animation and the picture of the mechanism, the
/// contact forces.
#pragma once

#include "statics/LimitAnalysisCase.h"

#include <filesystem>

namespace drystone
{

/// Asks, before anything is computed, whether the folders of the results can be written.
/// \throws FatalError naming the one that cannot
void requireWritableResults(const std::filesystem::path& caseDirectory);

/// Writes
/// - postProcessing/limitAnalysis/0/limitAnalysis.dat, the row of figures of the contract;
/// - postProcessing/limitAnalysis/0/mechanism.svg, the mechanism over the structure as built;
/// - VTK/blocks.vtp.series, the mechanism growing from the structure as built, with displacement rates;
/// - VTK/contacts.vtp.series, contact forces at collapse, gap and state.
/// \param cpuTime of the solution [s]
/// \throws FatalError naming what cannot be written
void writeLimitAnalysisResults(const std::filesystem::path& caseDirectory, const LimitAnalysisCase& structure,
                               const LimitAnalysis& result, double cpuTime);

} // namespace drystone
