// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Questions about strengths of joints that are correct and may not be what was meant. What a load is
/// compared with them is known with the answer only.
#pragma once

#include "core/Doubt.h"
#include "statics/LimitAnalysisCase.h"

#include <vector>

namespace drystone
{

/// Of a structure that cannot carry its dead load: whether the joints on supports bear less than it in all,
/// as where a crushing strength in MPa is given as one in Pa. Nothing where they could bear it.
template<int Dim>
std::vector<Doubt> doubtsAboutCrushing(const LimitAnalysisCase<Dim>& structure, const LimitAnalysis& result);

/// Of a structure without an answer: whether joints have strengths that no stone has.
std::vector<Doubt> doubtsAboutLargeStrengths(const ContactProperties& contact, const LimitAnalysis& result);

} // namespace drystone
