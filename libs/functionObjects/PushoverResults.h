// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The capacity curve of a case for the user: it combines statics with output.
#pragma once

#include "runControl/PictureFormats.h"
#include "statics/LimitAnalysisCase.h"

#include <filesystem>

namespace drystone
{

/// Follows the capacity curve of a case and writes
/// - postProcessing/limitAnalysis/0/capacity.dat, a row for each position, and capacity.svg (or .png, .pdf:
///   `formats`);
/// - VTK/pushover.vtp.series, the blocks in at most about 100 of the positions, displacement as time.
///
/// Prints how it ends. \return whether the curve is complete: false where the solver failed
template<int Dim>
bool runPushover(const std::filesystem::path& caseDirectory, const LimitAnalysisCase<Dim>& structure,
                 const PictureFormats& formats = {PictureFormat::svg});

} // namespace drystone
