// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// From the solution of a program to the limit analysis that it belongs to. Internal to statics.
#pragma once

#include "statics/LimitAnalysis.h"

namespace drystone
{

/// Checks the dead load by itself and says what the structure does. \param solution of the program, by any
/// solver \param kept as solveLimitAnalysis has it
template<int Rows, int Forces>
LimitAnalysis completedAnalysis(const ConeProgram<Rows, Forces>& program, const ConeSolution& solution,
                                const InteriorPointSettings& settings, SymbolicAnalysis& kept);

} // namespace drystone
