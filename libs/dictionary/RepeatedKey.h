// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The warning of a key that stands twice in one place, in lists or not: what counts of both.
#pragma once

#include <fmt/format.h>

#include <string>
#include <string_view>

namespace drystone
{

/// What counts of two entries with one key.
enum class Repetition
{
    replaces,
    merges ///< dictionaries
};

/// To give an entry again is how a file that is included is overridden; twice in one place it is a mistake
/// more often than not.
inline std::string repeatedKeyText(std::string_view key, int firstLine, Repetition repetition)
{
    return fmt::format("{} is given twice, first at line {}; {}. Remove one of them", key, firstLine,
                       repetition == Repetition::merges ? "what both have is taken together"
                                                        : "the last one counts");
}

} // namespace drystone
