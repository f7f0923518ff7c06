// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// One sample for the programs of others: Dakota and quoFEM write the values of the variables into a file,
/// and read the results from another one.
#pragma once

#include "ensembles/Design.h"

#include <filesystem>
#include <map>
#include <string>

namespace drystone
{

/// Values by name, from Dakota's standard format (`2 variables`, lines `value name`), its aprepro format
/// (`{ name = value }`) or quoFEM's (a line with their number, then lines `name value`).
/// \throws FatalIOError when it is none of these
std::map<std::string, SampleValue> readParameters(const std::filesystem::path& file);

/// Computes the sample of a parameter file and writes the results, a line of numbers in the order of
/// system/ensembleDict, or `FAIL` when one of them is no finite number, also when this process crashes.
/// \return exit status: 0, a sample that failed included
/// \throws FatalError when the file lacks a variable, or has one that system/ensembleDict has not
int evaluateSample(const std::filesystem::path& caseDirectory, const std::filesystem::path& parameters,
                   const std::filesystem::path& results);

} // namespace drystone
