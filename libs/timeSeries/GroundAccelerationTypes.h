// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Histories of acceleration that a dictionary chooses from by `type`:
///
///     acceleration { type halfSine; amplitude 4.8; duration 0.5; }
#pragma once

#include "dictionary/Registry.h"
#include "timeSeries/RecordMotion.h"

#include <filesystem>
#include <functional>

namespace drystone
{

/// What a dictionary's `acceleration` makes once it is known where the case is.
/// \throws FatalIOError for what is wrong with files
using AccelerationMaker = std::function<DescribedAcceleration(const std::filesystem::path& caseDirectory)>;

/// All types of ground acceleration: constant, rectangularPulse, halfSine, sine, table, record.
const Registry<AccelerationMaker>& groundAccelerationTypes();

} // namespace drystone
