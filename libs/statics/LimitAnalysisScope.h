// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// What limit analysis is formulated for, and what of a case is not.
#pragma once

#include "statics/LimitAnalysisCase.h"

namespace drystone
{

/// \param structure read, with its program
/// \throws FatalIOError with the place of what does not go together: contact by surfaces, a capacity curve,
/// points of joints, a moving load or a support that moves with what these are not formulated for
template<int Dim>
void requireInScope(const LimitAnalysisCase<Dim>& structure);

} // namespace drystone
