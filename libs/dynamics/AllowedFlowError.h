// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// By how much the solution of a program may miss Coulomb's law and still be that of the step.
#pragma once

#include "dynamics/ThetaStep.h"

namespace drystone
{

/// The solution of one of the programs in turn that lead to a step. Nothing is owned.
struct FlowSolution
{
    const ThetaStep& step;           ///< holds it, and how many programs were solved
    const Eigen::VectorXd& opening;  ///< its dilatancy mu |u_t|, one a point [m]
    const Eigen::VectorXd& gap;      ///< without what the program imposed, Dim a point [m]
    const Eigen::VectorXd& expected; ///< motion by the guess, rows of each free block [m, rad]
    double wayOfLoads;               ///< how far the loads would take the blocks without contacts [m]
    bool isBalanced;                 ///< its displacements are those that its forces give the blocks
};

/// Error allowed in mu |u_t| [m]: for the first programs that of their tolerance, then a share of what the
/// step changes the motion by, and after many a larger one. Of an impact all are velocities [m/s].
template<int Dim>
double allowedFlowError(const FlowSolution& solution, const StepSettings& settings);

} // namespace drystone
