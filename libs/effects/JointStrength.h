// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// { strength c; }: what cohesion, tension and crushing, each an effect of its own, are given by.
#pragma once

#include "contact/ContactProperties.h"
#include "dictionary/Options.h"

namespace drystone
{

void declare(Options& options, JointStrength& strength);

} // namespace drystone
