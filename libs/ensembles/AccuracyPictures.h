// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The pictures of accuracyCost: errors over cost, and profiles of solvers.
#pragma once

#include "ensembles/AccuracyStudyRun.h"

#include <filesystem>
#include <string>
#include <vector>

namespace drystone
{

/// The tolerances with more than one solver and enough settings to compare them.
std::vector<double> profileTolerances(const SweepResult& sweep);

/// Ending of the pictures that the page shows: the first format that the case requests.
std::string_view pictureEnding(const AccuracyStudy& study);

/// The file of a profile.
std::string profileName(const SweepResult& sweep, double tolerance);

/// The pictures that the page refers to. \throws FatalError naming what cannot be written
void writePictures(const std::filesystem::path& folder, const AccuracyStudy& study,
                   const AccuracyResults& results);

} // namespace drystone
