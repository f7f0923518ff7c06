// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The picture of a search: its points, with the best of them marked.
#pragma once

#include "ensembles/ParameterSearch.h"
#include "io/Plot.h"

#include <string>
#include <vector>

namespace drystone
{

/// A plot of the objective over the evaluations, or over the variable when there is one. What lies far beyond
/// the other points, as the value that a result without a number is given (`otherwise`), is drawn at the
/// edge, so that it does not flatten the rest. \param points in the order of their evaluation \param best of
/// them
Plot searchPicture(const ParameterSearchSettings& settings, const std::vector<Evaluation>& points,
                   const Evaluation& best);

} // namespace drystone
