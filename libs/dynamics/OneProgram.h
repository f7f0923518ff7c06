// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// One of the cone programs that lead to the solution of a theta step, within the work that is left to it.
#pragma once

#include "conic/form/Form.h"
#include "dynamics/ThetaStep.h"

namespace drystone
{

/// Solves a program, and certifies what it gives the step: motion, forces and status, or rest. \param start
/// see solveConeProgram \param symbolic kept from program to program; may be null \return whether the
/// displacements are those that the contact forces give the blocks, Mbar^-1 (f - A c)
template<int Dim>
bool solveOnce(ThetaStep& step, const StepProgram<Dim>& program, const StepSettings& settings,
               const ConeSolution& start, SymbolicAnalysis* symbolic);

/// Whether another program would go beyond the work allowed.
template<int Dim>
bool isWorkUsedUp(const StepSettings& settings, const ThetaStep& step, const StepProgram<Dim>& program);

} // namespace drystone
