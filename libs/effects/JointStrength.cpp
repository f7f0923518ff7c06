// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The key of a strength.
#include "effects/JointStrength.h"

namespace drystone
{

void declare(Options& options, JointStrength& strength)
{
    options.required("strength", strength.strength, "of a joint over its area")
        .unit("Pa")
        .atLeast(0)
        .example("1e5");
}

} // namespace drystone
