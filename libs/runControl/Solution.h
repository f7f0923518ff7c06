// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// system/solution: how the applications solve, a sub-dictionary for each of them.
#pragma once

#include "dictionary/Dictionary.h"

#include <filesystem>
#include <string>
#include <vector>

namespace drystone
{

/// The applications that may have a sub-dictionary in system/solution.
const std::vector<std::string>& solutionApplications();

/// The sub-dictionary of an application, empty when it or the file is absent: every solver has defaults.
/// Those of other applications are not looked into.
/// \throws FatalIOError for an entry that is no sub-dictionary of an application
Dictionary readSolution(const std::filesystem::path& caseDirectory, const std::string& application);

} // namespace drystone
