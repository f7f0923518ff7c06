// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Files of the multipliers of a moving load over its places.
#pragma once

#include "runControl/PictureFormats.h"
#include "statics/LimitAnalysisCase.h"

#include <filesystem>
#include <string>

namespace drystone
{

/// Writes postProcessing/limitAnalysis/0/movingLoad.dat, a row a position and block: `distance[m] x[m] y[m]
/// block[-] alpha[-] status[-]` (in space z[m] too; `block` the first that carries an axle), and
/// movingLoad.svg (or .png, .pdf), the lower multiplier over the distance with the worst place. Without a
/// moving load removes those of an earlier run.
template<int Dim>
void writeEnvelope(const std::filesystem::path& folder, const LimitAnalysisCase<Dim>& structure,
                   const std::string& caseName, const PictureFormats& formats = {PictureFormat::svg});

} // namespace drystone
