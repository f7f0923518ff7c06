// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The search for the smallest or largest value of a result of a case over some of its entries.
#pragma once

#include "ensembles/SearchSettings.h"

#include <functional>
#include <optional>
#include <utility>
#include <vector>

namespace drystone
{

/// A point of the search and its results.
struct Evaluation
{
    std::vector<double> variables;
    std::vector<double> results;
    double objective = 0;            ///< as specified, without change of sign
    std::vector<double> constraints; ///< values
    double violation = 0;            ///< largest violation of a limit beyond its tolerance; 0: all hold
};

/// Objective and constraints at a point whose results are known. \throws FatalIOError when an expression has
/// no finite value there
Evaluation evaluate(const ParameterSearchSettings& settings, std::vector<double> variables,
                    std::vector<double> results);

/// How a search ended.
enum class SearchEnd
{
    converged,   ///< the last algorithm met its tolerance, or the value to stop at
    astray,      ///< it met it at an infeasible point, although a feasible one is known
    evaluations, ///< the last algorithm used all its evaluations
    failed,      ///< NLopt failed
    interrupted, ///< by a signal
    notMonotone  ///< of a bisection: the objective does not grow or fall all the way between the bounds
};

/// The result of a search.
struct SearchOutcome
{
    SearchEnd end = SearchEnd::failed;
    std::optional<Evaluation> best; ///< of the feasible ones, or else the one with the smallest violation
    std::vector<std::pair<SearchAlgorithm, int>> stages; ///< and how many evaluations each took
    int beyondBounds = 0;   ///< evaluations of the last algorithm that it spent on points outside the bounds
    std::size_t points = 0; ///< different ones that were evaluated, computed or known
    std::size_t failedPoints = 0; ///< of these, where an application failed
};

/// Returns the evaluation at a point, computed or known; empty when the search is to stop.
using Evaluator = std::function<std::optional<Evaluation>(const std::vector<double>& variables)>;

/// Runs the algorithms one after the other. The points they request depend only on the settings and the
/// values at earlier points: a search that is repeated requests the same points.
/// \throws whatever `evaluator` throws
SearchOutcome searchBest(const ParameterSearchSettings& settings, const std::vector<double>& start,
                         const Evaluator& evaluator);

} // namespace drystone
