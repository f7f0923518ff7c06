// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// What finite turns of groups of blocks change in the program of a step.
#pragma once

#include "dynamics/BlockGroups.h"

namespace drystone
{

/// The relinearisation of all blocks, for the groups. \param ofBlocks kept up to date; not owned, as the
/// others \param ofGroups see programOfGroups
template<int Dim>
Relinearisation<Dim> relinearisationOfGroups(const Step<Dim>& step, const BlockGroups<Dim>& groups,
                                             StepProgram<Dim>& ofBlocks, const StepProgram<Dim>& ofGroups);

/// The displacements of the groups to the last digits: those that the forces give them, with h of just these.
/// \param ofBlocks its load is that of the end of the step \param program of the groups, as it was made
template<int Dim>
Eigen::VectorXd balancedDisplacement(const BlockGroups<Dim>& groups, const StepProgram<Dim>& ofBlocks,
                                     const StepProgram<Dim>& program, const Eigen::VectorXd& contactForce,
                                     Eigen::VectorXd ofGroups);

} // namespace drystone
