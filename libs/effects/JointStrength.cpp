// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The key of a strength, and the doubt about one that is next to nothing.
#include "effects/JointStrength.h"

#include <fmt/format.h>

namespace drystone
{

void declare(Options& options, JointStrength& strength)
{
    options.required("strength", strength.strength, "of a joint over its area")
        .unit("Pa")
        .atLeast(0)
        .example("1e5");
}

std::string doubtAboutBond(const std::optional<JointStrength>& bond, std::string_view kind)
{
    // The weakest lime mortar has thousands; in MPa mortar and stone have from 0.001 to some 10.
    constexpr double weakest = 10; // [Pa]
    if (!bond || bond->strength == 0 || bond->strength >= weakest)
    {
        return {};
    }
    return fmt::format(
        "{} {{ strength {:g}; }} is next to nothing: usual is from {:g} Pa, and mortar has 1e4 "
        "to 1e6. Strengths are in Pa; were it meant in MPa, write `strength {:.0f};`. It is "
        "used as it stands.",
        kind, bond->strength, weakest, 1e6 * bond->strength);
}

} // namespace drystone
