// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Lists in messages, which are cut off before they fill the terminal.
#pragma once

#include <fmt/ranges.h>

#include <algorithm>
#include <iterator>
#include <string>
#include <string_view>

namespace drystone
{

/// The first items of a list, `most` at the most, and how many there are besides: `3, 4 and 20 more`. Of no
/// items it is empty.
/// \param items of random access, of a type that fmt prints
template<class Items>
std::string shownList(const Items& items, std::size_t most, std::string_view separator = ", ")
{
    const std::size_t shown = std::min(most, std::size(items));
    const std::size_t more = std::size(items) - shown;
    const auto begin = std::begin(items);
    return fmt::format("{}{}", fmt::join(begin, begin + static_cast<std::ptrdiff_t>(shown), separator),
                       more > 0 ? fmt::format(" and {} more", more) : "");
}

} // namespace drystone
