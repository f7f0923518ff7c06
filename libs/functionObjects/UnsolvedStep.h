// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The message of a run through time that ends before its time, with its remedy.
#pragma once

#include "dynamics/Motion.h"

#include <string>

namespace drystone
{

/// Why a run ends here, and what may repair it.
template<int Dim>
std::string unsolvedStep(const DynamicCase<Dim>& scene, const Motion<Dim>& motion, const Time& time);

} // namespace drystone
