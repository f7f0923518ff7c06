// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The statistic `fragility`: the curve of samples, with its confidence band and its picture.
#include "ensembles/FragilityObservations.h"
#include "ensembles/StatisticTypes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace drystone
{
namespace
{

enum class FragilityMethod
{
    multipleStripe,
    truncatedIDA
};
std::array<std::pair<std::string_view, FragilityMethod>, 2> namesOf(FragilityMethod)
{
    return {{{"multipleStripe", FragilityMethod::multipleStripe},
             {"truncatedIDA", FragilityMethod::truncatedIDA}}};
}

struct FragilitySettings : FragilityNames
{
    FragilityMethod method = FragilityMethod::multipleStripe;
    int bootstrap = 1000;
    int seed = 1;
};
void declare(Options& options, FragilitySettings& settings)
{
    options
        .required("intensity", settings.intensity, "the variable or result that measures the ground motion")
        .example("ag");
    options
        .required("exceeded", settings.exceeded,
                  "when a sample has failed: a comparison of variables and results")
        .example("\"drift > 0.05\"");
    options.optional(
        "method", settings.method,
        "multipleStripe: samples at each intensity; truncatedIDA: the lowest intensity at which each "
        "curve fails, or the highest at which a curve that stands was tried");
    options
        .optional("curve", settings.curve,
                  "of truncatedIDA: the variable that samples of one curve have in common")
        .example("record");
    options.optional("bootstrap", settings.bootstrap, "samples drawn again for the confidence band")
        .atLeast(0)
        .atMost(100000);
    options.optional("seed", settings.seed, "of the drawing").atLeast(0);
    options.check(
        "curve",
        [&settings]
        {
            return settings.method == FragilityMethod::truncatedIDA && !settings.curve
                       ? "truncatedIDA needs to know which samples are one curve: give the variable "
                         "they have in common, as `curve record;`."
                       : "";
        });
}

std::optional<FragilityFit> fitOf(FragilityMethod method, const Observations& observations)
{
    if (method == FragilityMethod::multipleStripe)
    {
        return fitStripes(stripesOf(observations));
    }
    const TruncatedCurves curves = curvesOf(observations);
    return fitTruncated(curves.failing, curves.standing);
}

/// Fits of samples that are drawn again: of stripes run by run, of curves curve by curve.
std::vector<FragilityFit> bootstrap(const FragilitySettings& settings, const Observations& observations)
{
    std::vector<FragilityFit> fits;
    const auto seed = static_cast<std::uint64_t>(settings.seed);
    const auto add = [&fits](const std::optional<FragilityFit>& fit)
    {
        if (fit)
        {
            fits.push_back(*fit);
        }
    };
    const std::vector<Stripe> stripes = stripesOf(observations);
    const TruncatedCurves curves = observations.curve.empty() ? TruncatedCurves() : curvesOf(observations);
    for (int replicate = 0; replicate < settings.bootstrap; ++replicate)
    {
        const auto number = static_cast<std::uint32_t>(replicate);
        if (settings.method == FragilityMethod::multipleStripe)
        {
            add(fitStripes(resampled(stripes, seed, number)));
            continue;
        }
        const TruncatedCurves drawn = resampled(curves, seed, number);
        add(fitTruncated(drawn.failing, drawn.standing));
    }
    return fits;
}

std::pair<double, double> interval(std::vector<double> values)
{
    if (values.size() < 20)
    {
        return {std::nan(""), std::nan("")};
    }
    std::sort(values.begin(), values.end());
    return {fractile(values, 0.025), fractile(values, 0.975)};
}

template<class Figure>
std::pair<double, double> intervalOf(const std::vector<FragilityFit>& fits, const Figure& figure)
{
    std::vector<double> values;
    for (const FragilityFit& fit : fits)
    {
        values.push_back(figure(fit));
    }
    return interval(std::move(values));
}

void addRows(StatisticResult& result, const std::string& suffix, const FragilityFit& fit,
             const std::vector<FragilityFit>& fits)
{
    const auto theta = intervalOf(fits, [](const FragilityFit& drawn) { return drawn.theta; });
    const auto beta = intervalOf(fits, [](const FragilityFit& drawn) { return drawn.beta; });
    const double none = std::nan("");
    result.rows.push_back(
        {"theta" + suffix, fit.theta, fit.theta * fit.logThetaError, theta.first, theta.second});
    result.rows.push_back({"beta" + suffix, fit.beta, fit.beta * fit.logBetaError, beta.first, beta.second});
    result.rows.push_back({"logThetaStandardError" + suffix, fit.logThetaError, none, none, none});
    result.rows.push_back({"logBetaStandardError" + suffix, fit.logBetaError, none, none, none});
}

/// A curve of the picture without points yet.
PlotCurve emptyCurve(std::string label, CurveLine line, CurveMarker marker, std::string colour = "")
{
    return {std::move(label), {}, {}, line, marker, std::move(colour)};
}

void addPoint(PlotCurve& curve, double x, double y)
{
    curve.x.push_back(x);
    curve.y.push_back(y);
}

/// The curve from 0 to a little beyond the highest intensity, and its band where drawings give one.
std::vector<PlotCurve> curveAndBand(const FragilityFit& fit, const std::vector<FragilityFit>& fits,
                                    double highest)
{
    constexpr int pieces = 60;
    PlotCurve curve = emptyCurve(fmt::format("theta {:.4g}, beta {:.4g}", fit.theta, fit.beta),
                                 CurveLine::solid, CurveMarker::none);
    PlotCurve low = emptyCurve("band of 95% (bootstrap)", CurveLine::dashed, CurveMarker::none, "#888888");
    PlotCurve high = emptyCurve("", CurveLine::dashed, CurveMarker::none, "#888888");
    for (int i = 0; i <= pieces; ++i)
    {
        const double x = 1.1 * highest * i / pieces;
        addPoint(curve, x, fit.probability(x));
        const auto band = intervalOf(fits, [x](const FragilityFit& drawn) { return drawn.probability(x); });
        if (std::isfinite(band.first))
        {
            addPoint(low, x, band.first);
            addPoint(high, x, band.second);
        }
    }
    return low.x.empty() ? std::vector{curve} : std::vector{curve, low, high};
}

/// Rows of the table: intensity, runs, exceeded, part, fitted. Of stripes each one, of curves each intensity
/// at which some have failed.
std::vector<std::vector<double>> failedRows(FragilityMethod method, const Observations& observations,
                                            const FragilityFit& fit)
{
    std::vector<std::vector<double>> rows;
    if (method == FragilityMethod::multipleStripe)
    {
        for (const Stripe& stripe : stripesOf(observations))
        {
            const auto runs = static_cast<double>(stripe.runs);
            const auto exceeded = static_cast<double>(stripe.exceeded);
            rows.push_back(
                {stripe.intensity, runs, exceeded, exceeded / runs, fit.probability(stripe.intensity)});
        }
        return rows;
    }
    const TruncatedCurves curves = curvesOf(observations);
    double failed = 0;
    for (const auto& [intensity, part] : failedParts(curves))
    {
        rows.push_back(
            {intensity, static_cast<double>(curves.count()), ++failed, part, fit.probability(intensity)});
    }
    return rows;
}

/// A curve, and those of drawings from its samples.
struct CurveAndDrawings
{
    FragilityFit fit;
    std::vector<FragilityFit> drawings;
};

/// The curve with its band, and the part of each stripe, or of the curves, that has failed.
void draw(StatisticResult& result, const std::string& name, const FragilitySettings& settings,
          const Observations& observations, const CurveAndDrawings& fitted)
{
    result.table.columns = {"intensity", "runs", "exceeded", "part", "fitted"};
    result.table.rows = failedRows(settings.method, observations, fitted.fit);
    PlotCurve parts =
        emptyCurve(settings.method == FragilityMethod::multipleStripe ? "stripes" : "curves that have failed",
                   CurveLine::none, CurveMarker::circle);
    for (const std::vector<double>& row : result.table.rows)
    {
        addPoint(parts, row[0], row[3]);
    }
    Plot plot;
    plot.title = fmt::format("{}: probability of {}", name, settings.exceeded);
    plot.x.label = settings.intensity;
    plot.y.label = "probability";
    plot.y.lower = 0;
    plot.y.upper = 1;
    plot.curves =
        curveAndBand(fitted.fit, fitted.drawings,
                     *std::max_element(observations.intensity.begin(), observations.intensity.end()));
    plot.curves.push_back(std::move(parts));
    result.pictures.emplace_back("", std::move(plot));
}

/// Adds a remark on what is odd in samples that give a curve all the same.
void addRemarks(StatisticResult& result, const FragilitySettings& settings, const Observations& observations)
{
    if (observations.unplaced > 0)
    {
        result.remarks.push_back(
            fmt::format("{} samples without {} are left out", observations.unplaced, settings.intensity));
    }
    if (observations.undefined > 0)
    {
        result.remarks.push_back(
            fmt::format("{} samples count as failed since `{}` is not defined with their values",
                        observations.undefined, settings.exceeded));
    }
}

/// Why there is no curve; empty where there may be one.
std::string whyNoCurve(const FragilitySettings& settings, const Observations& observations)
{
    // A result may be 0 or 1 and a condition by itself, which is known by its values alone.
    if (observations.numbers > 0)
    {
        return fmt::format("`{0}` is a number, not a condition: compare it, as in \"{0} > 0.05\"; in {1} "
                           "samples it is neither 0 nor 1, and there is no curve",
                           settings.exceeded, observations.numbers);
    }
    const auto isNotAbove0 = [](double intensity) { return !(intensity > 0); };
    if (std::any_of(observations.intensity.begin(), observations.intensity.end(), isNotAbove0))
    {
        return fmt::format("{} is not above 0 in all samples: there is no lognormal curve",
                           settings.intensity);
    }
    return "";
}

/// Fits a curve to the samples and adds its rows, or a remark on why there is none. \param suffix of their
/// names
std::optional<CurveAndDrawings> addCurve(StatisticResult& result, const FragilitySettings& settings,
                                         const Observations& observations, const std::string& suffix)
{
    const std::optional<FragilityFit> fit =
        observations.intensity.empty() ? std::nullopt : fitOf(settings.method, observations);
    if (!fit)
    {
        result.remarks.emplace_back(
            settings.method == FragilityMethod::multipleStripe
                ? "The likelihood has no maximum: samples that exceed and samples that do not have to "
                  "overlap, and their part has to grow with the intensity. Take more samples, or other "
                  "intensities"
                : "The likelihood has no maximum: no curve fails, or all fail at one intensity. Take "
                  "more curves, or more intensities");
        return std::nullopt;
    }
    std::vector<FragilityFit> fits = bootstrap(settings, observations);
    if (static_cast<int>(fits.size()) < settings.bootstrap)
    {
        result.remarks.push_back(
            fmt::format("{} of {} bootstrap drawings have no maximum and are left out of the band",
                        settings.bootstrap - static_cast<int>(fits.size()), settings.bootstrap));
    }
    addRows(result, suffix, *fit, fits);
    return CurveAndDrawings{*fit, std::move(fits)};
}

/// The curve that the picture has, too.
void addDrawnCurve(StatisticResult& result, const std::string& name, const FragilitySettings& settings,
                   const Observations& observations, const std::string& suffix)
{
    if (const std::optional<CurveAndDrawings> fitted = addCurve(result, settings, observations, suffix))
    {
        draw(result, name, settings, observations, *fitted);
    }
}

StatisticResult evaluateFragility(const FragilitySettings& settings, const std::string& name,
                                  const SampleTable& table)
{
    StatisticResult result;
    const Observations standing = observationsOf(settings, table, FailedAs::standing);
    const double none = std::nan("");
    result.rows.push_back({"samples", static_cast<double>(table.rows()), none, none, none});
    result.rows.push_back(
        {"failed", static_cast<double>(standing.failures + standing.unplaced), none, none, none});
    addRemarks(result, settings, standing);
    if (const std::string why = whyNoCurve(settings, standing); !why.empty())
    {
        result.remarks.push_back(why);
        return result;
    }
    const std::size_t repeated =
        settings.method == FragilityMethod::truncatedIDA ? curvesOf(standing).repeated : 0;
    if (repeated > 0)
    {
        result.remarks.push_back(fmt::format("{} samples have the curve and the intensity of another one: a "
                                             "curve fails there if one of them does",
                                             repeated));
    }
    if (standing.failures == 0)
    {
        addDrawnCurve(result, name, settings, standing, "");
        return result;
    }
    addCurve(result, settings, standing, "FailedAsStanding");
    result.remarks.push_back(
        fmt::format("{} samples have no result: the curve is given with them as standing "
                    "and as fallen; the picture is the latter",
                    standing.failures));
    addDrawnCurve(result, name, settings, observationsOf(settings, table, FailedAs::fallen),
                  "FailedAsFallen");
    return result;
}

} // namespace

Model<Statistic> fragilityStatistic()
{
    return model<Statistic, FragilitySettings>(
        "fragility", "probability of failure over the intensity, a lognormal curve by maximum likelihood",
        [](const FragilitySettings& settings, const Dictionary& dictionary)
        {
            Statistic statistic;
            statistic.curve = settings.curve.value_or("");
            statistic.curveLocation = dictionary.locationOf("curve");
            statistic.check = [settings, intensity = dictionary.locationOf("intensity"),
                               exceeded = dictionary.locationOf("exceeded"),
                               curve = dictionary.locationOf("curve")](const StatisticSource& source)
            {
                requireExpression(settings.intensity, source.names, intensity);
                requireCondition(settings.exceeded, source.names, exceeded);
                if (settings.curve)
                {
                    requireVariable(*settings.curve, source.names, curve);
                }
            };
            statistic.evaluate = [settings](const std::string& name, const SampleTable& table)
            { return evaluateFragility(settings, name, table); };
            return statistic;
        });
}

} // namespace drystone
