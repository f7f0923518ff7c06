// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Samples of ensembles: the generator, distributions, designs, correlations.
#include "../ReportOf.h"
#include "core/Error.h"
#include "ensembles/NatafCorrelation.h"
#include "ensembles/Philox.h"
#include "ensembles/SampleTable.h"
#include "ensembles/Sampler.h"
#include "ensembles/SobolSequence.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <numeric>
#include <set>

using namespace drystone;
using testing::HasSubstr;

namespace
{

Distribution distributionOf(const std::string& text)
{
    return distributionTypes().select(Dictionary::readString(text, "system/ensembleDict"));
}

struct Sampled
{
    std::vector<Named<EnsembleVariable>> variables;
    std::vector<Correlation> correlations;
    Design design;
};
void declare(Options& options, Sampled& sampled)
{
    options.required("variables", sampled.variables, "");
    options.optional("correlations", sampled.correlations, "");
    options.required("design", sampled.design, designTypes(), "");
}

Sampler samplerOf(const std::string& text)
{
    const Dictionary dictionary = Dictionary::readString(text, "system/ensembleDict");
    const auto sampled = readOptions<Sampled>(dictionary);
    return {sampled.variables, sampled.correlations, sampled.design, dictionary, "."};
}

std::string variables(const std::vector<std::string>& distributions)
{
    std::string text = "variables {";
    for (std::size_t k = 0; k < distributions.size(); ++k)
    {
        text += " v" + std::to_string(k) + " { file a; entry e" + std::to_string(k) + "; distribution {"
                + distributions[k] + "} }";
    }
    return text + " } ";
}

/// Linear correlation of two variables over all samples.
double correlationOf(const Sampler& sampler)
{
    const auto count = static_cast<double>(sampler.size());
    double sums[5] = {};
    for (long i = 0; i < sampler.size(); ++i)
    {
        const auto values = sampler.at(i);
        const double x = values[0].number;
        const double y = values[1].number;
        const double terms[5] = {x, y, x * x, y * y, x * y};
        for (int k = 0; k < 5; ++k)
        {
            sums[k] += terms[k] / count;
        }
    }
    return (sums[4] - sums[0] * sums[1])
           / std::sqrt((sums[2] - sums[0] * sums[0]) * (sums[3] - sums[1] * sums[1]));
}

} // namespace

TEST(Philox, GivesThePublishedNumbers)
{
    // kat_vectors of Random123 (Salmon et al.)
    using Words = std::array<std::uint32_t, 4>;
    EXPECT_EQ(philox({0, 0, 0, 0}, {0, 0}), (Words{0x6627e8d5, 0xe169c58d, 0xbc57ac4c, 0x9b00dbd8}));
    EXPECT_EQ(philox({~0u, ~0u, ~0u, ~0u}, {~0u, ~0u}),
              (Words{0x408f276d, 0x41c83b0e, 0xa20bc7c6, 0x6d5451fd}));
    EXPECT_EQ(philox({0x243f6a88, 0x85a308d3, 0x13198a2e, 0x03707344}, {0xa4093822, 0x299f31d0}),
              (Words{0xd16cfe09, 0x94fdcceb, 0x5001e420, 0x24126ea1}));
}

TEST(Philox, IsUniformAndDifferentInEachStream)
{
    double mean = 0;
    double square = 0;
    double product = 0;
    constexpr int count = 100000;
    for (std::uint64_t i = 0; i < count; ++i)
    {
        const double u = uniform(7, Stream::sample, 3, i);
        mean += u / count;
        square += u * u / count;
        product += u * uniform(7, Stream::second, 3, i) / count;
    }
    EXPECT_NEAR(mean, 0.5, 4 * std::sqrt(1.0 / 12 / count));
    EXPECT_NEAR(square, 1.0 / 3, 4 * std::sqrt(4.0 / 45 / count));
    EXPECT_NEAR(product, 0.25, 4 * std::sqrt(7.0 / 144 / count));
    EXPECT_GT(uniform(0), 0);
    EXPECT_LT(uniform(~std::uint64_t{0}), 1);
}

TEST(Philox, PermutesAllOfTheNumbers)
{
    const auto order = permutation(3, 1, 1000);
    EXPECT_EQ(std::set<std::uint32_t>(order.begin(), order.end()).size(), 1000u);
    EXPECT_EQ(*std::max_element(order.begin(), order.end()), 999u);
    EXPECT_NE(order, permutation(3, 2, 1000));
}

TEST(Distribution, HasItsQuantiles)
{
    const auto at = [](const std::string& text, double probability)
    { return valueAt(distributionOf(text), probability).number; };
    EXPECT_NEAR(at("type normal; mean 2; standardDeviation 0.5;", 0.975), 2 + 0.5 * 1.959963984540054, 1e-14);
    EXPECT_NEAR(at("type lognormal; median 0.65; beta 0.15;", 0.5), 0.65, 1e-15);
    EXPECT_NEAR(at("type lognormal; median 0.65; beta 0.15;", 0.025),
                0.65 * std::exp(-0.15 * 1.959963984540054), 1e-14);
    EXPECT_DOUBLE_EQ(at("type uniform; minimum 1; maximum 3;", 0.25), 1.5);
    EXPECT_NEAR(at("type beta; alpha 2; beta 1; minimum 0; maximum 1;", 0.25), 0.5, 1e-12); // sqrt(u)
    EXPECT_NEAR(at("type beta; alpha 1; beta 3; minimum 2; maximum 4;", 0.488), 2.4,
                1e-12); // 1 - (1-u)^(1/3)
}

TEST(Distribution, IsTruncatedAtItsLimits)
{
    // Of a normal distribution above its mean the median is at 0.75.
    for (const std::string text :
         {"type normal; mean 1; standardDeviation 2; minimum 1;",
          "type truncated; of { type normal; mean 1; standardDeviation 2; } minimum 1; "
          "maximum 100;"})
    {
        EXPECT_NEAR(valueAt(distributionOf(text), 0.5).number, 1 + 2 * 0.674489750196082, 1e-9) << text;
        EXPECT_GE(valueAt(distributionOf(text), 1e-15).number, 1) << text;
    }
    EXPECT_THROW(distributionOf("type normal; mean 0; standardDeviation 1; minimum 9;"), FatalIOError);
    EXPECT_THROW(distributionOf("type lognormal; median 1; beta 1; minimum 2; maximum 1;"), FatalIOError);
    EXPECT_THROW(distributionOf("type truncated; of { type list; values (1 2); } minimum 1; maximum 2;"),
                 FatalIOError);
}

TEST(Distribution, ChoosesValuesByTheirWeights)
{
    const Distribution list = distributionOf("type list; values (\"a.AT2\" -0.5 b);");
    EXPECT_EQ(valueAt(list, 0.1).text, "a.AT2");
    EXPECT_EQ(valueAt(list, 0.5).number, -0.5);
    EXPECT_EQ(valueAt(list, 0.99).text, "b");
    const Distribution discrete = distributionOf("type discrete; values (1 2 3); weights (1 2 1);");
    EXPECT_EQ(valueAt(discrete, 0.24).number, 1);
    EXPECT_EQ(valueAt(discrete, 0.26).number, 2);
    EXPECT_EQ(valueAt(discrete, 0.76).number, 3);
    EXPECT_THROW(distributionOf("type discrete; values (1 2 3); weights (1 2);"), FatalIOError);
    EXPECT_THROW(distributionOf("type list; values ();"), FatalIOError);
}

TEST(Distribution, OfBetaHasItsQuantilesHoweverNarrowItIs)
{
    const auto at = [](const std::string& parameters, double probability)
    { return valueAt(distributionOf("type beta; minimum 0; maximum 1; " + parameters), probability).number; };
    // SciPy's; GSL's inverse does not converge.
    EXPECT_NEAR(at("alpha 5000; beta 90000;", 0.001), 0.0504196591349910, 1e-13);
    EXPECT_NEAR(at("alpha 2000; beta 2000;", 1 - 1e-6), 0.5375284500258365, 1e-13);
    // Of small shapes the smallest part is u = x^alpha / (alpha B(alpha, beta)).
    EXPECT_NEAR(at("alpha 0.01; beta 1;", 0.5) / std::pow(0.5, 100), 1, 1e-10);
    EXPECT_EQ(at("alpha 0.001; beta 3;", 1e-3) < 1e-300, true);
    EXPECT_NEAR(at("alpha 3; beta 0.001;", 0.5), 1, 1e-15);
    EXPECT_THROW(at("alpha 1e300; beta 1e300;", 0.5), FatalIOError);
}

TEST(Distribution, QuestionsWordsAmongNumbers)
{
    const auto warningOf = [](const std::string& text)
    {
        testing::internal::CaptureStderr();
        distributionOf(text);
        return testing::internal::GetCapturedStderr();
    };
    EXPECT_THAT(warningOf("type list;\nvalues (0.3 \"0,4\" 0.5);"),
                testing::AllOf(HasSubstr("`0,4` is a word among numbers"), HasSubstr("values at line 2.")));
    EXPECT_THAT(warningOf("type discrete; values (O.1 2); weights (1 1);"), HasSubstr("`O.1` is a word"));
    EXPECT_EQ(warningOf("type list; values (a.AT2 b.AT2);"), "");
    EXPECT_EQ(warningOf("type list; values (0.3 -4e-1 0.5);"), "");
}

TEST(Sobol, FillsEachOfThePartsOfEachDimensionOnce)
{
    for (int dimension = 0; dimension < sobolDimensions; ++dimension)
    {
        std::set<std::uint32_t> parts;
        for (std::uint32_t i = 0; i < 1024; ++i)
        {
            parts.insert(sobolBits(i, dimension) >> 22);
        }
        EXPECT_EQ(parts.size(), 1024u) << dimension;
    }
    // The first two dimensions are a net: one of 2^k points in each rectangle of area 2^-k.
    for (int rows = 0; rows <= 8; ++rows)
    {
        std::set<std::pair<std::uint32_t, std::uint32_t>> boxes;
        for (std::uint32_t i = 0; i < 256; ++i)
        {
            boxes.insert({rows == 0 ? 0 : sobolBits(i, 0) >> (32 - rows),
                          rows == 8 ? 0 : sobolBits(i, 1) >> (24 + rows)});
        }
        EXPECT_EQ(boxes.size(), 256u) << rows;
    }
}

TEST(Sobol, IntegratesBetterThanRandomPoints)
{
    // The product of |4 u - 2| has the mean 1; 20,000 random points would miss it by some 0.1 in ten
    // dimensions.
    double mean = 0;
    constexpr std::uint32_t count = 1u << 15;
    for (std::uint32_t i = 0; i < count; ++i)
    {
        double product = 1;
        for (int k = 0; k < 10; ++k)
        {
            product *= 1 + (std::abs(4 * (sobolBits(i, k) + 0.5) * 0x1p-32 - 2) - 1) / (k + 1);
        }
        mean += product / count;
    }
    EXPECT_NEAR(mean, 1, 1e-3);
}

TEST(Sampler, OfALatinHypercubeTakesEachPartOnce)
{
    const Sampler sampler =
        samplerOf(variables({"type uniform; minimum 0; maximum 1;", "type uniform; minimum 0; maximum 1;"})
                  + "design { type latinHypercube; samples 500; seed 4; }");
    ASSERT_EQ(sampler.size(), 500);
    std::set<int> parts[2];
    for (long i = 0; i < 500; ++i)
    {
        const auto values = sampler.at(i);
        parts[0].insert(static_cast<int>(values[0].number * 500));
        parts[1].insert(static_cast<int>(values[1].number * 500));
    }
    EXPECT_EQ(parts[0].size(), 500u);
    EXPECT_EQ(parts[1].size(), 500u);
    EXPECT_LT(std::abs(correlationOf(sampler)), 0.15);
}

TEST(Sampler, OfMoreSamplesHasTheSameFirstOnes)
{
    for (const std::string type : {"random", "sobol"})
    {
        const std::string text = variables({"type normal; mean 0; standardDeviation 1;", "type seed;"});
        const Sampler few = samplerOf(text + "design { type " + type + "; samples 10; seed 4; }");
        const Sampler many = samplerOf(text + "design { type " + type + "; samples 1000; seed 4; }");
        const Sampler other = samplerOf(text + "design { type " + type + "; samples 10; seed 5; }");
        for (long i = 0; i < 10; ++i)
        {
            EXPECT_EQ(few.at(i)[0].text, many.at(i)[0].text);
            EXPECT_EQ(few.at(i)[1].text, many.at(i)[1].text);
            EXPECT_NE(few.at(i)[0].text, other.at(i)[0].text);
        }
    }
}

TEST(Sampler, OfAGridHasAllCombinationsAndASeedOfEachRepeat)
{
    const Sampler sampler =
        samplerOf(variables({"type list; values (0.1 0.2 0.4);", "type list; values (a b);",
                             "type uniform; minimum 0; maximum 1;", "type seed;"})
                  + "design { type grid; levels 2; repeats 3; }");
    ASSERT_EQ(sampler.size(), 36);
    std::set<std::string> points;
    std::set<std::string> seeds;
    for (long i = 0; i < 36; ++i)
    {
        const auto values = sampler.at(i);
        points.insert(values[0].text + values[1].text + values[2].text);
        seeds.insert(values[3].text);
    }
    EXPECT_EQ(points.size(), 12u);
    EXPECT_EQ(seeds.size(), 36u);
    EXPECT_EQ(sampler.at(3)[2].number, 0.75); // the last variable with levels changes first
}

TEST(Sampler, OfSensitivityReplacesOneVariableAfterTheOther)
{
    const Sampler sampler =
        samplerOf(variables({"type uniform; minimum 0; maximum 1;", "type uniform; minimum 0; maximum 1;"})
                  + "design { type sobol; samples 8; sensitivity yes; }");
    ASSERT_EQ(sampler.size(), 32);
    const auto a = sampler.at(4);
    const auto b = sampler.at(5);
    EXPECT_EQ(sampler.at(6)[0].number, b[0].number);
    EXPECT_EQ(sampler.at(6)[1].number, a[1].number);
    EXPECT_EQ(sampler.at(7)[0].number, a[0].number);
    EXPECT_EQ(sampler.at(7)[1].number, b[1].number);
    EXPECT_NE(a[0].number, b[0].number);
}

TEST(Nataf, AgreesWithTheClosedForms)
{
    const Distribution lognormal = distributionOf("type lognormal; median 2; beta 0.8;");
    const Distribution narrow = distributionOf("type lognormal; median 0.1; beta 0.3;");
    const double v1 = std::sqrt(std::expm1(0.8 * 0.8));
    const double v2 = std::sqrt(std::expm1(0.3 * 0.3));
    for (const double wanted : {-0.4, 0.3, 0.8})
    {
        EXPECT_NEAR(*natafCorrelation(lognormal, narrow, wanted), std::log1p(wanted * v1 * v2) / (0.8 * 0.3),
                    1e-8);
    }
    const Distribution uniformOne = distributionOf("type uniform; minimum -3; maximum 1;");
    EXPECT_NEAR(*natafCorrelation(uniformOne, uniformOne, 0.5), 2 * std::sin(std::numbers::pi * 0.5 / 6),
                1e-5);
    // Two lognormal variables cannot be correlated by -0.9.
    EXPECT_FALSE(natafCorrelation(lognormal, lognormal, -0.9));
}

TEST(Nataf, CorrelatesTheSamples)
{
    const Sampler sampler = samplerOf(
        variables({"type lognormal; median 0.65; beta 0.3;", "type uniform; minimum 0.3; maximum 0.5;"})
        + "correlations ((v0 v1 0.6)); design { type sobol; samples 16384; }");
    EXPECT_NEAR(correlationOf(sampler), 0.6, 0.01);
}

TEST(Nataf, OfStepsAgreesWithTheClosedForms)
{
    const Distribution coin = distributionOf("type list; values (0 1);");
    const Distribution normal = distributionOf("type normal; mean 3; standardDeviation 2;");
    for (const double wanted : {-0.8, 0.3, 0.8, 0.98})
    {
        EXPECT_NEAR(*natafCorrelation(coin, coin, wanted), std::sin(std::numbers::pi / 2 * wanted), 1e-8);
    }
    EXPECT_NEAR(*natafCorrelation(coin, normal, 0.7), 0.7 * std::sqrt(2 * std::numbers::pi) / 2, 1e-8);
}

TEST(Nataf, CorrelatesStepsOfAnyWeights)
{
    for (const char* distribution :
         {"type discrete; values (1 7); weights (95 5);", "type list; values (1 2 3 4 5);"})
    {
        const Sampler sampler =
            samplerOf(variables({distribution, distribution})
                      + "correlations ((v0 v1 0.8)); design { type sobol; samples 16384; }");
        EXPECT_NEAR(correlationOf(sampler), 0.8, 0.01) << distribution;
    }
}

TEST(Sampler, OfACorrelatedLatinHypercubeTakesEachPartOfEachVariableOnce)
{
    constexpr long samples = 200;
    const std::string uniformOne = "type uniform; minimum 0; maximum 1;";
    const Sampler sampler = samplerOf(variables({uniformOne, uniformOne, uniformOne})
                                      + "correlations ((v0 v1 0.5) (v1 v2 -0.3)); "
                                        "design { type latinHypercube; samples 200; }");
    for (std::size_t k = 0; k < 3; ++k)
    {
        std::set<long> parts;
        for (long sample = 0; sample < samples; ++sample)
        {
            parts.insert(static_cast<long>(samples * sampler.at(sample)[k].number));
        }
        EXPECT_EQ(parts.size(), samples) << k;
    }
    EXPECT_NEAR(correlationOf(sampler), 0.5, 0.1);
}

TEST(Sampler, RefusesWhatIsImpossible)
{
    const auto faultOf = [](const std::string& text) { return reportOf([&] { samplerOf(text); }); };
    const std::string two =
        variables({"type uniform; minimum 0; maximum 1;", "type uniform; minimum 0; maximum 1;"});
    const std::string design = "design { type random; samples 5; }";
    EXPECT_THAT(faultOf(two + "correlations ((v0 v2 0.5));" + design), HasSubstr("Unknown variable v2"));
    EXPECT_THAT(faultOf(two + "correlations ((v0 v0 0.5));" + design), HasSubstr("cannot be correlated"));
    EXPECT_THAT(faultOf(two + "correlations ((v0 v1 2));" + design),
                HasSubstr("cannot have the correlation"));
    EXPECT_THAT(faultOf(two + "correlations ((v0 v1 0.5) (v1 v0 -0.3));" + design),
                HasSubstr("two correlations of v1 and v0: remove one"));
    EXPECT_THAT(faultOf(variables({"type list; values (3);", "type list; values (3 4);"})
                        + "correlations ((v0 v1 0.5));" + design),
                HasSubstr("more than one each"));
    EXPECT_THAT(faultOf(two + "correlations ((v0 v1 0.5)); design { type grid; }"), HasSubstr("drawn"));
    EXPECT_THAT(faultOf("variables { v { file a; entry b; } } " + design), HasSubstr("no distribution"));
    EXPECT_THAT(faultOf(two + "design { type table; file nowhere; }"), HasSubstr("no table"));
    EXPECT_THAT(faultOf(two + "design { type randm; samples 5; }"), HasSubstr("Did you mean random?"));
    EXPECT_EQ(faultOf(two + design), "no error");
}

// A file of Excel, pandas or NumPy was said to have no column, and to have none at all.
TEST(Sampler, ATableMayHaveCommasAndAFirstLineOfTitles)
{
    const std::filesystem::path folder =
        std::filesystem::temp_directory_path() / ("drystoneSampleTable" + std::to_string(getpid()));
    std::filesystem::create_directories(folder);
    const auto two = readOptions<Sampled>(Dictionary::readString(
        variables({"type uniform; minimum 0; maximum 1;", "type uniform; minimum 0; maximum 1;"})
            + "design { type table; file t; }",
        "system/ensembleDict"));
    const auto rowsOf = [&](const std::string& text)
    {
        std::ofstream(folder / "t") << text;
        std::string result;
        for (const std::vector<SampleValue>& row : readSampleTable(two.design, two.variables, folder))
        {
            result += row[0].text + "|" + row[1].text + " ";
        }
        return result;
    };
    for (const char* text :
         {"# v1 n v0\n2 7 1\n4 8 3\n", "v1 n v0\n2 7 1\n\n4 8 3\n", "v1,n,v0\n2,7,1\n4,,3\n",
          "\xEF\xBB\xBFv1;n;v0\r\n2;7;1\r\n\r\n4;8;3", "# by us, 2024\n# v1 n v0\n2 7 1\n# a,b\n4 8 3\n",
          "# v1, n, v0[-]\n2, 7, 1\n4, 8, 3\n"})
    {
        EXPECT_EQ(rowsOf(text), "1|2 3|4 ") << text;
    }
    EXPECT_EQ(rowsOf("# v1 v0\n\"b 2.dxf\" a.dxf\n"), "a.dxf|b 2.dxf ");
    EXPECT_THROW(rowsOf("v1,v0\n2,1,7\n"), FatalIOError);
    try
    {
        rowsOf("1 2\n3 4\n");
        ADD_FAILURE() << "a table without titles was refused";
    }
    catch (const FatalIOError& error)
    {
        EXPECT_THAT(error.what(), testing::AllOf(HasSubstr("no column v0"), HasSubstr("first line"),
                                                 HasSubstr("Its columns: 1 2")));
    }
    std::filesystem::remove_all(folder);
}

TEST(Sampler, ValuesSpreadOverTheRangesDependOnNeitherDesignNorSize)
{
    const std::string two =
        variables({"type uniform; minimum 0; maximum 1;", "type uniform; minimum 0; maximum 1;"});
    const auto spread = samplerOf(two + "design { type latinHypercube; samples 10; seed 1; }").spread(16);
    const auto other = samplerOf(two + "design { type random; samples 77; seed 5; }").spread(16);
    ASSERT_EQ(spread.size(), 16U);
    for (std::size_t variable = 0; variable < 2; ++variable)
    {
        std::set<int> eighths; // none of them is left out
        for (std::size_t i = 0; i < spread.size(); ++i)
        {
            EXPECT_EQ(spread[i][variable].number, other[i][variable].number);
            eighths.insert(static_cast<int>(8 * spread[i][variable].number));
        }
        EXPECT_EQ(eighths.size(), 8U);
    }
}
