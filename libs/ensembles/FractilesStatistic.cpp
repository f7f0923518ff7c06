// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The statistic `fractiles` of incremental dynamic analysis (Vamvatsikos and Cornell 2002): of the response
/// at each intensity, and of the intensity at which the response is reached.
#include "ensembles/StatisticTypes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
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

/// The responses of all samples.
struct Responses
{
    std::map<std::string, Curve> curves;
    std::map<double, std::vector<double>> stripes; ///< at each intensity, in ascending order
    double largest = 0;
    long failed = 0;
    long repeated = 0; ///< samples at an intensity at which their curve has another one
    long unplaced = 0; ///< samples without an intensity, where it is a result
};

Responses responsesOf(const FractilesSettings& settings, const SampleTable& table)
{
    const std::vector<double> intensities = valuesOf(settings.intensity, table);
    const std::vector<double> values = valuesOf(settings.response, table);
    const auto column = static_cast<std::size_t>(
        std::find(table.names.begin(), table.names.end(), settings.curve) - table.names.begin());
    Responses responses;
    for (std::size_t row = 0; row < table.rows(); ++row)
    {
        if (!std::isfinite(intensities[row]))
        {
            ++responses.unplaced;
            continue;
        }
        const bool isKnown = !table.isFailed[row] && std::isfinite(values[row]);
        const double response = isKnown ? values[row] : HUGE_VAL;
        responses.failed += !isKnown;
        const auto [place, isNew] =
            responses.curves[table.texts[column][row]].try_emplace(intensities[row], response);
        place->second = std::max(place->second, response);
        responses.repeated += !isNew;
        responses.stripes[intensities[row]].push_back(response);
        responses.largest = isKnown ? std::max(responses.largest, response) : responses.largest;
    }
    for (auto& [intensity, stripe] : responses.stripes)
    {
        std::sort(stripe.begin(), stripe.end());
    }
    return responses;
}

/// Those of the settings, or ten up to the largest response.
std::vector<double> levelsOf(const FractilesSettings& settings, double largest)
{
    constexpr int count = 10;
    std::vector<double> levels = settings.levels;
    for (int i = 1; i <= count && settings.levels.empty() && largest > 0; ++i)
    {
        levels.push_back(largest * i / count);
    }
    return levels;
}

/// The responses of a curve as far as they are finite, from the origin.
PlotCurve drawn(const Curve& curve)
{
    PlotCurve line{"", {0}, {0}, CurveLine::solid, CurveMarker::none, "#bbbbbb"};
    for (const auto& [intensity, response] : curve)
    {
        if (std::isfinite(response))
        {
            line.x.push_back(response);
            line.y.push_back(intensity);
        }
    }
    return line;
}

/// Fractiles of the response at each intensity: the table, and a curve of the picture each.
void addStripes(const FractilesSettings& settings, const Responses& responses, StatisticTable& table,
                Plot& plot)
{
    table.columns = {settings.intensity};
    std::vector<PlotCurve> lines;
    for (const double part : settings.fractiles)
    {
        table.columns.push_back(fmt::format("{}{:g}", settings.response, 100 * part));
        PlotCurve& line = lines.emplace_back();
        line.name = fmt::format("{:g}% of the response", 100 * part);
        line.marker = CurveMarker::none;
    }
    for (const auto& [intensity, stripe] : responses.stripes)
    {
        std::vector<double>& row = table.rows.emplace_back(1, intensity);
        for (std::size_t k = 0; k < lines.size(); ++k)
        {
            row.push_back(fractile(stripe, settings.fractiles[k]));
            if (std::isfinite(row.back()))
            {
                lines[k].x.push_back(row.back());
                lines[k].y.push_back(intensity);
            }
        }
    }
    std::move(lines.begin(), lines.end(), std::back_inserter(plot.curves));
}

/// Fractiles of the intensity at which the curves reach a level.
void addLevel(const FractilesSettings& settings, const Responses& responses, double level,
              std::vector<StatisticRow>& rows)
{
    std::vector<double> reached;
    for (const auto& [text, curve] : responses.curves)
    {
        reached.push_back(intensityAt(curve, level));
    }
    std::sort(reached.begin(), reached.end());
    for (const double part : settings.fractiles)
    {
        rows.push_back(
            {fmt::format("{}At{}{:.4g}Fractile{:g}", settings.intensity, settings.response, level, part),
             fractile(reached, part), std::nan(""), std::nan(""), std::nan("")});
    }
}

StatisticResult evaluateFractiles(const FractilesSettings& settings, const std::string& name,
                                  const SampleTable& table)
{
    const Responses responses = responsesOf(settings, table);
    const double none = std::nan("");
    StatisticResult result;
    result.rows.push_back({"curves", static_cast<double>(responses.curves.size()), none, none, none});
    result.rows.push_back({"failed", static_cast<double>(responses.failed), none, none, none});
    if (responses.failed > 0)
    {
        result.remarks.push_back(
            fmt::format("{} samples without a response count as larger than any", responses.failed));
    }
    if (responses.unplaced > 0)
    {
        result.remarks.push_back(
            fmt::format("{} samples without {} are left out", responses.unplaced, settings.intensity));
    }
    if (responses.repeated > 0)
    {
        result.remarks.push_back(
            fmt::format("{} samples have the curve and the intensity of another one: the "
                        "largest response is that of the curve",
                        responses.repeated));
    }
    Plot plot;
    plot.title = fmt::format("{}: {} curves", name, responses.curves.size());
    plot.x.label = settings.response;
    plot.y.label = settings.intensity;
    for (const auto& [text, curve] : responses.curves)
    {
        plot.curves.push_back(drawn(curve));
    }
    addStripes(settings, responses, result.table, plot);
    for (const double level : levelsOf(settings, responses.largest))
    {
        addLevel(settings, responses, level, result.rows);
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
            statistic.curve = settings.curve;
            statistic.curveLocation = dictionary.locationOf("curve");
            statistic.check = [settings, intensity = dictionary.locationOf("intensity"),
                               response = dictionary.locationOf("response"),
                               curve = dictionary.locationOf("curve")](const StatisticSource& source)
            {
                requireExpression(settings.intensity, source.names, intensity);
                requireExpression(settings.response, source.names, response);
                requireVariable(settings.curve, source.names, curve);
            };
            statistic.evaluate = [settings](const std::string& name, const SampleTable& table)
            { return evaluateFractiles(settings, name, table); };
            return statistic;
        });
}

} // namespace drystone
