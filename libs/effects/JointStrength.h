// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// { strength c; }: what cohesion, tension and crushing, each an effect of its own, are given by.
#pragma once

#include "dictionary/Options.h"

namespace drystone
{

/// Strength of the joints over their area. Of cohesion: shear that a joint carries in addition to friction;
/// of tension: normal stress that holds it together; of crushing: pressure that it bears.
struct JointStrength
{
    double strength = 0; ///< [Pa]
};

void declare(Options& options, JointStrength& strength);

} // namespace drystone
