// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The samples of an ensemble as a fragility sees them: in stripes, or as curves that fail at an intensity.
/// Internal to the statistic `fragility`.
#pragma once

#include "ensembles/Fragility.h"
#include "ensembles/Statistic.h"

#include <optional>
#include <string>
#include <vector>

namespace drystone
{

/// What of the samples a fragility is about: names of variables and results, and expressions of them.
struct FragilityNames
{
    std::string intensity; ///< measures the ground motion
    std::string exceeded;  ///< 1 where a sample has failed, 0 where it stands
    std::optional<std::string>
        curve; ///< variable that samples of one curve have in common; absent: no curves
};

/// Whether failed samples, whose result is not known, count as exceeded.
enum class FailedAs
{
    standing,
    fallen
};

/// The samples of a fragility that have an intensity, an entry of each list for one.
struct Observations
{
    std::vector<double> intensity;
    std::vector<char> exceeded;
    std::vector<std::string> curve; ///< empty without curves
    std::size_t failures = 0;
    std::size_t undefined = 0; ///< of these: samples that were run, with no value of `exceeded`
    std::size_t unplaced = 0;  ///< samples without an intensity, where it is a result; in no other list
    std::size_t numbers = 0;   ///< samples with a value of `exceeded` that is neither 0 nor 1
};

/// \param failedAs what samples that failed, and those with no value of `exceeded`, count as
Observations observationsOf(const FragilityNames& names, const SampleTable& table, FailedAs failedAs);

/// Ascending, one for each intensity.
std::vector<Stripe> stripesOf(const Observations& observations);

/// The curves that samples are points of.
struct CurvesOfSamples : TruncatedCurves
{
    std::size_t repeated = 0; ///< samples at an intensity at which their curve has another one
};

/// \param observations with curves
CurvesOfSamples curvesOf(const Observations& observations);

} // namespace drystone
