// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The step of bodies that a guess has chosen: solved, and those of them held that it has left at rest.
#pragma once

#include "dynamics/BlockGroups.h"
#include "dynamics/GroupChoice.h"

namespace drystone
{

/// The step of bodies, and the program of all blocks that it belongs to.
template<int Dim>
struct BodiesStep
{
    BlockGroups<Dim> groups;
    StepProgram<Dim> ofBlocks; ///< with the points between bodies, linearised as the last of the bodies
    StepProgram<Dim> program;  ///< of the bodies, as it came
    ThetaStep step;
    InteriorStart interior; ///< of all blocks
};

/// Solves the program of the bodies. Where there is a buffer (GroupChoice.h), blocks that creep are given
/// room where they overlap by no more than a gap that is kept: one between others that are held would have no
/// place there, since these do not make way.
template<int Dim>
BodiesStep<Dim> solveBodies(Step<Dim>& step, BlockGroups<Dim> groups, const GroupChoice<Dim>& choice);

/// Holds the bodies that the solved step has left where they were, if what is left solves its own program to
/// the tolerance. The forces between them, and between them and what was held, are then among those still to
/// be found: the step was solved as if what is held could bear any.
template<int Dim>
void holdBodiesAtRest(const Step<Dim>& step, BodiesStep<Dim>& bodies);

/// F k of all points of the step, zero within the bodies.
template<int Dim>
Eigen::VectorXd forcesBetween(const Step<Dim>& step, const BodiesStep<Dim>& bodies);

} // namespace drystone
