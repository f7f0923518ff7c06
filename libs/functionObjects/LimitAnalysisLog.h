// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// What a limit analysis prints: it combines statics with the meaning of loads, which statics does not see.
#pragma once

#include "core/Log.h"
#include "statics/LimitAnalysisCase.h"

#include <filesystem>
#include <functional>
#include <string_view>
#include <vector>

namespace drystone
{

/// Counts, effects and solver, for the log before the solution. \param caseDirectory where effects and
/// motions may be given that are no part of the analysis
template<int Dim>
void printLimitAnalysisCase(const LimitAnalysisCase<Dim>& structure,
                            const std::filesystem::path& caseDirectory);

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

/// What is asked of a lowest collapse by Coulomb's law that is far below the associative multiplier; empty
/// where it is not.
std::string questionOfLowest(const CoulombRange& range);

/// Multiplier, status and certificate. No multiplier is printed for what did not converge.
template<int Dim>
void printLimitAnalysis(const LimitAnalysisCase<Dim>& structure, const std::vector<LimitAnalysis>& results);

} // namespace drystone
