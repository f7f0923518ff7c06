// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// By how much the solution of a program may miss Coulomb's law and still be that of the step.
#pragma once

#include "dynamics/ThetaStep.h"

#include <vector>

namespace drystone
{

/// How the solution of a program missed Coulomb's law.
struct MissedFlow
{
    double error; ///< of mu |u_t|, at the worst of the points that touch [m]
    double moved; ///< by how much the step changes the motion of the block that it changes most [m]
};

/// Whether the last programs have brought the law no nearer, and the step not another motion: points swing
/// then between states that make no difference to it. Where a motion just begins it grows from program to
/// program.
/// \param programs all of the step, in turn
bool hasStalled(const std::vector<MissedFlow>& programs);

/// The solution of one of the programs in turn that lead to a step. Nothing is owned.
struct FlowSolution
{
    const ThetaStep& step;                 ///< holds it, and how many programs were solved
    const Eigen::VectorXd& opening;        ///< its dilatancy mu |u_t|, one a point [m]
    const Eigen::VectorXd& gap;            ///< without what the program imposed, Dim a point [m]
    const std::vector<MissedFlow>& missed; ///< by all programs of the step up to it, in turn
    double wayOfLoads;                     ///< how far the loads would take the blocks without contacts [m]
    bool isPredicted;                      ///< its openings are those of alternating directions
    bool isBalanced;                       ///< its displacements are those that its forces give the blocks
};

/// Error allowed in mu |u_t| [m]: for the first programs that of their tolerance, then a share of what the
/// step changes the motion by, and where that stalls, or after many, a larger one. Openings by alternating
/// directions have a share of their own from the first program on. Of an impact all are velocities [m/s].
template<int Dim>
double allowedFlowError(const FlowSolution& solution, const StepSettings& settings);

} // namespace drystone
