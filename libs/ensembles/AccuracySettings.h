// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The settings of accuracyCost: quantities and sweeps of system/accuracyCostDict.
///
///     quantities
///     {
///         return { type returnTime; block 1; count 3; reference { type Housner; } }
///     }
///     sweeps
///     {
///         schemes { quantity return; deltaT (0.02 0.01 0.005); theta (0.5 1); }
///     }
#pragma once

#include "ensembles/AccuracyQuantity.h"

#include <optional>
#include <string>
#include <vector>

namespace drystone
{

/// The setting that varies along one curve.
enum class SweepAxis
{
    deltaT,
    tolerance,
    pointsPerJoint,
    pointsPerSide,
    contactOverlap
};
inline std::array<std::pair<std::string_view, SweepAxis>, 5> namesOf(SweepAxis)
{
    return {{{"deltaT", SweepAxis::deltaT},
             {"tolerance", SweepAxis::tolerance},
             {"pointsPerJoint", SweepAxis::pointsPerJoint},
             {"pointsPerSide", SweepAxis::pointsPerSide},
             {"contactOverlap", SweepAxis::contactOverlap}}};
}

/// All combinations of some settings. An empty list stands for the value of the case.
struct Sweep : RunSettingsOf<ListOf>
{
    std::string quantity;
    std::optional<SweepAxis> along; ///< absent: the first of these that has several values
    int phases = 20;
    int repeats = 5;
};
void declare(Options& options, Sweep& sweep);

/// The contents of the dictionary.
struct AccuracySettings
{
    std::vector<Named<QuantityPlan>> quantities;
    std::vector<Named<Sweep>> sweeps;
};
void declare(Options& options, AccuracySettings& settings);

/// A setting as it is computed: with everything on displacements are large and sliding follows Coulomb's law.
RunSetting asComputed(RunSetting setting);

/// All settings of a sweep, each once, as they are computed. \param ofCase the setting of the case, for empty
/// lists
std::vector<RunSetting> settingsOf(const Sweep& sweep, const RunSetting& ofCase);

/// What the points of a curve of this sweep differ by.
SweepAxis axisOf(const Sweep& sweep, QuantityKind kind);

/// What the points of one curve have in common: the setting with 0 along the axis.
RunSetting curveOf(RunSetting setting, SweepAxis axis);

/// The value of a setting along an axis.
double alongAxis(const RunSetting& setting, SweepAxis axis);

} // namespace drystone
