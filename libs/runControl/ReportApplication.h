// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The option -report of solvers: in this library because a solver that linked what a report needs would take
/// longer to start than a limit analysis to end.
#pragma once

#include <filesystem>

namespace drystone
{

/// Runs the application `report`, from the folder of the one that runs, on a case and prints what it wrote;
/// its messages of faults appear on standard error.
/// \throws FatalError when it cannot be started, or its fault with its exit status
void runReport(const std::filesystem::path& caseDirectory);

} // namespace drystone
