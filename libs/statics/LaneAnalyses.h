// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Limit analyses of structures that differ in properties and loads alone, several at once: samples of an
/// ensemble.
#pragma once

#include "conic/lanes/LaneSolver.h"
#include "statics/LimitAnalysisCase.h"

#include <optional>

namespace drystone
{

struct SymbolicAnalysis;

/// Whether a structure in the plane has one answer, at a positive multiplier by the associative flow rule,
/// LaneSolver takes its program, and its solver is left as it is by default but for the tolerance, or with
/// more iterations allowed.
bool isForLanes(const LimitAnalysisCase<2>& structure);

/// Has lanes begin near the solutions of those of the structures that are for lanes and have the points of
/// the first one of them (LaneSolver::beginFrom).
void beginLanesFrom(const std::vector<LimitAnalysisCase<2>>& structures, LaneSolver& lanes);

/// The answers of solveLimitAnalyses by LaneSolver, to the same tolerance, structures with the same points
/// together. Of those that are for lanes; of others, and where LaneSolver has none, nothing. What comes of a
/// structure does not depend on the others by a single bit. Multiplier and status are those of the structure;
/// forces, mechanism, certificate and iterations are those of one of its solutions, as another solver finds
/// another one where there are several.
/// \param lanes, kept of the last structures; not owned
template<int Dim>
std::vector<std::optional<LimitAnalysis>> solveInLanes(const std::vector<LimitAnalysisCase<Dim>>& structures,
                                                       LaneSolver& lanes, SymbolicAnalysis& kept);

} // namespace drystone
