// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Settings of accuracyCost in words, for its log, its page and its pictures.
#pragma once

#include "ensembles/AccuracySettings.h"

#include <fmt/format.h>

#include <optional>
#include <string>
#include <vector>

namespace drystone
{

/// The word that a dictionary has for a value.
template<class Enumeration>
std::string wordOf(Enumeration value)
{
    for (const auto& [name, named] : namesOf(value))
    {
        if (named == value)
        {
            return std::string(name);
        }
    }
    return {};
}

/// The keys of a setting that are shown. The others are the same for all points, or have no meaning.
using ShownKeys = RunSettingsOf<FlagOf>;

/// Those with a meaning for a kind of quantity.
ShownKeys keysOf(const RunSetting& setting, QuantityKind kind);

/// What varies along a curve is not shown.
ShownKeys withoutAxis(ShownKeys shown, std::optional<SweepAxis> axis);

/// Those that differ between some settings, without the axis. \param settings at least one
ShownKeys differingKeys(const std::vector<RunSetting>& settings, std::optional<SweepAxis> axis);

/// The words of a setting, one for each key that is shown; and as one text.
std::vector<std::string> wordsOf(const RunSetting& setting, const ShownKeys& shown);
std::string textOf(const RunSetting& setting, const ShownKeys& shown);

/// `deltaT 0.01, theta 1, nonAssociative, automatic, tolerance 1e-09, large`.
std::string settingText(const RunSetting& setting, QuantityKind kind);

/// The same with only the keys that differ between some settings; `all` where nothing does.
std::string settingText(const RunSetting& setting, const std::vector<RunSetting>& among);

/// `points a joint`, `deltaT [s]`
std::string axisName(SweepAxis axis);

/// `0.1%`
std::string percentText(double level);

} // namespace drystone
