// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// A search as the dictionaries of a case specify it, read and checked.
#pragma once

#include "ensembles/SearchPoint.h"
#include "runControl/CommandLine.h"

#include <filesystem>

namespace drystone
{

/// Reads system/parameterSearchDict and looks up the entries that it names.
/// \throws FatalIOError for faults in it, or in a dictionary with an entry to be varied
ParameterSearch readParameterSearch(const std::filesystem::path& caseDirectory,
                                    const CommandLine& commandLine);

/// Checks, before anything is computed, whether the folders of the search can be written.
/// \throws FatalError naming the one that cannot
void requireWritableResults(const ParameterSearch& search);

} // namespace drystone
