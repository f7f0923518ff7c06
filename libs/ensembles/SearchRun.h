// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// A search while it runs: the evaluations that its algorithms request, a point at a time.
#pragma once

#include "ensembles/SearchHistory.h"

namespace drystone
{

/// Runs the search, prints a line for each evaluation and writes the history.
/// \throws FatalError or FatalIOError when a point cannot be evaluated
SearchOutcome carryOut(const ParameterSearch& search, SearchHistory& history);

} // namespace drystone
