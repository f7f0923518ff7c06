// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The statistic `sensitivity`: Sobol' indices of a value from pairs of points (Saltelli et al. 2010,
/// Variance based sensitivity analysis of model output: estimators (b) and (f) of table 2).
#include "ensembles/Philox.h"
#include "ensembles/StatisticTypes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

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

/// Whether there is a variance, which indices are parts of: without rounding, that has one of its own.
bool hasScatter(const std::vector<std::vector<double>>& points, const std::vector<std::size_t>& chosen)
{
    const double one = points[chosen.front()][0];
    return std::any_of(chosen.begin(), chosen.end(),
                       [&](std::size_t point) { return points[point][0] != one || points[point][1] != one; });
}

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

/// The values of a sample at each of its points.
struct Points
{
    std::vector<std::vector<double>> complete; ///< as indicesOf takes them
    std::size_t leftOut = 0;                   ///< with a sample that failed or is not finite
};

/// Rows are complete points as long as none is missing, which is so when all samples are there.
Points pointsOf(const std::vector<double>& values, const SampleTable& table)
{
    const auto runs = static_cast<std::ptrdiff_t>(table.sensitivityRuns);
    Points points;
    for (std::ptrdiff_t begin = 0; begin + runs <= static_cast<std::ptrdiff_t>(values.size()); begin += runs)
    {
        const std::vector<double> point(values.begin() + begin, values.begin() + begin + runs);
        const bool isKnown =
            std::all_of(point.begin(), point.end(), [](double value) { return std::isfinite(value); })
            && std::none_of(table.isFailed.begin() + begin, table.isFailed.begin() + begin + runs,
                            [](char failed) { return failed != 0; });
        if (isKnown)
        {
            points.complete.push_back(point);
        }
        points.leftOut += !isKnown;
    }
    return points;
}

/// The indices of points drawn again and again from those that there are: first and total, of each variable.
/// Those drawn without scatter have none.
struct Replicates
{
    std::vector<std::vector<double>> first;
    std::vector<std::vector<double>> total;
};

Replicates drawnAgain(const std::vector<std::vector<double>>& points, const SensitivitySettings& settings)
{
    const std::size_t variables = points.front().size() - 2;
    Replicates replicates{std::vector<std::vector<double>>(variables),
                          std::vector<std::vector<double>>(variables)};
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
        if (!hasScatter(points, drawn))
        {
            continue;
        }
        const std::vector<Indices> indices = indicesOf(points, drawn);
        for (std::size_t k = 0; k < variables; ++k)
        {
            replicates.first[k].push_back(indices[k].first);
            replicates.total[k].push_back(indices[k].total);
        }
    }
    return replicates;
}

/// A row of the table, with what the replicates say of its scatter where they are many enough.
StatisticRow rowOf(const std::string& quantity, double value, std::vector<double> replicates)
{
    constexpr std::size_t leastReplicates = 20;
    if (replicates.size() < leastReplicates)
    {
        return {quantity, value, std::nan(""), std::nan(""), std::nan("")};
    }
    const auto count = static_cast<double>(replicates.size());
    double mean = 0;
    double squares = 0;
    for (const double drawn : replicates)
    {
        mean += drawn / count;
    }
    for (const double drawn : replicates)
    {
        squares += std::pow(drawn - mean, 2);
    }
    std::sort(replicates.begin(), replicates.end());
    return {quantity, value, std::sqrt(squares / (count - 1)), fractile(replicates, 0.025),
            fractile(replicates, 0.975)};
}

/// A bar for each variable, the largest on top.
Plot barsOf(const std::vector<Indices>& indices, const std::vector<std::string>& names)
{
    constexpr double half = 0.3; // of a bar's width, where the distance of bars is 1
    Plot plot;
    plot.subtitle = "bar: total index; filled part to its mark: first order";
    plot.x.label = "part of the variance";
    plot.y.label = "variable";
    plot.x.lower = 0;
    std::vector<std::size_t> order(indices.size());
    std::iota(order.begin(), order.end(), 0);
    std::sort(order.begin(), order.end(),
              [&](std::size_t a, std::size_t b) { return indices[a].total < indices[b].total; });
    for (std::size_t place = 0; place < order.size(); ++place)
    {
        const std::size_t k = order[place];
        const auto y = static_cast<double>(place + 1);
        const double first = std::max(indices[k].first, 0.0);
        plot.curves.push_back({names[k],
                               {0, indices[k].total, indices[k].total, 0, 0, first, first},
                               {y - half, y - half, y + half, y + half, y - half, y - half, y + half},
                               CurveLine::solid,
                               CurveMarker::none,
                               {}});
    }
    return plot;
}

StatisticResult evaluateSensitivity(const SensitivitySettings& settings, const std::string& name,
                                    const SampleTable& table)
{
    StatisticResult result;
    const auto [points, leftOut] = pointsOf(valuesOf(settings.value, table), table);
    result.rows.push_back(rowOf("points", static_cast<double>(points.size()), {}));
    result.rows.push_back(rowOf("pointsLeftOut", static_cast<double>(leftOut), {}));
    if (leftOut > 0)
    {
        result.remarks.push_back(
            fmt::format("{} points with a sample that failed or is not finite are left out", leftOut));
    }
    if (static_cast<long>(table.rows()) < table.requested)
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
    std::iota(all.begin(), all.end(), 0);
    if (!hasScatter(points, all))
    {
        result.remarks.push_back(
            fmt::format("The value is {:g} in all samples: there is no scatter to share among variables",
                        points.front().front()));
        return result;
    }
    const std::vector<Indices> indices = indicesOf(points, all);
    const Replicates replicates = drawnAgain(points, settings);
    for (std::size_t k = 0; k < indices.size(); ++k)
    {
        result.rows.push_back(rowOf("first_" + table.names[k], indices[k].first, replicates.first[k]));
        result.rows.push_back(rowOf("total_" + table.names[k], indices[k].total, replicates.total[k]));
    }
    Plot plot = barsOf(indices, table.names);
    plot.title = fmt::format("{}: Sobol' indices of {}", name, settings.value);
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
                               value = dictionary.locationOf("value")](const StatisticSource& source)
            {
                requireExpression(settings.value, source.names, value);
                if (!source.hasSensitivityRuns)
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
