// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Words the doubt, with the entry as it would be were degrees meant.
#include "core/Degrees.h"

#include <fmt/format.h>

#include <numbers>

namespace drystone
{

std::string doubtAboutDegrees(double angle, const std::string& before, const std::string& after)
{
    return fmt::format("A rotation of {:g} rad is {:.4g} degrees. Angles are in rad: {:g} degrees would be "
                       "`{}{:.9g}{}`.",
                       angle, angle * 180 / std::numbers::pi, angle, before, angle * std::numbers::pi / 180,
                       after);
}

} // namespace drystone
