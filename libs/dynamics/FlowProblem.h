// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// What the ways to Coulomb's law in a step begin with.
#pragma once

#include "dynamics/ThetaStep.h"

namespace drystone
{

/// A step, or an impact, that is to obey Coulomb's law. Nothing is owned.
template<int Dim>
struct FlowProblem
{
    const StepProgram<Dim>& program; ///< its gaps without what the flow opens
    const StepSettings& settings;
    /// Empty with smallDisplacements and for an impact, whose gaps are as they are.
    const Relinearisation<Dim>& relinearise;
    const Eigen::VectorXd& expected; ///< motion that forces change: dt v0, rows of each free block [m, rad]
    SymbolicAnalysis& symbolic;      ///< brought up to date
};

} // namespace drystone
