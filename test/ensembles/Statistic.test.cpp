// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Statistics of samples whose results are known in closed form or were computed by others.
#include "ensembles/Statistic.h"
#include "core/Error.h"
#include "ensembles/Distribution.h"
#include "ensembles/Fragility.h"
#include "ensembles/Philox.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

using namespace drystone;
using testing::HasSubstr;

namespace
{

StatisticResult evaluated(const std::string& text, const SampleTable& table)
{
    const Statistic statistic = statisticTypes().select(Dictionary::readString(text, "system/ensembleDict"));
    statistic.check({.names = table.names, .hasSensitivityRuns = table.sensitivityRuns > 0});
    return statistic.evaluate("test", table);
}

StatisticRow rowOf(const StatisticResult& result, const std::string& quantity)
{
    const auto found = std::find_if(result.rows.begin(), result.rows.end(),
                                    [&](const StatisticRow& row) { return row.quantity == quantity; });
    EXPECT_NE(found, result.rows.end()) << quantity;
    return found == result.rows.end() ? StatisticRow() : *found;
}

/// One variable x and one result y.
SampleTable tableOf(const std::vector<double>& x, const std::vector<double>& y)
{
    SampleTable table;
    table.names = {"x", "y"};
    table.variables = 1;
    table.columns = {x, y};
    table.texts.resize(1);
    for (const double value : x)
    {
        table.texts[0].push_back(std::to_string(value));
    }
    table.isFailed.assign(x.size(), 0);
    table.requested = static_cast<long>(x.size());
    return table;
}

const std::vector<double> intensities{.2, .3, .4, .6, .7, .8, .9, 1.0};
const std::vector<long> collapses{0, 0, 0, 4, 6, 13, 12, 16};

/// 40 records at each intensity: y is 1 where it collapses.
SampleTable collapseTable()
{
    std::vector<double> x;
    std::vector<double> y;
    for (std::size_t stripe = 0; stripe < intensities.size(); ++stripe)
    {
        for (long run = 0; run < 40; ++run)
        {
            x.push_back(intensities[stripe]);
            y.push_back(run < collapses[stripe] ? 1 : 0);
        }
    }
    return tableOf(x, y);
}

} // namespace

TEST(Fragility, OfStripesIsThatOfBaker)
{
    std::vector<Stripe> stripes;
    for (std::size_t i = 0; i < intensities.size(); ++i)
    {
        stripes.push_back({intensities[i], 40, collapses[i]});
    }
    const auto fit = fitStripes(stripes);
    ASSERT_TRUE(fit);
    EXPECT_NEAR(fit->theta, 1.076116, 1e-6);
    EXPECT_NEAR(fit->beta, 0.429237, 1e-6);
    EXPECT_NEAR(fit->logThetaError, 0.0717, 5e-5);
    EXPECT_NEAR(fit->logBetaError, 0.1954, 5e-5);
    EXPECT_DOUBLE_EQ(fit->probability(fit->theta), 0.5);
}

TEST(Fragility, OfTruncatedCurvesIsThatOfBaker)
{
    const auto fit = fitTruncated({.31, .42, .55, .61, .80}, {.9, .9, .9});
    ASSERT_TRUE(fit);
    EXPECT_NEAR(fit->theta, 0.726176, 1e-6);
    EXPECT_NEAR(fit->beta, 0.550963, 1e-6);
    EXPECT_NEAR(fit->logThetaError, 0.215601, 1e-5); // of the second derivatives by differences
    EXPECT_NEAR(fit->logBetaError, 0.346890, 1e-5);
    // Without curves that stand it is mean and deviation of the logarithms.
    const auto all = fitTruncated({0.5, 2}, {});
    ASSERT_TRUE(all);
    EXPECT_NEAR(all->theta, 1, 1e-12);
    EXPECT_NEAR(all->beta, std::log(2), 1e-12);
}

TEST(Fragility, DoesNotDependOnTheUnitOfTheIntensity)
{
    for (const double unit : {1e-6, 9.81, 1e6})
    {
        std::vector<Stripe> stripes;
        for (std::size_t i = 0; i < intensities.size(); ++i)
        {
            stripes.push_back({unit * intensities[i], 40, collapses[i]});
        }
        const auto fit = fitStripes(stripes);
        ASSERT_TRUE(fit) << unit;
        EXPECT_NEAR(fit->theta / unit, 1.0761158, 1e-6);
        EXPECT_NEAR(fit->beta, 0.4292372, 1e-6);
    }
}

TEST(Fragility, HasNoMaximumWhereItHasNone)
{
    EXPECT_FALSE(fitStripes({{0.1, 10, 0}, {0.2, 10, 10}})); // no overlap: a step anywhere between
    EXPECT_FALSE(fitStripes({{0.1, 10, 0}, {0.2, 10, 3}, {0.3, 10, 10}})); // one intensity alone is mixed
    EXPECT_FALSE(fitStripes({{0.1, 10, 0}, {0.2, 10, 0}}));
    EXPECT_FALSE(fitStripes({{0.1, 10, 10}, {0.2, 10, 10}}));
    EXPECT_FALSE(fitStripes({{0.1, 10, 6}, {0.2, 10, 3}}));            // fewer fail in a stronger motion
    EXPECT_FALSE(fitStripes({{0.3, 7, 3}, {0.7, 7, 3}, {1.1, 7, 3}})); // the same part fails in any motion
    EXPECT_FALSE(fitStripes({}));
    EXPECT_FALSE(fitTruncated({}, {1, 1}));
    EXPECT_FALSE(fitTruncated({0.5, 0.5}, {}));
    EXPECT_TRUE(fitTruncated({0.5}, {1, 1, 1}));
}

TEST(FragilityStatistic, CountsStripesAndDrawsABand)
{
    const StatisticResult result =
        evaluated("type fragility; intensity x; exceeded \"y > 0.5\"; bootstrap 200;", collapseTable());
    EXPECT_NEAR(rowOf(result, "theta").value, 1.076116, 1e-6);
    EXPECT_NEAR(rowOf(result, "logThetaStandardError").value, 0.0717, 5e-5);
    EXPECT_LT(rowOf(result, "theta").lower, 1.0);
    EXPECT_GT(rowOf(result, "theta").upper, 1.15);
    EXPECT_EQ(result.table.rows.size(), 8u);
    ASSERT_EQ(result.pictures.size(), 1u);
    EXPECT_THAT(plotSvg(result.pictures.front().second), HasSubstr("stripes"));
}

TEST(FragilityStatistic, GivesFailedSamplesBothWays)
{
    SampleTable table = collapseTable();
    for (const std::size_t row : {130u, 170u, 290u}) // one has no result, two failed
    {
        table.isFailed[row] = row != 290;
        table.columns[1][row] = std::nan("");
    }
    const StatisticResult result =
        evaluated("type fragility; intensity x; exceeded \"y > 0.5\"; bootstrap 0;", table);
    EXPECT_EQ(rowOf(result, "failed").value, 3);
    EXPECT_LT(rowOf(result, "thetaFailedAsFallen").value, rowOf(result, "thetaFailedAsStanding").value);
}

// A comparison with what is not a number is false: these samples counted as standing without a word.
TEST(FragilityStatistic, CountsSamplesAsFailedWhoseConditionIsNotDefined)
{
    const SampleTable table = collapseTable();
    const double least = *std::min_element(table.columns[0].begin(), table.columns[0].end());
    const auto undefined = std::count(table.columns[0].begin(), table.columns[0].end(), least);
    ASSERT_GT(undefined, 0);
    const StatisticResult result = evaluated(
        fmt::format("type fragility; intensity x; exceeded \"y > 0.5 + 0*log(x - {})\"; bootstrap 0;",
                    least * 1.0001),
        table);
    EXPECT_EQ(rowOf(result, "failed").value, undefined);
    ASSERT_FALSE(result.remarks.empty());
    EXPECT_THAT(result.remarks.front(), HasSubstr("is not defined"));
}

TEST(FragilityStatistic, OfCurvesTakesTheLowestIntensityThatFails)
{
    std::vector<double> x;
    std::vector<double> y;
    SampleTable table = tableOf({}, {});
    const std::vector<double> tried{.31, .42, .55, .61, .80, .9};
    for (int curve = 0; curve < 8; ++curve)
    {
        for (const double intensity : tried)
        {
            table.columns[0].push_back(intensity);
            table.columns[1].push_back(curve < 5 && intensity >= tried[static_cast<std::size_t>(curve)] ? 1
                                                                                                        : 0);
            table.texts[0].push_back(std::to_string(curve));
            table.isFailed.push_back(0);
        }
    }
    const StatisticResult result = evaluated(
        "type fragility; intensity x; exceeded \"y > 0.5\"; method truncatedIDA; curve x; bootstrap 100;",
        table);
    EXPECT_NEAR(rowOf(result, "theta").value, 0.726176, 1e-6);
    EXPECT_NEAR(rowOf(result, "beta").value, 0.550963, 1e-6);
}

// Curves that stand were tried up to different intensities: what is known of each is that it stood there.
TEST(FragilityStatistic, OfCurvesTriedToDifferentIntensitiesHasTheirStrengths)
{
    constexpr double median = 0.65;
    constexpr double beta = 0.4;
    SampleTable table = tableOf({}, {});
    for (int curve = 0; curve < 100; ++curve)
    {
        const double strength = median * std::exp(beta * normalQuantile((curve + 0.5) / 100));
        for (double intensity = 0.02; intensity < (curve % 2 == 0 ? 0.6 : 2) + 1e-9; intensity += 0.02)
        {
            table.columns[0].push_back(intensity);
            table.columns[1].push_back(intensity >= strength);
            table.texts[0].push_back(std::to_string(curve));
            table.isFailed.push_back(0);
        }
    }
    const StatisticResult result = evaluated(
        "type fragility; intensity x; exceeded \"y > 0.5\"; method truncatedIDA; curve x; bootstrap 100;",
        table);
    EXPECT_NEAR(rowOf(result, "theta").value, median + 0.01, 0.01); // the next of steps of 0.02 above
    EXPECT_NEAR(rowOf(result, "beta").value, beta, 0.02);
    // What has failed of all grows as the curve, though most curves were not tried beyond 0.6.
    for (const std::vector<double>& row : result.table.rows)
    {
        EXPECT_NEAR(row[3], row[4], 0.05) << row[0];
    }
}

TEST(FragilityStatistic, SaysThatCurvesHaveSeveralSamplesAtAnIntensity)
{
    SampleTable table = tableOf({0.1, 0.1, 0.2, 0.1, 0.2}, {0, 1, 1, 0, 0});
    table.texts[0] = {"a", "a", "a", "b", "b"};
    for (const char* text :
         {"type fragility; intensity x; exceeded \"y > 0.5\"; method truncatedIDA; curve x;",
          "type fractiles; intensity x; response y; curve x;"})
    {
        EXPECT_THAT(
            evaluated(text, table).remarks,
            testing::Contains(HasSubstr("1 samples have the curve and the intensity of another one")));
    }
}

// A stripe of one run drawn again is itself: runs of all stripes are drawn.
TEST(FragilityStatistic, HasABandWhereEachSampleHasAnIntensityOfItsOwn)
{
    std::vector<double> x;
    std::vector<double> y;
    for (int i = 0; i < 300; ++i)
    {
        x.push_back(0.2 + 1.8 * (i + 0.5) / 300);
        const double probability = normalProbability(std::log(x.back() / 0.65) / 0.4);
        y.push_back(uniform(7, Stream::sample, 0, static_cast<std::uint64_t>(i)) < probability);
    }
    const StatisticResult result =
        evaluated("type fragility; intensity x; exceeded \"y > 0.5\"; bootstrap 500;", tableOf(x, y));
    for (const char* name : {"theta", "beta"})
    {
        const StatisticRow row = rowOf(result, name);
        EXPECT_NEAR((row.upper - row.lower) / (4 * row.standardError), 1, 0.3) << name;
    }
}

TEST(FragilityStatistic, SaysWhereThereIsNoCurve)
{
    const StatisticResult result =
        evaluated("type fragility; intensity x; exceeded \"y > 0.5\";", tableOf({0.1, 0.2, 0.3}, {0, 0, 1}));
    EXPECT_THAT(result.remarks, testing::Contains(HasSubstr("no maximum")));
    EXPECT_THROW(evaluated("type fragility; intensity z; exceeded \"y > 0.5\";", collapseTable()),
                 FatalIOError);
    EXPECT_THROW(evaluated("type fragility; intensity x; exceeded \"y >\";", collapseTable()), FatalIOError);
    EXPECT_THROW(evaluated("type fragility; intensity x; exceeded y; method truncatedIDA;", collapseTable()),
                 FatalIOError);
    EXPECT_THROW(evaluated("type fragility; intensity 2.5; exceeded \"y > 0.5\";", collapseTable()),
                 FatalIOError);
    EXPECT_THROW(evaluated("type fragility; intensity x; exceeded -1;", collapseTable()), FatalIOError);
    EXPECT_THROW(evaluated("type fragility; intensity x; exceeded \"y + 0.5\";", collapseTable()),
                 FatalIOError);
    EXPECT_NO_THROW(evaluated("type fragility; intensity x; exceeded y;", collapseTable())); // 0 or 1
}

TEST(FragilityStatistic, OfAResultThatIsNoConditionIsNone)
{
    SampleTable drifts = collapseTable();
    for (double& y : drifts.columns[1])
    {
        y *= 0.3; // metres, not 0 or 1
    }
    for (const char* exceeded : {"y", "\"y*y\"", "\"min(x,y)\""})
    {
        const StatisticResult result =
            evaluated(fmt::format("type fragility; intensity x; exceeded {};", exceeded), drifts);
        EXPECT_THAT(result.remarks, testing::Contains(HasSubstr("is a number, not a condition"))) << exceeded;
        EXPECT_TRUE(result.table.rows.empty()) << exceeded;
    }
    EXPECT_NO_THROW(rowOf(evaluated("type fragility; intensity x; exceeded y;", collapseTable()), "theta"));
}

TEST(DistributionStatistic, HasMomentsAndFractiles)
{
    std::vector<double> values;
    for (int i = 0; i < 10001; ++i)
    {
        values.push_back(2 * std::exp(0.4 * normalQuantile((i + 0.5) / 10001)));
    }
    SampleTable table = tableOf(values, values);
    table.columns[1][0] = std::nan("");
    table.isFailed[1] = 1;
    const StatisticResult result = evaluated("type distribution; value y;", table);
    EXPECT_EQ(rowOf(result, "samples").value, 9999);
    EXPECT_EQ(rowOf(result, "failed").value, 1);
    EXPECT_EQ(rowOf(result, "notFinite").value, 1);
    EXPECT_NEAR(rowOf(result, "mean").value, 2 * std::exp(0.08), 1e-3);
    EXPECT_NEAR(rowOf(result, "lognormalBeta").value, 0.4, 1e-3);
    EXPECT_NEAR(rowOf(result, "fractile0.5").value, 2, 1e-3);
    EXPECT_NEAR(rowOf(result, "fractile0.95").value, 2 * std::exp(0.4 * 1.6448536), 2e-3);
    EXPECT_LT(rowOf(result, "fractile0.95").lower, rowOf(result, "fractile0.95").upper);
    EXPECT_FALSE(result.remarks.empty());
    EXPECT_FALSE(plotSvg(result.pictures.front().second).empty());
    EXPECT_NEAR(rowOf(evaluated("type distribution; value \"10 * y + x\";", table), "minimum").value,
                11 * values[2], 1e-9);
}

TEST(DistributionStatistic, CountsInfiniteValuesAmongTheLargestInFractilesAlone)
{
    // As where no load makes some of the structures collapse.
    std::vector<double> values;
    for (int i = 0; i < 101; ++i)
    {
        values.push_back(i < 81 ? i + 1 : HUGE_VAL);
    }
    const SampleTable table = tableOf(values, values);
    const StatisticResult result =
        evaluated("type distribution; value y; fractiles (0.1 0.5 0.805 0.9);", table);
    EXPECT_EQ(rowOf(result, "samples").value, 81);
    EXPECT_EQ(rowOf(result, "notFinite").value, 20);
    EXPECT_NEAR(rowOf(result, "mean").value, 41, 1e-12);
    EXPECT_EQ(rowOf(result, "maximum").value, 81);
    EXPECT_NEAR(rowOf(result, "fractile0.1").value, 11, 1e-9);
    EXPECT_NEAR(rowOf(result, "fractile0.5").value, 51, 1e-9);
    // Numbers of samples below the median are binomial: 40 to 60 of 101 in 95%.
    EXPECT_NEAR(rowOf(result, "fractile0.5").lower, 41, 1e-9);
    EXPECT_NEAR(rowOf(result, "fractile0.5").upper, 61, 1e-9);
    EXPECT_TRUE(std::isinf(rowOf(result, "fractile0.805").value)); // between 81 and infinity
    EXPECT_TRUE(std::isinf(rowOf(result, "fractile0.9").value));
    EXPECT_THAT(result.remarks, testing::Contains(HasSubstr("20 infinite values count in fractiles")));
    for (double& value : values)
    {
        value *= -1;
    }
    const StatisticResult least =
        evaluated("type distribution; value y; fractiles (0.05 0.195);", tableOf(values, values));
    EXPECT_EQ(rowOf(least, "fractile0.05").value, -HUGE_VAL);
    EXPECT_EQ(rowOf(least, "fractile0.195").value, -HUGE_VAL); // between that and -81
}

TEST(DistributionStatistic, HasTheIntervalOfTheDeviationForAnyNumberOfSamples)
{
    // For 2320 degrees of freedom GSL's inverse of the chi-squared distribution does not converge.
    std::vector<double> values;
    for (int i = 0; i < 2321; ++i)
    {
        values.push_back(std::exp(std::sin(i)));
    }
    const StatisticRow beta =
        rowOf(evaluated("type distribution; value y;", tableOf(values, values)), "lognormalBeta");
    // Wilson and Hilferty's approximation of the fractiles.
    const auto fractileOf = [](double z)
    { return 2320 * std::pow(1 - 2 / (9 * 2320.0) + z * std::sqrt(2 / (9 * 2320.0)), 3); };
    EXPECT_NEAR(beta.lower / beta.value, std::sqrt(2320 / fractileOf(1.959963984540054)), 1e-6);
    EXPECT_NEAR(beta.upper / beta.value, std::sqrt(2320 / fractileOf(-1.959963984540054)), 1e-6);
}

TEST(DistributionStatistic, OfOneValueHasNoDeviation)
{
    // 0.1 has a mean that differs from it by rounding, which is no scatter.
    const std::vector<double> same(30, 0.1);
    const StatisticResult result = evaluated("type distribution; value y;", tableOf(same, same));
    EXPECT_EQ(rowOf(result, "mean").value, 0.1);
    EXPECT_EQ(rowOf(result, "standardDeviation").value, 0);
    EXPECT_EQ(result.pictures.front().second.curves.size(), 1u); // no curve of a lognormal distribution
}

TEST(DistributionStatistic, OfFewSamplesHasTheIntervalsOfFew)
{
    const StatisticResult three = evaluated("type distribution; value y;", tableOf({1, 2, 3}, {1, 2, 3}));
    // Student's t of two degrees of freedom: 4.3027 standard errors.
    EXPECT_NEAR(rowOf(three, "mean").upper, 2 + 4.30265 / std::sqrt(3), 1e-5);
    // Of three samples all are above the fractile of 5% in 86 of 100 cases.
    EXPECT_TRUE(std::isnan(rowOf(three, "fractile0.05").lower));
    EXPECT_THAT(three.remarks, testing::Contains(HasSubstr("open on one side")));
    std::vector<double> values;
    for (int i = 1; i <= 20; ++i)
    {
        values.push_back(i);
    }
    // Of twenty the median is between the 6th and the 15th (Conover 1999, table A3).
    const StatisticRow median =
        rowOf(evaluated("type distribution; value y;", tableOf(values, values)), "fractile0.5");
    EXPECT_EQ(median.lower, 6);
    EXPECT_EQ(median.upper, 15);
}

// A grid of friction and peak acceleration has each multiplier as often as there are peaks: the more peaks,
// the smaller was the standard error.
TEST(DistributionStatistic, OfAGridHasNoIntervals)
{
    SampleTable table = tableOf({1, 1, 1, 2, 2, 2}, {3, 3, 3, 5, 5, 5});
    table.isGrid = true;
    const StatisticResult result = evaluated("type distribution; value y; fractiles (0.5);", table);
    EXPECT_EQ(rowOf(result, "mean").value, 4);
    for (const char* row : {"mean", "fractile0.5", "lognormalMedian", "lognormalBeta"})
    {
        EXPECT_TRUE(std::isnan(rowOf(result, row).lower)) << row;
        EXPECT_TRUE(std::isnan(rowOf(result, row).upper)) << row;
    }
    EXPECT_TRUE(std::isnan(rowOf(result, "mean").standardError));
    EXPECT_TRUE(std::isnan(rowOf(result, "lognormalMedian").standardError));
    EXPECT_THAT(result.remarks, testing::Contains(HasSubstr("chosen and not drawn")));
}

// The runs of a point of sensitivity are as good as one sample.
TEST(DistributionStatistic, OfSensitivityCountsPoints)
{
    std::vector<double> values;
    for (int point = 0; point < 25; ++point)
    {
        values.insert(values.end(), 4, point);
    }
    SampleTable table = tableOf(values, values);
    table.sensitivityRuns = 4;
    const StatisticResult result = evaluated("type distribution; value y;", table);
    const StatisticRow mean = rowOf(result, "mean");
    EXPECT_NEAR(mean.standardError, rowOf(result, "standardDeviation").value / 5, 1e-12);
    EXPECT_THAT(result.remarks, testing::Contains(HasSubstr("25 independent samples")));
}

TEST(SensitivityStatistic, OfIshigamisFunctionIsTheClosedForm)
{
    // Ishigami and Homma 1990: sin x1 + 7 sin^2 x2 + 0.1 x3^4 sin x1 on (-pi, pi).
    SampleTable table;
    table.names = {"x1", "x2", "x3", "y"};
    table.variables = 3;
    table.columns.resize(4);
    table.sensitivityRuns = 5;
    constexpr std::uint64_t points = 8192;
    for (std::uint64_t i = 0; i < points; ++i)
    {
        double a[3];
        double b[3];
        for (std::uint32_t k = 0; k < 3; ++k)
        {
            a[k] = std::numbers::pi * (2 * uniform(1, Stream::sample, k, i) - 1);
            b[k] = std::numbers::pi * (2 * uniform(1, Stream::second, k, i) - 1);
        }
        for (int role = 0; role < 5; ++role)
        {
            double x[3];
            for (int k = 0; k < 3; ++k)
            {
                x[k] = role == 1 || role == k + 2 ? b[k] : a[k];
                table.columns[static_cast<std::size_t>(k)].push_back(x[k]);
            }
            table.columns[3].push_back(std::sin(x[0]) + 7 * std::pow(std::sin(x[1]), 2)
                                       + 0.1 * std::pow(x[2], 4) * std::sin(x[0]));
            table.isFailed.push_back(0);
        }
    }
    table.requested = 5 * points;
    const StatisticResult result = evaluated("type sensitivity; value y; bootstrap 50;", table);
    const double first[3] = {0.313905, 0.442411, 0};
    const double total[3] = {0.557589, 0.442411, 0.243684};
    for (int k = 0; k < 3; ++k)
    {
        const StatisticRow one = rowOf(result, "first_x" + std::to_string(k + 1));
        const StatisticRow all = rowOf(result, "total_x" + std::to_string(k + 1));
        EXPECT_NEAR(one.value, first[k], 5 * one.standardError);
        EXPECT_NEAR(all.value, total[k], 5 * all.standardError);
        EXPECT_LT(one.standardError, 0.02);
    }
    table.isFailed[7] = 1;
    EXPECT_EQ(rowOf(evaluated("type sensitivity; value y; bootstrap 0;", table), "pointsLeftOut").value, 1);
    table.sensitivityRuns = 0;
    EXPECT_THROW(evaluated("type sensitivity; value y;", table), FatalIOError);
}

/// Points of two variables, each with the values at A, at B, and at A with one variable from B.
SampleTable sensitivityTable(const std::vector<double>& values)
{
    SampleTable table = tableOf(values, values);
    table.sensitivityRuns = 3;
    return table;
}

TEST(SensitivityStatistic, OfAValueThatIsTheSameEverywhereHasNoIndices)
{
    // 0.1 has a mean that differs from it by rounding.
    const StatisticResult result =
        evaluated("type sensitivity; value y;", sensitivityTable(std::vector<double>(30, 0.1)));
    EXPECT_THAT(result.remarks, testing::Contains(HasSubstr("The value is 0.1 in all samples")));
    EXPECT_TRUE(result.pictures.empty());
    EXPECT_EQ(result.rows.size(), 2u);
}

TEST(SensitivityStatistic, LeavesOutPointsDrawnAgainThatDoNotScatter)
{
    // Of three points one differs: nearly a third of what is drawn again has no variance.
    const StatisticResult result =
        evaluated("type sensitivity; value y; bootstrap 100;", sensitivityTable({0, 0, 0, 0, 0, 0, 1, 0, 0}));
    const StatisticRow total = rowOf(result, "total_x");
    EXPECT_TRUE(std::isfinite(total.value));
    EXPECT_TRUE(std::isfinite(total.standardError));
    EXPECT_TRUE(std::isfinite(total.lower) && std::isfinite(total.upper));
}

TEST(FractilesStatistic, AreThoseOfStraightCurves)
{
    // Curve k: response = k intensity, k = 1 .. 5, at 0.5, 1 and 2.
    SampleTable table = tableOf({}, {});
    for (int curve = 1; curve <= 5; ++curve)
    {
        for (const double intensity : {0.5, 1.0, 2.0})
        {
            table.columns[0].push_back(intensity);
            table.columns[1].push_back(curve * intensity);
            table.texts[0].push_back(std::to_string(curve));
            table.isFailed.push_back(0);
        }
    }
    const StatisticResult result = evaluated(
        "type fractiles; intensity x; response y; curve x; fractiles (0.5); levels (1.5 9);", table);
    ASSERT_EQ(result.table.rows.size(), 3u);
    EXPECT_DOUBLE_EQ(result.table.rows[1][1], 3);
    EXPECT_NEAR(rowOf(result, "xAty1.5Fractile0.5").value, 0.5, 1e-12);
    EXPECT_TRUE(std::isinf(rowOf(result, "xAty9Fractile0.5").value)); // only the steepest one reaches it
    EXPECT_FALSE(plotSvg(result.pictures.front().second).empty());
}

// Where it is a result, a sample that failed has none.
TEST(FractilesStatistic, LeavesOutSamplesWithoutAnIntensity)
{
    SampleTable table = tableOf({1, std::nan(""), 2, 3}, {10, std::nan(""), 20, 30});
    table.texts[0] = {"a", "a", "a", "a"};
    table.isFailed[1] = 1;
    const StatisticResult result = evaluated(
        "type fractiles; intensity x; response y; curve x; fractiles (0.5); levels (5 15 25);", table);
    ASSERT_EQ(result.table.rows.size(), 3u);
    EXPECT_DOUBLE_EQ(result.table.rows[0][1], 10);
    EXPECT_NEAR(rowOf(result, "xAty5Fractile0.5").value, 0.5, 1e-12);
    EXPECT_NEAR(rowOf(result, "xAty15Fractile0.5").value, 1.5, 1e-12);
    EXPECT_NEAR(rowOf(result, "xAty25Fractile0.5").value, 2.5, 1e-12);
    EXPECT_THAT(result.remarks, testing::Contains(HasSubstr("1 samples without x are left out")));
}

TEST(FragilityStatistic, LeavesOutSamplesWithoutAnIntensity)
{
    const double none = std::nan("");
    SampleTable table = tableOf({1, 1, 2, 2, none, 3, 3}, {0, 1, 0, 1, none, 1, 1});
    table.isFailed[4] = 1;
    const StatisticResult result =
        evaluated("type fragility; intensity x; exceeded \"y > 0.5\"; bootstrap 0;", table);
    const StatisticResult others =
        evaluated("type fragility; intensity x; exceeded \"y > 0.5\"; bootstrap 0;",
                  tableOf({1, 1, 2, 2, 3, 3}, {0, 1, 0, 1, 1, 1}));
    EXPECT_EQ(rowOf(result, "theta").value, rowOf(others, "theta").value);
    EXPECT_EQ(rowOf(result, "failed").value, 1);
    EXPECT_THAT(result.remarks, testing::Contains(HasSubstr("1 samples without x are left out")));
}

TEST(FragilityStatistic, LeavesOutSamplesOfInfiniteIntensity)
{
    const char* statistic = "type fragility; intensity x; exceeded \"y > 0.5\"; bootstrap 0;";
    const StatisticResult result =
        evaluated(statistic, tableOf({1, 1, 2, 2, HUGE_VAL, 3, 3}, {0, 1, 0, 1, 0, 1, 1}));
    const StatisticResult others = evaluated(statistic, tableOf({1, 1, 2, 2, 3, 3}, {0, 1, 0, 1, 1, 1}));
    EXPECT_EQ(rowOf(result, "theta").value, rowOf(others, "theta").value);
    EXPECT_THAT(result.remarks, testing::Contains(HasSubstr("1 samples without x are left out")));
}

TEST(Fractile, InterpolatesAndKeepsInfinity)
{
    EXPECT_DOUBLE_EQ(fractile({1, 2, 4}, 0.75), 3);
    EXPECT_EQ(fractile({5}, 0.3), 5);
    EXPECT_TRUE(std::isinf(fractile({1, HUGE_VAL, HUGE_VAL}, 0.75)));
}
