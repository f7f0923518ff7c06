// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// A step that is not parted: the stages of Step.h in their order.
#pragma once

#include "dynamics/Step.h"

namespace drystone
{

/// \return 1: it was solved; more than 0: blocks meet after this part of it, to which the next attempt is to
/// be shortened; 0: it was not solved. But for 1 the motion is as `advance` leaves that of a step which was
/// not solved \param attemptForces of other attempts, to which it adds its own; or null
template<int Dim>
double advanceUnparted(const DynamicCase<Dim>& scene, Motion<Dim>& motion, double timeStep,
                       const ImpactChoice& impacts, AttemptForces<Dim>* attemptForces = nullptr);

} // namespace drystone
