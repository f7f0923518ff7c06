// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// { strength c; }: what cohesion, tension and crushing, each an effect of its own, are given by.
#pragma once

#include "dictionary/Options.h"

#include <optional>
#include <string>
#include <string_view>

namespace drystone
{

/// Strength of the joints over their area. Of cohesion: shear that a joint carries in addition to friction;
/// of tension: normal stress that holds it together; of crushing: pressure that it bears.
struct JointStrength
{
    double strength = 0; ///< [Pa]
};

void declare(Options& options, JointStrength& strength);

/// Of cohesion or tension: whether it is next to nothing, as where a number in MPa is given as one in Pa.
/// A crushing strength is compared with the dead load instead, and the answer shows it at once.
/// \param kind cohesion or tension
/// \returns empty when there is no doubt
std::string doubtAboutBond(const std::optional<JointStrength>& bond, std::string_view kind);

} // namespace drystone
