// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The list of the columns of limitAnalysis.dat.
#include "quantities/LimitAnalysisFigures.h"

#include <fmt/format.h>

#include <limits>

namespace drystone
{

double tabledAlpha(CollapseStatus status, double alpha)
{
    switch (status)
    {
    case CollapseStatus::unbounded:
        return std::numeric_limits<double>::infinity();
    case CollapseStatus::unstable:
    case CollapseStatus::notConverged:
    case CollapseStatus::upperBound:
        return std::numeric_limits<double>::quiet_NaN();
    case CollapseStatus::optimal:
        break;
    }
    return alpha + 0.0; // a table has no -0
}

double tabledAlpha(const LimitAnalysis& result)
{
    return tabledAlpha(result.status, result.alpha);
}

template<int Dim>
std::vector<TabledFigure> limitAnalysisFigures(const LimitAnalysisCase<Dim>& structure,
                                               const LimitAnalysis& result, double cpuTime)
{
    // The least reaction of a support has no lower bound.
    const bool isNegative = structure.movement && result.status == CollapseStatus::unbounded;
    const auto residual = [](double value) { return fmt::format("{:.3e}", value); };
    return {{"alpha[-]", fmt::format("{:.12g}", isNegative ? -tabledAlpha(result) : tabledAlpha(result))},
            {"status[-]", fmt::format("{}", static_cast<int>(result.status))},
            {"blocks[-]", fmt::format("{}", structure.freeBlocks)},
            {"contactPoints[-]", fmt::format("{}", structure.points.size())},
            {"variables[-]", fmt::format("{}", result.variables)},
            {"iterations[-]", fmt::format("{}", result.iterations)},
            {"primalResidual[-]", residual(result.certificate.primalResidual)},
            {"dualResidual[-]", residual(result.certificate.dualResidual)},
            {"gap[-]", residual(result.certificate.dualityGap)},
            {"cpuTime[s]", fmt::format("{:.6g}", cpuTime)}};
}

std::vector<std::string_view> limitAnalysisHeadings()
{
    std::vector<std::string_view> headings;
    for (const TabledFigure& figure : limitAnalysisFigures(LimitAnalysisCase<2>(), LimitAnalysis(), 0))
    {
        headings.push_back(figure.heading);
    }
    return headings;
}

template std::vector<TabledFigure> limitAnalysisFigures(const LimitAnalysisCase<2>& structure,
                                                        const LimitAnalysis& result, double cpuTime);
template std::vector<TabledFigure> limitAnalysisFigures(const LimitAnalysisCase<3>& structure,
                                                        const LimitAnalysis& result, double cpuTime);

} // namespace drystone
