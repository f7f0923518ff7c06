// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The study of a case directory, read and checked: its quantities, references and sweeps.
#pragma once

#include "ensembles/AccuracyCost.h"

#include <filesystem>
#include <functional>

namespace drystone
{

/// Of the application and of its folder in postProcessing.
inline constexpr const char* accuracyCostName = "accuracyCost";

/// A quantity with its reference and units.
struct StudyQuantity
{
    std::string name;
    QuantityKind kind = QuantityKind::motion;
    Quantity quantity;
    ReferencePlan reference;
    RunSetting ofCase;                  ///< how the case itself is computed
    std::function<double()> unitOfWork; ///< measures F, of the setting of the case [s]
    double housner = 0;                 ///< the value of that reference, where it is used
};

/// A study that has been read and checked; its quantities hold the case, of the plane or of space.
struct AccuracyStudy
{
    std::filesystem::path caseDirectory;
    double duration = 0; ///< of a motion [s]
    std::vector<StudyQuantity> quantities;
    std::vector<Named<Sweep>> sweeps;
    std::vector<std::size_t> quantityOfSweep;
    std::string heading; ///< of the history: everything that its rows depend on
};

/// The setting that a reference run is made with, its step and tolerance the finest.
RunSetting finestSetting(const ReferencePlan& plan, RunSetting setting);

/// Reads system/accuracyCostDict and, as far as its quantities need them, the input of contactDynamics and
/// limitAnalysis. \throws FatalIOError or FatalError for the first fault found
template<int Dim>
AccuracyStudy readAccuracyStudy(const std::filesystem::path& caseDirectory);

/// postProcessing/accuracyCost/0/ of a case.
std::filesystem::path accuracyFolder(const std::filesystem::path& caseDirectory);

/// `Intel(R) Xeon(R) ... 2.10GHz`, or `an unknown processor`.
std::string processorName();

} // namespace drystone
