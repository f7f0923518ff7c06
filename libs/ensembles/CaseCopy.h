// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Copies of a case, in which studies run applications: its input without its results.
#pragma once

#include <filesystem>
#include <vector>

namespace drystone
{

/// Copies the input of a case: all but results (VTK, postProcessing, logs, times other than 0) and the files
/// of a search (parameterSearch). An existing `target` is removed first. \throws FatalError
void copyCase(const std::filesystem::path& caseDirectory, const std::filesystem::path& target);

/// The files that copyCase copies, sorted.
std::vector<std::filesystem::path> filesOfCase(const std::filesystem::path& caseDirectory);

} // namespace drystone
