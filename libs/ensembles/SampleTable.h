// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Samples of an ensemble that stand in a table of the case.
#pragma once

#include "ensembles/Design.h"

#include <filesystem>
#include <vector>

namespace drystone
{

/// The rows of the table that a design names, each with the values of the variables in their order, whatever
/// the order of its columns, which the last comment names, or as in a CSV file the first line. \param
/// caseDirectory that its file counts from \throws FatalIOError where there is no such file, no column of a
/// variable or no row, or where a row has other than as many values as there are columns
std::vector<std::vector<SampleValue>> readSampleTable(const Design& design,
                                                      const std::vector<Named<EnsembleVariable>>& variables,
                                                      const std::filesystem::path& caseDirectory);

} // namespace drystone
