// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// How an uncertain entry of a case is distributed: `distribution` of system/ensembleDict.
///
///     distribution { type lognormal; median 0.65; beta 0.15; minimum 0.2; maximum 1.2; }
///     distribution { type list; values ("a.AT2" "b.AT2"); }
#pragma once

#include "dictionary/Registry.h"

#include <functional>
#include <string>
#include <vector>

namespace drystone
{

/// A value of a variable.
struct SampleValue
{
    std::string text;  ///< as a dictionary has it: the fewest digits that read back as the same number
    double number = 0; ///< nan for what is no number
};

/// Immutable. One of the three is there.
struct Distribution
{
    std::string summary;                   ///< `lognormal, median 0.65, beta 0.15`
    std::function<double(double)> inverse; ///< value of a probability in (0, 1): a number
    std::vector<SampleValue> choices;      ///< some values
    std::vector<double> cumulative;        ///< of the choices: the last is 1
    bool isSeed = false;                   ///< an integer from 1 to 2147483647, of the sample's own
};

/// All types: normal, lognormal, uniform, truncated, beta, discrete, list, seed, table.
/// The file of `table` is read when the dictionary is, relative to where the application runs the case.
const Registry<Distribution>& distributionTypes();

/// The value at a probability. \param probability in (0, 1)
SampleValue valueAt(const Distribution& distribution, double probability);
SampleValue valueOf(double number);
SampleValue valueOf(const std::string& word);

/// Inverse and direct distribution function of the standard normal distribution (GSL).
double normalQuantile(double probability);
double normalProbability(double value);

} // namespace drystone
