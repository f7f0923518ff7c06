// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Lines of the log of a search for collapses by Coulomb's law while it goes on.
#pragma once

#include "core/Log.h"
#include "statics/NonAssociative.h"

#include <functional>
#include <string_view>

namespace drystone
{

/// Whether nonAssociative/maximumTime ends a search for collapses by Coulomb's law.
enum class SearchTime
{
    endless,
    limited
};

/// Reports every ten seconds how far a search for collapses by Coulomb's law has come, for
/// NonAssociativeSettings::observe, and of an endless one after half a minute, once, which key would end it.
/// \param clock [s]
std::function<void(const CollapseProgress&)> collapseProgressLog(SearchTime time,
                                                                 std::function<double()> clock = clockTime);

/// How a line of the log on a search for collapses by Coulomb's law begins.
inline constexpr std::string_view coulombWords = "Coulomb's law: ";

/// Whether a line of the log is one of collapseProgressLog.
bool isCollapseProgress(std::string_view line);

} // namespace drystone
