// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// `contactDynamics -postProcess`: functions of states that a run has stored. In this library since it runs
/// its functions.
#pragma once

#include "dynamics/DynamicCase.h"
#include "runControl/Time.h"

#include <filesystem>

namespace drystone
{

/// Runs the functions of controlDict on each state stored in the case, in order of time, into
/// postProcessing/<function>/<first time>/. \throws FatalError when there is no state, and for a folder there
/// that has tables of a run which began at that time
template<int Dim>
void postProcess(const std::filesystem::path& caseDirectory, const DynamicCase<Dim>& scene, const Time& time);

} // namespace drystone
