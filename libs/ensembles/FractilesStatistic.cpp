// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The statistic `fractiles` of incremental dynamic analysis (Vamvatsikos and Cornell 2002): of the response
/// at each intensity, and of the intensity at which the response is reached.
#include "ensembles/StatisticTypes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace drystone
{
namespace
{

struct FractilesSettings
{
    std::string intensity;
    std::string response;
    std::string curve;
    std::vector<double> fractiles{0.16, 0.5, 0.84};
    std::vector<double> levels;
};
void declare(Options& options, FractilesSettings& settings)
{
    options.required("intensity", settings.intensity, "the variable that measures the ground motion")
        .example("ag");
    options.required("response", settings.response, "arithmetic of variables and results").example("drift");
    options.required("curve", settings.curve, "the variable that samples of one curve have in common")
        .example("record");
    options.optional("fractiles", settings.fractiles, "parts of the curves").above(0).below(1);
    options
        .optional("levels", settings.levels,
                  "of the response, whose intensity is wanted; absent: ten up to the largest one")
        .example("(0.01 0.02 0.05)");
}

/// One curve: response by intensity. A sample that failed has an infinite response: it has no other one.
using Curve = std::map<double, double>;

/// Where the response first reaches a level, straight lines between the samples, from the origin; infinite
/// where it does not.
double intensityAt(const Curve& curve, double level)
{
    double x = 0;
    double y = 0;
    for (const auto& [intensity, response] : curve)
    {
        if (response >= level)
        {
            return std::isfinite(response) ? x + (intensity - x) * (level - y) / (response - y) : intensity;
        }
        x = intensity;
        y = response;
    }
    return HUGE_VAL;
}

StatisticResult evaluateFractiles(const FractilesSettings& settings, const std::string& name,
                                  const SampleTable& table)
{
    StatisticResult result;
    const std::vector<double> intensities = valuesOf(settings.intensity, table);
    const std::vector<double> responses = valuesOf(settings.response, table);
    const auto column = static_cast<std::size_t>(
        std::find(table.names.begin(), table.names.end(), settings.curve) - table.names.begin());
    std::map<std::string, Curve> curves;
    std::map<double, std::vector<double>> stripes;
    double largest = 0;
    long failed = 0;
    for (std::size_t row = 0; row < table.rows(); ++row)
    {
        const bool isKnown = !table.isFailed[row] && std::isfinite(responses[row]);
        failed += !isKnown;
        const double response = isKnown ? responses[row] : HUGE_VAL;
        curves[table.texts[column][row]][intensities[row]] = response;
        stripes[intensities[row]].push_back(response);
        largest = isKnown ? std::max(largest, response) : largest;
    }
    const double none = std::nan("");
    result.rows.push_back({"curves", static_cast<double>(curves.size()), none, none, none});
    result.rows.push_back({"failed", static_cast<double>(failed), none, none, none});
    if (failed > 0)
    {
        result.remarks.push_back(
            fmt::format("{} samples without a response count as larger than any", failed));
    }
    std::vector<double> levels = settings.levels;
    for (int i = 1; levels.size() < 10 && settings.levels.empty() && largest > 0; ++i)
    {
        levels.push_back(largest * i / 10);
    }
    Plot plot;
    plot.title = fmt::format("{}: {} curves", name, curves.size());
    plot.x.label = settings.response;
    plot.y.label = settings.intensity;
    for (const auto& [text, curve] : curves)
    {
        PlotCurve drawn{"", {0}, {0}, CurveLine::solid, CurveMarker::none, "#bbbbbb"};
        for (const auto& [intensity, response] : curve)
        {
            if (std::isfinite(response))
            {
                drawn.x.push_back(response);
                drawn.y.push_back(intensity);
            }
        }
        plot.curves.push_back(std::move(drawn));
    }
    result.table.columns = {settings.intensity};
    for (const double part : settings.fractiles)
    {
        result.table.columns.push_back(fmt::format("{}{:g}", settings.response, 100 * part));
    }
    std::vector<PlotCurve> fractiles(settings.fractiles.size());
    for (std::size_t k = 0; k < fractiles.size(); ++k)
    {
        fractiles[k].name = fmt::format("{:g}% of the response", 100 * settings.fractiles[k]);
        fractiles[k].marker = CurveMarker::none;
    }
    for (auto& [intensity, stripe] : stripes)
    {
        std::sort(stripe.begin(), stripe.end());
        std::vector<double> row{intensity};
        for (std::size_t k = 0; k < fractiles.size(); ++k)
        {
            const double response = fractile(stripe, settings.fractiles[k]);
            row.push_back(response);
            if (std::isfinite(response))
            {
                fractiles[k].x.push_back(response);
                fractiles[k].y.push_back(intensity);
            }
        }
        result.table.rows.push_back(std::move(row));
    }
    for (PlotCurve& curve : fractiles)
    {
        plot.curves.push_back(std::move(curve));
    }
    for (const double level : levels)
    {
        std::vector<double> reached;
        for (const auto& [text, curve] : curves)
        {
            reached.push_back(intensityAt(curve, level));
        }
        std::sort(reached.begin(), reached.end());
        for (const double part : settings.fractiles)
        {
            result.rows.push_back(
                {fmt::format("{}At{}{:.4g}Fractile{:g}", settings.intensity, settings.response, level, part),
                 fractile(reached, part), none, none, none});
        }
    }
    result.pictures.emplace_back("", std::move(plot));
    return result;
}

} // namespace

Model<Statistic> fractilesStatistic()
{
    return model<Statistic, FractilesSettings>(
        "fractiles", "of curves of a response over the intensity, both ways",
        [](const FractilesSettings& settings, const Dictionary& dictionary)
        {
            Statistic statistic;
            statistic.check =
                [settings, intensity = dictionary.locationOf("intensity"),
                 response = dictionary.locationOf("response"),
                 curve = dictionary.locationOf("curve")](const std::vector<std::string>& names, bool)
            {
                requireExpression(settings.intensity, names, intensity);
                requireExpression(settings.response, names, response);
                requireVariable(settings.curve, names, curve);
            };
            statistic.evaluate = [settings](const std::string& name, const SampleTable& table)
            { return evaluateFractiles(settings, name, table); };
            return statistic;
        });
}

} // namespace drystone
