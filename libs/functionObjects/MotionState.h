// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// A motion as a time directory keeps it: what a run needs to go on bit for bit. Here and not in dynamics,
/// which does not see files.
#pragma once

#include "dynamics/Motion.h"
#include "io/TimeDirectory.h"
#include "runControl/Time.h"

namespace drystone
{

/// The state that `motionOf` and `timeOf` make a motion and a time of again.
template<int Dim>
State stateOf(const DynamicCase<Dim>& scene, const Motion<Dim>& motion, const Time& time);

/// Where the blocks are in a state. \throws FatalIOError where it is not one of so many blocks
template<int Dim>
std::vector<Placement<Dim>> placementsIn(const State& saved, std::size_t blocks);

/// The motion stored in a state. \throws FatalError where it is not one of this structure
template<int Dim>
Motion<Dim> motionOf(const DynamicCase<Dim>& scene, const State& saved);

/// The time at which a state was written.
TimeState timeOf(const State& saved);

} // namespace drystone
