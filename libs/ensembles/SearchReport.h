// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// What a search reports of itself: its log, its files and its exit status.
///
/// parameterSearch/evaluation   the copy of the case in which the applications run
/// parameterSearch/best         that of the best point so far, with its results
/// postProcessing/parameterSearch/0/
///     history.dat              a row for each point; a search that is restarted repeats none of them
///     best.dat                 the row of the best one, and the number of points
///     input                    what the search was for: the fingerprint of its dictionary
///     parameterSearch.svg      the objective over the evaluations, or over the variable when there is one
#pragma once

#include "ensembles/SearchHistory.h"

namespace drystone
{

/// Before the first evaluation: variables, results, objective, constraints, algorithms.
void printSearch(const ParameterSearch& search, const SearchHistory& history);

/// The best point, and how reliable it is.
void printOutcome(const ParameterSearch& search, const SearchHistory& history, const SearchOutcome& outcome);

/// best.dat and parameterSearch.svg.
void writeOutcome(const ParameterSearch& search, const SearchHistory& history, const SearchOutcome& outcome);

/// 0; 2 when the last local algorithm did not reach its tolerance, or no point meets the constraints; 128 +
/// signal (130 for Ctrl-C) when interrupted.
int exitStatus(const SearchOutcome& outcome);

} // namespace drystone
