// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Coordinates as the writers write them.
#pragma once

#include "import/export/Writers.h"

#include <fmt/format.h>

#include <string>

namespace drystone
{

/// Adding 0 turns -0 into 0.
inline std::string written(double value, const WrittenNumbers& numbers)
{
    return numbers.decimals ? fmt::format("{:.{}f}", value + 0.0, *numbers.decimals)
                            : fmt::format("{}", value + 0.0);
}

/// As `written`, but with 17 digits where all are requested, though fewer would read as the same double: a
/// reader may take 0.25 and 0.125 for what rounding left of coordinates (DigitCount does).
inline std::string writtenInFull(double value, const WrittenNumbers& numbers)
{
    return numbers.decimals ? written(value, numbers) : fmt::format("{:#.17g}", value + 0.0);
}

/// `x y z` with a separator between.
inline std::string written(const Vector<3>& place, const WrittenNumbers& numbers, std::string_view separator)
{
    return fmt::format("{}{}{}{}{}", written(place.x(), numbers), separator, written(place.y(), numbers),
                       separator, written(place.z(), numbers));
}

} // namespace drystone
