// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// When a run counts as failed: a figure of its motion and the limit that it must not exceed, as in
/// `criterion` of system/incrementalDynamicsDict.
///
///     criterion { type motion; displacement 1e-6; }
///     criterion { type displacement; block 3; limit 0.05; }
///     criterion { type rotation; limit 0.2; }
///     criterion { type collapse; drop 0.5; }
#pragma once

#include "dictionary/Registry.h"
#include "quantities/MotionFigures.h"

#include <functional>
#include <string>

namespace drystone
{

/// A figure and its limit. Immutable, so that threads can share it.
template<int Dim>
struct Criterion
{
    InstantFigure<Dim> figure; ///< displacement, rotation or drop, never negative
    double limit = 0;          ///< a run meets the criterion as soon as the figure is above this
    std::string summary;       ///< for the log: `displacement of any corner above 1e-06 m`
};

/// Makes a criterion once the structure is known. \throws FatalIOError for a block that does not exist, or is
/// fixed
struct CriterionMaker
{
    std::function<Criterion<2>(const Assembly<2>&)> inPlane;
    std::function<Criterion<3>(const Assembly<3>&)> inSpace;

    Criterion<2> operator()(const Assembly<2>& assembly) const { return inPlane(assembly); }
    Criterion<3> operator()(const Assembly<3>& assembly) const { return inSpace(assembly); }
};

/// All types: motion, displacement, rotation, collapse.
const Registry<CriterionMaker>& criterionTypes();

} // namespace drystone
