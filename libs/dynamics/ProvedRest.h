// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Steps from rest to rest that are taken with a proof instead of a program: `selection automatic`.
#pragma once

#include "dynamics/Step.h"

namespace drystone
{

/// Takes the step where the blocks are at rest, all effects are idle there (EffectTraits), and known forces
/// prove that the loads of the step move nothing (RestProof.h). The proof is the certificate that every other
/// step at rest has, with the tolerance of the solver. Nothing of the step is found, assembled or solved;
/// points and forces of the motion are those of the proof. \return whether it was taken; otherwise nothing
/// but the proof that the motion keeps has changed
template<int Dim>
bool staysAtRest(Step<Dim>& step);

} // namespace drystone
