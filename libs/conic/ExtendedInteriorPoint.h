// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The interior point in numbers of twice as many digits, for programs that rounding defeats in double
/// precision.
#pragma once

#include "conic/Divergence.h"
#include "conic/InteriorPoint.h"
#include "conic/RayProgram.h"

namespace drystone
{

/// Whether the Schur system of a program, and the number of its points, are small enough for it: iterations
/// take some seconds at most.
bool isExtendedAffordable(const PlaneConeProgram& program, const SymbolicAnalysis& symbolic);

/// Solves a ray form from a cold start (Mehrotra 1992, predictor and corrector), its iterates, Schur system
/// and residuals in DoubleDouble. The condition of that system grows with the fourth power of the bodies of a
/// chain, such as the voussoirs of an arch, and without limit towards the optimum; with 106 bits neither
/// counts. Forces are added up before they are rounded.
/// \param form with its groups' places in the Schur system \return `optimal` where the scaled residuals
/// meet the tolerance of the settings, `unbounded` where there may be no largest multiplier, else
/// `notConverged`, with displacements that may prove that there is no solution
ConeSolution solveInExtendedPrecision(const PlaneConeProgram& program, const RayForm& form,
                                      const InteriorPointSettings& settings, Sought sought);

} // namespace drystone
