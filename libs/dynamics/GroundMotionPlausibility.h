// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Questions about the times at which a motion of the ground is computed.
#pragma once

#include "core/Doubt.h"
#include "effects/GroundMotion.h"
#include "runControl/TimeControls.h"

#include <vector>

namespace drystone
{

/// What is improbable of the times that a motion of the ground is computed at: steps coarser than its points
/// or a quarter of its waves, an end before its end. \param controlDict for the places
std::vector<Doubt> doubtsAboutTimes(const GroundMotion& motion, const TimeControls& controls,
                                    const Dictionary& controlDict);

} // namespace drystone
