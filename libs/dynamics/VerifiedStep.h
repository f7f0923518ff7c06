// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Steps of `selection automatic` compared with the same steps with all effects of the case, of all blocks.
#pragma once

#include "dynamics/Motion.h"

namespace drystone
{

/// How far two motions are apart: the largest displacement of a block from one to the other, that of its
/// turning about as far from its mass centre as blocks are large [m]
template<int Dim>
double differenceOf(const DynamicCase<Dim>& scene, const DynamicState<Dim>& one,
                    const DynamicState<Dim>& other);

/// By how much the end of a step that was just taken differs from what it is with all effects of the case and
/// all blocks, which goes into `effectUse` of the motion. Where that is more than the error allowed in the
/// gaps at the end of a step, the step with all effects is taken again with gaps a hundred times closer, and
/// the smaller difference counts: what is left is not the error of the step that verifies. Warns where it is
/// still more than allowed, or where the step could not be verified: because it is not solved with all
/// effects, or differs while what it is compared with is no more certain: Coulomb's law is not met there to
/// what is allowed, or it changes by more where it is solved closer. Nothing else changes. \param before the
/// motion at the start of the step \param timeStep its length [s]
template<int Dim>
void verifyStep(const DynamicCase<Dim>& scene, const Motion<Dim>& before, double timeStep,
                Motion<Dim>& after);

} // namespace drystone
