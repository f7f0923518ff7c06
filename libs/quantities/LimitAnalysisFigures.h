// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The figures of a limit analysis, by name: the columns of its table, which searches and ensembles read
/// whether the table is written or not.
#pragma once

#include "statics/LimitAnalysisCase.h"

#include <string>
#include <string_view>
#include <vector>

namespace drystone
{

/// One column of limitAnalysis.dat.
struct TabledFigure
{
    std::string_view heading; ///< `alpha[-]`
    std::string text;         ///< the value as the table has it
};

/// Multiplier, status, sizes, certificate and CPU time of one answer. The multiplier of what is unbounded is
/// `inf` (for a support that moves `-inf`), of what does not stand, did not converge, or has a bound only
/// `nan`.
/// \param cpuTime of the solution [s]
template<int Dim>
std::vector<TabledFigure> limitAnalysisFigures(const LimitAnalysisCase<Dim>& structure,
                                               const LimitAnalysis& result, double cpuTime);

/// The headings of the columns, in their order.
std::vector<std::string_view> limitAnalysisHeadings();

/// The column alpha[-]: a number where there is one. \param alpha counts where the status is optimal
double tabledAlpha(CollapseStatus status, double alpha);
double tabledAlpha(const LimitAnalysis& result);

} // namespace drystone
