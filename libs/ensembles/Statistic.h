// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// What is made of the samples of an ensemble: `statistics` of system/ensembleDict.
///
///     capacity { type distribution; value alpha; fractiles (0.05 0.5 0.95); }
///     collapse { type fragility; intensity ag; exceeded "drift > 0.05"; method multipleStripe; }
///     curves   { type fractiles; intensity ag; response drift; curve record; }
///     shares   { type sensitivity; value alpha; }
#pragma once

#include "dictionary/Registry.h"
#include "io/Plot.h"

#include <functional>
#include <string>
#include <vector>

namespace drystone
{

/// The samples as statistics see them.
struct SampleTable
{
    std::vector<std::string> names;              ///< of the variables, then of the results
    std::size_t variables = 0;                   ///< how many of the names are variables
    std::vector<std::vector<double>> columns;    ///< one a name; nan for words and for what is not known
    std::vector<std::vector<std::string>> texts; ///< one a variable: its values as they were written
    std::vector<char> isFailed;                  ///< one a row
    long requested = 0;       ///< samples of the design; fewer rows: some are still to come
    long sensitivityRuns = 0; ///< runs of each point of the design; 0: without sensitivity
    bool isGrid = false;      ///< of more than one point: chosen values, not samples drawn independently

    std::size_t rows() const { return isFailed.size(); }
};

/// A number with what is known of its accuracy; nan for what is not.
struct StatisticRow
{
    std::string quantity;
    double value = 0;
    double standardError = 0;
    double lower = 0; ///< of the interval of 95%
    double upper = 0;
};

/// A table of its own: a curve, a histogram.
struct StatisticTable
{
    std::vector<std::string> columns;
    std::vector<std::vector<double>> rows;
};

struct StatisticResult
{
    std::vector<StatisticRow> rows;
    std::vector<std::string> remarks; ///< for the log: what was left out, what is not known
    StatisticTable table;
    std::vector<std::pair<std::string, Plot>> pictures; ///< by suffix of the file's name
};

/// What statistics are made of.
struct StatisticSource
{
    const std::vector<std::string>& names; ///< of variables and results
    bool hasSensitivityRuns;               ///< of which Sobol' indices follow
};

/// A statistic that a dictionary requests.
struct Statistic
{
    /// \throws FatalIOError for a name that is not one of the source, and for runs that are needed and
    /// missing
    std::function<void(const StatisticSource&)> check;
    std::function<StatisticResult(const std::string& name, const SampleTable&)> evaluate;
    /// What samples of one curve have in common, where there are curves: the name of a variable, not of a
    /// result.
    std::string curve;
    SourceLocation curveLocation;
};

/// All types: distribution, fragility, fractiles, sensitivity.
const Registry<Statistic>& statisticTypes();

/// Arithmetic of variables and results for each row; nan where a value that it uses is not known.
std::vector<double> valuesOf(const std::string& expression, const SampleTable& table);

/// \throws FatalIOError when it is not arithmetic of these names, or depends on none of them
void requireExpression(const std::string& expression, const std::vector<std::string>& names,
                       const SourceLocation& location);

/// \throws FatalIOError when it is not a condition on these names
void requireCondition(const std::string& expression, const std::vector<std::string>& names,
                      const SourceLocation& location);

/// \throws FatalIOError when it is none of these names, with the nearest of them
void requireVariable(const std::string& name, const std::vector<std::string>& names,
                     const SourceLocation& location);

/// A fractile of sorted values, interpolated between the two nearest. \param part 0 to 1
double fractile(const std::vector<double>& sorted, double part);

} // namespace drystone
