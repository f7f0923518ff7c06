// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// What the checks of an assembly have found, and its text.
#pragma once

#include "contact/AssemblyStatistics.h"

#include <string>
#include <vector>

namespace drystone
{

/// The outcome of one check.
struct CheckResult
{
    std::string name;                ///< `volumes`, `inertia`, `duplicates`, `overlaps`, ...
    std::string message;             ///< one line for the user: what was found, with the figures
    int failures = 0;                ///< blocks or pairs at fault; 0: OK
    std::vector<std::string> faults; ///< a line each for the first few, naming the blocks
};

/// What checkAssembly (AssemblyChecks.h) finds.
template<int Dim>
struct AssemblyReport
{
    AssemblyStatistics<Dim> statistics;
    std::vector<CheckResult> checks;
};

/// A place as the report names it [m]: to the millimetre where a structure has coordinates of a map.
template<int Dim>
std::string placeText(const Vector<Dim>& place);

/// Number of checks that failed.
template<int Dim>
int failedChecks(const AssemblyReport<Dim>& report);

/// The report as `checkBlocks` prints it, ending in `Assembly OK.` or `Failed N checks.`
template<int Dim>
std::string printedReport(const Assembly<Dim>& assembly, const AssemblyReport<Dim>& report);

} // namespace drystone
