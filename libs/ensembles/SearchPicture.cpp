// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Draws a search.
#include "ensembles/SearchPicture.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace drystone
{
namespace
{

/// Where the axis ends on the side away from the best point; nothing: all points are shown.
///
/// Of the points that are better than the worst value, the better three quarters span a range; the axis ends
/// 1.3 times as far from the best value, unless what is beyond is not even four times as far.
std::optional<double> endOfAxis(const std::vector<Evaluation>& points, double best, double sign)
{
    std::vector<double> behind; // how far from the best
    for (const Evaluation& point : points)
    {
        behind.push_back(std::max(0.0, sign * (point.objective - best)));
    }
    std::sort(behind.begin(), behind.end());
    const double farthest = behind.back();
    const auto near = std::lower_bound(behind.begin(), behind.end(), farthest) - behind.begin();
    if (near < 2)
    {
        return std::nullopt;
    }
    const double usual = behind[static_cast<std::size_t>(3 * (near - 1) / 4)];
    if (!(usual > 0) || farthest <= 4 * usual)
    {
        return std::nullopt;
    }
    return best + sign * 1.3 * usual;
}

} // namespace

Plot searchPicture(const ParameterSearchSettings& settings, const std::vector<Evaluation>& points,
                   const Evaluation& best)
{
    const double sign = settings.objective.sign();
    std::string place;
    for (std::size_t i = 0; i < best.variables.size(); ++i)
    {
        place +=
            fmt::format("{}{} = {:.9g}", i > 0 ? "  " : "", settings.variables[i].first, best.variables[i]);
    }
    Plot plot;
    plot.title = fmt::format("{} {}", settings.objective.goal == SearchGoal::minimise ? "Least" : "Largest",
                             settings.objective.value);
    plot.subtitle = fmt::format("{:.9g} at {}", best.objective, place);
    constexpr std::size_t mostLetters = 40; // along the axis; the title has all of it
    plot.y.label = settings.objective.value.size() <= mostLetters ? settings.objective.value : "objective";
    const bool overVariable = settings.variables.size() == 1;
    plot.x.label = overVariable ? settings.variables.front().first : "evaluation";

    const std::optional<double> end = endOfAxis(points, best.objective, sign);
    if (end)
    {
        (sign > 0 ? plot.y.upper : plot.y.lower) = *end;
    }
    PlotCurve met{"evaluations", {}, {}, CurveLine::none, CurveMarker::circle, curveColour(0)};
    PlotCurve missed{"violate a constraint", {}, {}, CurveLine::none, CurveMarker::diamond, curveColour(5)};
    PlotCurve beyond{"beyond the axis", {}, {}, CurveLine::none, CurveMarker::triangle, curveColour(6)};
    PlotCurve marked{"best", {}, {}, CurveLine::none, CurveMarker::square, curveColour(1)};
    for (std::size_t i = 0; i < points.size(); ++i)
    {
        const Evaluation& point = points[i];
        const bool isBeyond = end && sign * (point.objective - *end) > 0;
        PlotCurve& curve = isBeyond                            ? beyond
                           : point.variables == best.variables ? marked
                           : point.violation > 0               ? missed
                                                               : met;
        curve.x.push_back(overVariable ? point.variables.front() : static_cast<double>(i + 1));
        curve.y.push_back(isBeyond ? *end : point.objective);
    }
    for (PlotCurve* curve : {&met, &missed, &beyond, &marked})
    {
        if (!curve->x.empty())
        {
            plot.curves.push_back(std::move(*curve));
        }
    }
    return plot;
}

} // namespace drystone
