// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Figures of a case whose errors accuracyCost measures, and their references.
///
/// Periods, distances, energies, thresholds and multipliers, which the equations determine. The path of a
/// structure that rocks for a long time is not among them, because it depends on rounding.
#pragma once

#include "dictionary/Registry.h"
#include "ensembles/AccuracyReference.h"
#include "ensembles/AccuracyRun.h"

#include <functional>
#include <memory>
#include <string>

namespace drystone
{

/// A figure of a case, ready to be measured: it holds the case, of the plane or of space.
struct Quantity
{
    std::string summary; ///< `time at which block 1 is upright again for the 3rd time`
    std::string unit;
    /// One run. Depends only on its arguments, except for `cpuTime` and signals.
    std::function<Measurement(const RunSetting&, const StepPhase&)> measure;
    /// The figure from Housner's equation; empty where that does not give it.
    std::function<double()> housner = {};
    double resolution = 0; ///< what the figure of a run is off by at most, whatever its setting
};

/// Makes a quantity of a case. \throws FatalIOError for a block that does not exist, or is fixed, and for
/// what there is in the plane only
struct QuantityMaker
{
    template<int Dim>
    using Make = std::function<Quantity(const std::shared_ptr<const AccuracyCase<Dim>>&)>;

    Make<2> inPlane;
    Make<3> inSpace;

    Quantity operator()(const std::shared_ptr<const AccuracyCase<2>>& study) const { return inPlane(study); }
    Quantity operator()(const std::shared_ptr<const AccuracyCase<3>>& study) const { return inSpace(study); }
};

/// A quantity of the dictionary.
struct QuantityPlan
{
    QuantityKind kind = QuantityKind::motion;
    ReferencePlan reference;
    QuantityMaker make;
};

/// All types: returnTime, displacement, energy, threshold, multiplier.
const Registry<QuantityPlan>& quantityTypes();

} // namespace drystone
