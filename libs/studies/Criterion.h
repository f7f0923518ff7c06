// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// When a run of an incremental analysis counts as failed: `criterion` of system/incrementalDynamicsDict.
///
///     criterion { type motion; displacement 1e-6; }
///     criterion { type displacement; block 3; limit 0.05; }
///     criterion { type rotation; limit 0.2; }
///     criterion { type collapse; drop 0.5; }
#pragma once

#include "dictionary/Registry.h"
#include "dynamics/DynamicCase.h"

#include <functional>
#include <string>

namespace drystone
{

/// A quantity of a structure in motion and the limit that it must not exceed. Immutable, so that threads can
/// share it.
struct Criterion
{
    std::string quantity; ///< its name: displacement, rotation, drop
    std::string unit;     ///< its unit
    double limit = 0;     ///< a run meets the criterion as soon as the quantity is above this
    std::string summary;  ///< for the log: `farthest displacement of any corner above 1e-06 m`

    /// The quantity at one instant, never negative. \param start the state in which the run began
    std::function<double(const DynamicState& start, const DynamicState& now)> measure;
};

/// Makes a criterion once the structure is known. \throws FatalIOError for a block that does not exist, or is
/// fixed
using CriterionMaker = std::function<Criterion(const Assembly<2>&)>;

/// All types: motion, displacement, rotation, collapse.
const Registry<CriterionMaker>& criterionTypes();

} // namespace drystone
