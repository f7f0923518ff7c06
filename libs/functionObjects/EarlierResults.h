// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Files of an earlier limit analysis, of other loads, that would be found among the results of this one: in
/// this library because it writes them.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace drystone
{

/// Removes mechanism, thrust, coulomb and the series in VTK/ of answers that an earlier run has written and
/// this one has not, known by their mechanism<suffix>.svg: no other file is touched. Series without suffix
/// have the names of those of contactDynamics and stay where time directories show that it has run here.
/// \param suffixes of the answers of this run; empty where there is none
/// \return names of the answers removed, e.g. `mechanism_wind.svg`
std::vector<std::string> removeEarlierResults(const std::filesystem::path& caseDirectory,
                                              const std::vector<std::string>& suffixes);

/// Writes a table, or removes that of an earlier run where this one has none. \param text empty: none
void writeOrRemove(const std::filesystem::path& file, const std::string& text);

/// Removes the capacity curve of an earlier run: table, picture and series.
void removeCapacityCurve(const std::filesystem::path& caseDirectory);

} // namespace drystone
