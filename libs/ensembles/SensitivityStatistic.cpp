// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The statistic `sensitivity`: Sobol' indices of a value from pairs of points (Saltelli et al. 2010,
/// Variance based sensitivity analysis of model output: estimators (b) and (f) of table 2).
#include "ensembles/Philox.h"
#include "ensembles/StatisticTypes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace drystone
{
namespace
{

struct SensitivitySettings
{
    std::string value;
    int bootstrap = 200;
    int seed = 1;
};
void declare(Options& options, SensitivitySettings& settings)
{
    options.required("value", settings.value, "arithmetic of variables and results").example("alpha");
    options.optional("bootstrap", settings.bootstrap, "points drawn again for the intervals")
        .atLeast(0)
        .atMost(100000);
    options.optional("seed", settings.seed, "of the drawing").atLeast(0);
}

/// First-order and total index of one variable.
struct Indices
{
    double first = 0;
    double total = 0;
};

/// \param points each with the values at A, at B, and at A with one variable after the other from B
/// \param chosen which of the points, possibly several times
std::vector<Indices> indicesOf(const std::vector<std::vector<double>>& points,
                               const std::vector<std::size_t>& chosen)
{
    const double count = static_cast<double>(chosen.size());
    double mean = 0;
    for (const std::size_t point : chosen)
    {
        mean += (points[point][0] + points[point][1]) / (2 * count);
    }
    double variance = 0;
    for (const std::size_t point : chosen)
    {
        variance +=
            (std::pow(points[point][0] - mean, 2) + std::pow(points[point][1] - mean, 2)) / (2 * count);
    }
    std::vector<Indices> indices(points.front().size() - 2);
    for (std::size_t k = 0; k < indices.size(); ++k)
    {
        for (const std::size_t point : chosen)
        {
            const double a = points[point][0];
            const double b = points[point][1];
            const double mixed = points[point][k + 2];
            indices[k].first += (b - mean) * (mixed - a) / (count * variance);
            indices[k].total += std::pow(a - mixed, 2) / (2 * count * variance);
        }
    }
    return indices;
}

StatisticResult evaluateSensitivity(const SensitivitySettings& settings, const std::string& name,
                                    const SampleTable& table)
{
    StatisticResult result;
    const auto runs = static_cast<std::size_t>(table.sensitivityRuns);
    const std::vector<double> values = valuesOf(settings.value, table);
    std::vector<std::vector<double>> points;
    std::size_t left = 0;
    // Rows are complete points as long as none is missing, which is so when all samples are there.
    for (std::size_t begin = 0; begin + runs <= values.size(); begin += runs)
    {
        const std::vector<double> point(values.begin() + static_cast<std::ptrdiff_t>(begin),
                                        values.begin() + static_cast<std::ptrdiff_t>(begin + runs));
        const bool isKnown =
            std::all_of(point.begin(), point.end(), [](double value) { return std::isfinite(value); })
            && std::none_of(table.isFailed.begin() + static_cast<std::ptrdiff_t>(begin),
                            table.isFailed.begin() + static_cast<std::ptrdiff_t>(begin + runs),
                            [](char failed) { return failed != 0; });
        if (isKnown)
        {
            points.push_back(point);
        }
        left += !isKnown;
    }
    const double none = std::nan("");
    result.rows.push_back({"points", static_cast<double>(points.size()), none, none, none});
    result.rows.push_back({"pointsLeftOut", static_cast<double>(left), none, none, none});
    if (left > 0)
    {
        result.remarks.push_back(
            fmt::format("{} points with a sample that failed or is not finite are left out", left));
    }
    if (static_cast<long>(table.rows()) < table.asked)
    {
        result.remarks.emplace_back("Not all samples are there: the indices follow when they are");
        return result;
    }
    if (points.size() < 2)
    {
        result.remarks.emplace_back("There are not enough points for indices");
        return result;
    }
    std::vector<std::size_t> all(points.size());
    for (std::size_t i = 0; i < all.size(); ++i)
    {
        all[i] = i;
    }
    const std::vector<Indices> indices = indicesOf(points, all);
    std::vector<std::vector<double>> firsts(indices.size());
    std::vector<std::vector<double>> totals(indices.size());
    for (int replicate = 0; replicate < settings.bootstrap; ++replicate)
    {
        std::vector<std::size_t> drawn(points.size());
        for (std::size_t i = 0; i < drawn.size(); ++i)
        {
            drawn[i] =
                static_cast<std::size_t>(uniform(static_cast<std::uint64_t>(settings.seed), Stream::bootstrap,
                                                 static_cast<std::uint32_t>(replicate), i)
                                         * static_cast<double>(points.size()));
        }
        const std::vector<Indices> again = indicesOf(points, drawn);
        for (std::size_t k = 0; k < again.size(); ++k)
        {
            firsts[k].push_back(again[k].first);
            totals[k].push_back(again[k].total);
        }
    }
    const auto row = [&](const std::string& quantity, double value, std::vector<double>& again)
    {
        double mean = 0;
        double squares = 0;
        for (const double drawn : again)
        {
            mean += drawn / static_cast<double>(again.size());
        }
        for (const double drawn : again)
        {
            squares += std::pow(drawn - mean, 2);
        }
        std::sort(again.begin(), again.end());
        const bool isDrawn = again.size() >= 20;
        result.rows.push_back(
            {quantity, value, isDrawn ? std::sqrt(squares / static_cast<double>(again.size() - 1)) : none,
             isDrawn ? fractile(again, 0.025) : none, isDrawn ? fractile(again, 0.975) : none});
    };
    Plot plot;
    plot.title = fmt::format("{}: Sobol' indices of {}", name, settings.value);
    plot.subtitle = "bar: total index; filled part to its mark: first order";
    plot.x.label = "part of the variance";
    plot.y.label = "variable";
    plot.x.lower = 0;
    std::vector<std::size_t> order(indices.size());
    for (std::size_t k = 0; k < order.size(); ++k)
    {
        row("first_" + table.names[k], indices[k].first, firsts[k]);
        row("total_" + table.names[k], indices[k].total, totals[k]);
        order[k] = k;
    }
    std::sort(order.begin(), order.end(),
              [&](std::size_t a, std::size_t b) { return indices[a].total < indices[b].total; });
    for (std::size_t place = 0; place < order.size(); ++place)
    {
        const std::size_t k = order[place];
        const auto y = static_cast<double>(place + 1);
        const double first = std::max(indices[k].first, 0.0);
        plot.curves.push_back({table.names[k],
                               {0, indices[k].total, indices[k].total, 0, 0, first, first},
                               {y - 0.3, y - 0.3, y + 0.3, y + 0.3, y - 0.3, y - 0.3, y + 0.3},
                               CurveLine::solid,
                               CurveMarker::none,
                               {}});
    }
    result.pictures.emplace_back("", std::move(plot));
    return result;
}

} // namespace

Model<Statistic> sensitivityStatistic()
{
    return model<Statistic, SensitivitySettings>(
        "sensitivity", "Sobol' indices: which variables the scatter of a value is due to",
        [](const SensitivitySettings& settings, const Dictionary& dictionary)
        {
            Statistic statistic;
            statistic.check = [settings, place = dictionary.location(),
                               value = dictionary.locationOf("value")](const std::vector<std::string>& names,
                                                                       bool hasSensitivity)
            {
                requireExpression(settings.value, names, value);
                if (!hasSensitivity)
                {
                    throw FatalIOError(
                        "The statistic sensitivity needs samples of its own: write `sensitivity yes;` "
                        "in design, of type random, latinHypercube or sobol.",
                        place);
                }
            };
            statistic.evaluate = [settings](const std::string& name, const SampleTable& table)
            { return evaluateSensitivity(settings, name, table); };
            return statistic;
        });
}

} // namespace drystone
