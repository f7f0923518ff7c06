// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// One point of a search: the applications in a copy of the case, and what their tables hold.
#pragma once

#include "ensembles/ParameterSearch.h"
#include "ensembles/StudyInput.h"
#include "runControl/PictureFormats.h"

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace drystone
{

/// Of the application and of its folder in postProcessing.
inline constexpr const char* parameterSearchName = "parameterSearch";

/// A search that has been read and checked.
struct ParameterSearch
{
    std::filesystem::path caseDirectory;
    ParameterSearchSettings settings;
    Dictionary dictionary;            ///< system/parameterSearchDict, for the location in messages
    std::vector<double> start;        ///< of the variables
    std::string caseInput;            ///< lines at the top of its history
    std::vector<std::string> options; ///< for the applications
    PictureFormats pictureFormats{PictureFormat::svg};
};

/// What its points follow from.
StudyRuns runsOf(const ParameterSearch& search);

/// `thickness = 0.1067  mu = 0.4`
std::string pointText(const ParameterSearchSettings& settings, const std::vector<double>& variables);

/// Results with `otherwise` in place of what is missing. \param reason why something may be
/// \throws FatalIOError where a result is missing that has none
std::vector<double> completed(const ParameterSearch& search, const std::vector<double>& variables,
                              std::vector<double> results, const std::string& reason);

/// Checks whether the applications can read the case, with the values at the start of the search or in the
/// middle of the bounds. \throws FatalError with the message of the application
void requireReadableCase(const ParameterSearch& search);

/// The outcome of the applications at a point.
struct PointRun
{
    std::vector<double> results;       ///< nan where there is none
    std::string failure;               ///< which application failed; empty when none did
    std::string errorOutput;           ///< of that application, about the case in place of its copy
    std::vector<std::string> warnings; ///< of all applications, likewise
    int failureStatus = 0;
    bool isInterrupted = false;
    std::string cutShortIn; ///< of the cases, the one where maximumTime has ended a search; empty: in none
    double cpuTime = 0;     ///< of the applications [s]
};

/// Runs the applications with these values, in parameterSearch/evaluation.
/// \throws FatalIOError when they do not write what the results are read from; as runCopy
PointRun runPoint(const ParameterSearch& search, const std::vector<double>& variables);

} // namespace drystone
