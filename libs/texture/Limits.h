// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The largest structure that a texture generates, one limit for all of them.
#pragma once

#include <fmt/format.h>

#include <string>
#include <string_view>

namespace drystone
{

/// More blocks than this are taken for a typing error, before memory is exhausted.
inline constexpr int maximumBlocks = 10'000'000;

/// A message where a texture has more blocks than that; empty: it has not. \param what it is of, as `A wall
/// of 5 units by 6 courses`
inline std::string countFault(double blocks, std::string_view what)
{
    return blocks > maximumBlocks
               ? fmt::format("{} has more than {} blocks: make it smaller.", what, maximumBlocks)
               : "";
}

} // namespace drystone
