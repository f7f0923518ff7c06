// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Contact points that the answers of a limit analysis require: where joints crush or are twisted.
#pragma once

#include "statics/LimitAnalysisCase.h"

namespace drystone
{

/// Adds points where joints crush within their faces (CrushingHinges.h), in space then where they are twisted
/// (JointDissipation.h): the finer the nearer the answers are to those of whole joints. \param structure
/// gets the points and a program of them \param results of one structure: its ends of the range, positions
/// of a load, combinations
/// \return whether any was added; never where the case says how many points joints have
template<int Dim>
bool addPoints(LimitAnalysisCase<Dim>& structure, const std::vector<LimitAnalysis>& results);
template<>
bool addPoints(LimitAnalysisCase<2>& structure, const std::vector<LimitAnalysis>& results);
template<>
bool addPoints(LimitAnalysisCase<3>& structure, const std::vector<LimitAnalysis>& results);

} // namespace drystone
