// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Questions about a record of the ground that can be computed and may not be what was meant.
#pragma once

#include "core/Doubt.h"
#include "dictionary/Dictionary.h"
#include "effects/GroundMotion.h"

#include <vector>

namespace drystone
{

/// What is improbable of a record: a peak that no earthquake has, a scale that converts a unit which is
/// converted already, rows that are missing, a velocity that is left when the motion ends (the mean
/// acceleration times the duration).
/// \param component made from `acceleration`, the sub-dictionary of constant/groundMotion; of another type
/// than `record` nothing is doubted
std::vector<Doubt> doubtsAboutRecord(const GroundMotion::Component& component,
                                     const Dictionary& acceleration);

} // namespace drystone
