// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// A state for ParaView in the folder of a case's series, so that one file opens all of them as they should
/// be seen.
#pragma once

#include <filesystem>

namespace drystone
{

/// Writes VTK/paraviewState.py: etc/paraview/drystone.py with the case filled in, which ParaView opens with
/// File > Load State and pvbatch runs. It shows blocks, contact points and forces, and finds its case again
/// when the folder is moved. \return whether it was written: not where etc/paraview is not installed with
/// the application \throws FatalError when it cannot be written
bool writeParaViewState(const std::filesystem::path& caseDirectory);

} // namespace drystone
