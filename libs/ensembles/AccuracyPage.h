// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The page and table of accuracyCost: presentation, separate from measurement and evaluation.
#pragma once

#include "ensembles/AccuracyStudyRun.h"

#include <filesystem>
#include <string>
#include <vector>

namespace drystone
{

/// The cheapest setting that reaches a level of error.
struct CheapestRow
{
    std::size_t quantity = 0;
    double level = 0;
    ErrorMeasure measure = ErrorMeasure::worst;
    std::optional<AccuracyPoint> point; ///< nothing when none of the settings does
};

/// For each quantity 5%, 1% and 0.1%, over all its sweeps; for motions by the median and by the worst phase,
/// of the settings with the largest number of phases.
std::vector<CheapestRow> cheapestRows(const AccuracyStudy& study, const AccuracyResults& results);

/// Where the setting of a row has an error that is below what the reference itself is known to, that; else
/// empty.
std::string doubtAbout(const CheapestRow& row, const AccuracyResults& results);

/// accuracyCost.csv: a row for each setting of each sweep.
std::string accuracyTable(const AccuracyStudy& study, const AccuracyResults& results);

/// accuracyCost.md.
std::string accuracyPage(const AccuracyStudy& study, const AccuracyResults& results);

} // namespace drystone
