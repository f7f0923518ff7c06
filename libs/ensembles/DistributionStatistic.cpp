// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The statistic `distribution`: moments, fractiles and histogram of a value, and the lognormal one near it.
#include "core/Bisection.h"
#include "ensembles/Distribution.h"
#include "ensembles/StatisticTypes.h"

#include <fmt/format.h>
#include <gsl/gsl_cdf.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <numbers>
#include <optional>

namespace drystone
{
namespace
{

struct DistributionSettings
{
    std::string value;
    std::vector<double> fractiles{0.05, 0.5, 0.95};
};
void declare(Options& options, DistributionSettings& settings)
{
    options.required("value", settings.value, "arithmetic of variables and results").example("alpha");
    options.optional("fractiles", settings.fractiles, "parts of the samples").above(0).below(1);
}

/// Mean and standard deviation. Rounding of the mean of equal values is no deviation.
std::pair<double, double> moments(const std::vector<double>& values)
{
    if (std::adjacent_find(values.begin(), values.end(), std::not_equal_to<>()) == values.end())
    {
        return {values.front(), 0};
    }
    double mean = 0;
    for (const double value : values)
    {
        mean += value / static_cast<double>(values.size());
    }
    double squares = 0;
    for (const double value : values)
    {
        squares += (value - mean) * (value - mean);
    }
    return {mean, values.size() > 1 ? std::sqrt(squares / static_cast<double>(values.size() - 1)) : 0};
}

/// Steps of equal width; their densities are the rows of the table.
PlotCurve histogramSteps(const std::vector<double>& sorted, StatisticTable& table)
{
    const double low = sorted.front();
    const double high = sorted.back();
    const auto count = static_cast<double>(sorted.size());
    const int bins = std::clamp(static_cast<int>(std::lround(2 * std::cbrt(count))), 5, 60);
    const double width = high > low ? (high - low) / bins : 1;
    std::vector<double> frequency(static_cast<std::size_t>(bins), 0.0);
    for (const double sample : sorted)
    {
        const int bin = std::min(static_cast<int>((sample - low) / width), bins - 1);
        frequency[static_cast<std::size_t>(bin)] += 1 / (count * width);
    }
    PlotCurve steps{
        fmt::format("{} samples", sorted.size()), {low}, {0}, CurveLine::solid, CurveMarker::none, {}};
    table.columns = {"from", "to", "density"};
    for (int bin = 0; bin < bins; ++bin)
    {
        const double density = frequency[static_cast<std::size_t>(bin)];
        const double from = low + bin * width;
        steps.x.insert(steps.x.end(), {from, from + width});
        steps.y.insert(steps.y.end(), {density, density});
        table.rows.push_back({from, from + width, density});
    }
    steps.x.push_back(low + bins * width);
    steps.y.push_back(0);
    return steps;
}

/// The lognormal density, or the normal one where values are not all positive; nothing where all are equal.
std::optional<PlotCurve> fittedDensity(const std::vector<double>& sorted)
{
    const double low = sorted.front();
    const double high = sorted.back();
    const bool isPositive = low > 0;
    std::vector<double> fitted = sorted;
    if (isPositive)
    {
        std::transform(fitted.begin(), fitted.end(), fitted.begin(), [](double x) { return std::log(x); });
    }
    const auto [mean, deviation] = moments(fitted);
    if (!(deviation > 0))
    {
        return std::nullopt;
    }
    PlotCurve curve{isPositive
                        ? fmt::format("lognormal, median {:.4g}, beta {:.4g}", std::exp(mean), deviation)
                        : fmt::format("normal, mean {:.4g}, deviation {:.4g}", mean, deviation),
                    {},
                    {},
                    CurveLine::dashed,
                    CurveMarker::none,
                    {}};
    for (int i = 0; i <= 100; ++i)
    {
        const double x = low + (high - low) * i / 100;
        const double z = ((isPositive ? std::log(x) : x) - mean) / deviation;
        curve.x.push_back(x);
        curve.y.push_back(std::exp(-z * z / 2)
                          / (std::sqrt(2 * std::numbers::pi) * deviation * (isPositive ? x : 1)));
    }
    return curve;
}

/// The samples in steps, with a density that is fitted to them.
Plot histogram(const std::string& name, const std::string& value, const std::vector<double>& sorted,
               StatisticTable& table)
{
    Plot plot;
    plot.title = fmt::format("{}: distribution of {}", name, value);
    plot.x.label = value;
    plot.y.label = "probability density";
    plot.curves.push_back(histogramSteps(sorted, table));
    if (std::optional<PlotCurve> density = fittedDensity(sorted))
    {
        plot.curves.push_back(std::move(*density));
    }
    return plot;
}

/// A part of independent samples, as an interval of 95% between two of them in ascending order: the number of
/// samples below the fractile is binomial. A side is not a number where even the least, or the largest, of
/// them may be beyond it.
std::pair<double, double> fractileInterval(const std::vector<double>& sorted, double part, long independent)
{
    constexpr double outside = 0.025;
    const auto count = static_cast<unsigned>(independent);
    // The least number up to count with a probability of no more that is high enough; count where none is.
    const auto least = [&](const auto& isEnough)
    {
        unsigned low = 0;
        unsigned high = count;
        while (low < high)
        {
            const unsigned middle = low + (high - low) / 2;
            if (isEnough(gsl_cdf_binomial_P(middle, part, count)))
            {
                high = middle;
            }
            else
            {
                low = middle + 1;
            }
        }
        return low;
    };
    const unsigned below = least([](double probability) { return probability > outside; });
    const unsigned above = least([](double probability) { return probability >= 1 - outside; });
    // Samples that depend on each other have the scatter of fewer.
    const auto sampleAt = [&](unsigned number)
    { return fractile(sorted, count > 1 ? static_cast<double>(number) / (count - 1) : 0.5); };
    const double none = std::nan("");
    return {below > 0 ? sampleAt(below - 1) : none, above < count ? sampleAt(above) : none};
}

/// The numbers that samples have, infinite ones too, sorted, with rows that count the samples without a
/// finite one.
std::vector<double> knownValues(const DistributionSettings& settings, const SampleTable& table,
                                StatisticResult& result)
{
    std::vector<double> sorted;
    long failed = 0;
    const std::vector<double> values = valuesOf(settings.value, table);
    for (std::size_t row = 0; row < values.size(); ++row)
    {
        failed += table.isFailed[row];
        if (!table.isFailed[row] && !std::isnan(values[row]))
        {
            sorted.push_back(values[row]);
        }
    }
    std::sort(sorted.begin(), sorted.end());
    const auto known = static_cast<long>(
        std::count_if(sorted.begin(), sorted.end(), [](double value) { return std::isfinite(value); }));
    const long missing = static_cast<long>(values.size()) - failed - known;
    const double none = std::nan("");
    result.rows.push_back({"samples", static_cast<double>(known), none, none, none});
    result.rows.push_back({"failed", static_cast<double>(failed), none, none, none});
    result.rows.push_back({"notFinite", static_cast<double>(missing), none, none, none});
    if (failed + missing > 0)
    {
        result.remarks.push_back(
            fmt::format("{} samples without a number are left out: {} failed, of {} {} is not finite",
                        failed + missing, failed, missing, settings.value));
    }
    return sorted;
}

/// How far what samples give may be off.
struct Confidence
{
    long independent = 0; ///< samples
    double degrees = 0;   ///< of freedom
    double quantile = 0;  ///< of Student's distribution, of an interval of 95%
    bool isGrid = false;  ///< chosen values, of which nothing says how far they may be off

    Confidence(long samples, bool ofGrid)
        : independent(samples),
          degrees(static_cast<double>(std::max(independent - 1, 1L))),
          quantile(gsl_cdf_tdist_Pinv(0.975, degrees)),
          isGrid(ofGrid)
    {
    }

    bool isOne() const { return independent == 1; } ///< which says nothing of how others differ from it
    bool isUnknown() const { return isOne() || isGrid; }
    double errorOfMean(double deviation) const
    {
        return isUnknown() ? std::nan("") : deviation / std::sqrt(static_cast<double>(independent));
    }
};

/// \return the standard deviation; nan of one sample
double addMoments(const std::vector<double>& sorted, const Confidence& confidence, StatisticResult& result)
{
    const double none = std::nan("");
    const auto [mean, ofSamples] = moments(sorted);
    const double deviation = confidence.isOne() ? none : ofSamples;
    const double error = confidence.errorOfMean(deviation);
    const double reach = confidence.quantile * error;
    result.rows.push_back({"mean", mean, error, mean - reach, mean + reach});
    result.rows.push_back({"standardDeviation", deviation, none, none, none});
    result.rows.push_back({"minimum", sorted.front(), none, none, none});
    result.rows.push_back({"maximum", sorted.back(), none, none, none});
    return deviation;
}

void addFractiles(const std::vector<double>& fractiles, const std::vector<double>& sorted,
                  const Confidence& confidence, StatisticResult& result)
{
    const double none = std::nan("");
    bool isOpen = false;
    for (const double part : fractiles)
    {
        const auto [lower, upper] = confidence.isUnknown()
                                        ? std::pair{none, none}
                                        : fractileInterval(sorted, part, confidence.independent);
        isOpen = isOpen || (!confidence.isUnknown() && (std::isnan(lower) || std::isnan(upper)));
        result.rows.push_back(
            {fmt::format("fractile{:g}", part), fractile(sorted, part), none, lower, upper});
    }
    if (isOpen)
    {
        result.remarks.push_back(fmt::format(
            "Of {} samples some fractiles have an interval that is open on one side, where even the "
            "outermost sample may lie beyond them: take more samples",
            confidence.independent));
    }
}

/// Without GSL's inverse, which does not converge for some degrees, as 2320.
double chiSquaredQuantile(double probability, double degrees)
{
    const double high = 10 * degrees + 100; // far beyond any part that is requested
    return bisected(0, high, [=](double value) { return gsl_cdf_chisq_P(value, degrees) < probability; });
}

/// Median and beta of the lognormal distribution with the moments of the logarithms.
void addLognormal(const std::vector<double>& positive, const Confidence& confidence, StatisticResult& result)
{
    std::vector<double> logarithms = positive;
    std::transform(logarithms.begin(), logarithms.end(), logarithms.begin(),
                   [](double x) { return std::log(x); });
    const auto [centre, beta] = moments(logarithms);
    const double theta = std::exp(centre);
    const double error = confidence.errorOfMean(beta);
    const double reach = confidence.quantile * error;
    result.rows.push_back(
        {"lognormalMedian", theta, theta * error, theta * std::exp(-reach), theta * std::exp(reach)});
    const double none = std::nan("");
    if (confidence.isGrid)
    {
        result.rows.push_back({"lognormalBeta", beta, none, none, none});
        return;
    }
    // Of normal logarithms (n - 1) s^2/sigma^2 is a chi-squared variable.
    const double degrees = confidence.degrees;
    result.rows.push_back({"lognormalBeta", beta, beta / std::sqrt(2 * degrees),
                           beta * std::sqrt(degrees / chiSquaredQuantile(0.975, degrees)),
                           beta * std::sqrt(degrees / chiSquaredQuantile(0.025, degrees))});
}

StatisticResult evaluateDistribution(const DistributionSettings& settings, const std::string& name,
                                     const SampleTable& table)
{
    StatisticResult result;
    const std::vector<double> all = knownValues(settings, table, result);
    std::vector<double> sorted;
    std::copy_if(all.begin(), all.end(), std::back_inserter(sorted),
                 [](double value) { return std::isfinite(value); });
    if (sorted.empty())
    {
        result.remarks.emplace_back("No sample has a number: there is no distribution");
        return result;
    }
    const auto known = static_cast<long>(sorted.size());
    if (known == 1)
    {
        result.remarks.emplace_back("One sample has a number: no deviation, error or interval is known");
    }
    const auto independentOf = [&table](long samples)
    { return table.sensitivityRuns > 0 ? std::max(1L, samples / table.sensitivityRuns) : samples; };
    const Confidence confidence(independentOf(known), table.isGrid);
    if (table.isGrid)
    {
        // Where a variable does not act on the value each of them stands there many times.
        result.remarks.emplace_back("The samples of a grid are chosen and not drawn: no errors and intervals "
                                    "are known. The designs random, latinHypercube and sobol have them");
    }
    if (confidence.independent < known)
    {
        result.remarks.push_back(fmt::format(
            "The {} runs of a point differ in one variable each: errors and intervals are those of {} "
            "independent samples",
            table.sensitivityRuns, confidence.independent));
    }
    const double deviation = addMoments(sorted, confidence, result);
    // An infinite value has a place among the others, as the multiplier of what no load makes collapse.
    if (const std::size_t infinite = all.size() - sorted.size(); infinite > 0)
    {
        result.remarks.push_back(fmt::format(
            "{} infinite values count in fractiles, as the largest or least there are, and in nothing else",
            infinite));
    }
    addFractiles(settings.fractiles, all,
                 Confidence(independentOf(static_cast<long>(all.size())), table.isGrid), result);
    if (sorted.front() > 0 && deviation > 0)
    {
        addLognormal(sorted, confidence, result);
    }
    result.pictures.emplace_back("", histogram(name, settings.value, sorted, result.table));
    return result;
}

} // namespace

Model<Statistic> distributionStatistic()
{
    return model<Statistic, DistributionSettings>(
        "distribution",
        "mean, deviation, fractiles and histogram of a value; errors and intervals are those of samples "
        "drawn independently, and mostly too wide for latinHypercube and sobol; a grid has none",
        [](const DistributionSettings& settings, const Dictionary& dictionary)
        {
            Statistic statistic;
            statistic.check =
                [settings, place = dictionary.locationOf("value")](const StatisticSource& source)
            { requireExpression(settings.value, source.names, place); };
            statistic.evaluate = [settings](const std::string& name, const SampleTable& table)
            { return evaluateDistribution(settings, name, table); };
            return statistic;
        });
}

} // namespace drystone
