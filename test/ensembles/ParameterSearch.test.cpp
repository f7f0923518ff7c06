// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The search itself, on functions in place of cases.
#include "ensembles/ParameterSearch.h"

#include "../ReportOf.h"
#include "core/Error.h"
#include "ensembles/CaseRuns.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fmt/format.h>

#include <cmath>
#include <fstream>

using namespace drystone;
using testing::DoubleNear;
using testing::ElementsAre;
using testing::HasSubstr;

namespace
{

/// Variables x and y from -1 to 2, and one result, f.
ParameterSearchSettings settingsOf(const std::string& rest, int variables = 2)
{
    std::string text = "applications (limitAnalysis); variables { x { file a; entry x; bounds (-1 2); }";
    if (variables == 2)
    {
        text += " y { file a; entry y; bounds (-1 2); }";
    }
    return readSearchSettings(Dictionary::readString(
        text + "} results { f { table t; column f; } } seed 7;" + rest, "system/parameterSearchDict"));
}

using Function = std::function<double(const std::vector<double>&)>;

double bowl(const std::vector<double>& at)
{
    return std::pow(at[0] - 0.7, 2) + 2 * std::pow(at[1] + 0.3, 2) + 0.5 * at[0] * at[1] + 1;
}
// Its gradient vanishes where 2 (x - 0.7) + 0.5 y = 0 and 4 (y + 0.3) + 0.5 x = 0.
const double bowlX = (1.4 * 4 + 0.5 * 1.2) / (2 * 4 - 0.25);
const double bowlY = -(1.2 + 0.5 * bowlX) / 4;

SearchOutcome search(const ParameterSearchSettings& settings, const Function& function,
                     std::vector<std::vector<double>>* asked = nullptr, std::size_t most = 1000000)
{
    std::size_t count = 0;
    return searchBest(settings, std::vector<double>(settings.variables.size(), 1.5),
                      [&](const std::vector<double>& at) -> std::optional<Evaluation>
                      {
                          if (count++ == most)
                          {
                              return {};
                          }
                          if (asked)
                          {
                              asked->push_back(at);
                          }
                          return evaluate(settings, at, {function(at)});
                      });
}

} // namespace

TEST(ParameterSearch, EveryAlgorithmFindsTheLeastValueOfABowl)
{
    for (const auto& [name, algorithm] : namesOf(SearchAlgorithm()))
    {
        if (algorithm == SearchAlgorithm::bisection)
        {
            continue;
        }
        const bool isLocal = !isGlobal(algorithm);
        const auto settings = settingsOf(fmt::format(
            "objective {{ goal minimise; value f; }} search ( {{ algorithm {}; maximumEvaluations {}; "
            "tolerance 1e-7; }} );",
            name, isLocal ? 2000 : 3000));
        const SearchOutcome outcome = search(settings, bowl);
        ASSERT_TRUE(outcome.best) << name;
        const double tolerance = isLocal ? 1e-4 : 0.1;
        EXPECT_THAT(outcome.best->variables,
                    ElementsAre(DoubleNear(bowlX, tolerance), DoubleNear(bowlY, tolerance)))
            << name;
        EXPECT_EQ(outcome.end, isLocal ? SearchEnd::converged : SearchEnd::evaluations) << name;
    }
}

TEST(ParameterSearch, ASequenceGoesOnFromTheBestPointAndMaximisesAsWell)
{
    // Two hills; the higher one is the one further from the start.
    const auto settings = settingsOf("objective { goal maximise; value \"f + 1\"; } search ( { algorithm "
                                     "DIRECT_L; maximumEvaluations 60; }"
                                     "{ algorithm BOBYQA; tolerance 1e-8; } );");
    const SearchOutcome outcome =
        search(settings,
               [](const std::vector<double>& at)
               {
                   const auto hill = [&](double x, double y)
                   { return std::exp(-4 * (std::pow(at[0] - x, 2) + std::pow(at[1] - y, 2))); };
                   return hill(1.5, 1.5) + 1.5 * hill(-0.5, -0.4);
               });
    EXPECT_EQ(outcome.end, SearchEnd::converged);
    EXPECT_THAT(outcome.best->variables, ElementsAre(DoubleNear(-0.5, 1e-4), DoubleNear(-0.4, 1e-4)));
    EXPECT_NEAR(outcome.best->objective, 2.5, 1e-6);
    ASSERT_EQ(outcome.stages.size(), 2u);
    EXPECT_EQ(outcome.stages[0].second, 60);
}

TEST(ParameterSearch, ABowlInOneVariableIsWithinReachOfAllLocalAlgorithms)
{
    for (const char* name : {"BOBYQA", "COBYLA", "SBPLX", "NELDERMEAD"})
    {
        const auto settings = settingsOf(
            fmt::format(
                "objective {{ goal minimise; value f; }} search ( {{ algorithm {}; tolerance 1e-8; }} );",
                name),
            1);
        const SearchOutcome outcome =
            search(settings, [](const std::vector<double>& at) { return std::pow(at[0] - 0.25, 2); });
        EXPECT_EQ(outcome.end, SearchEnd::converged) << name;
        EXPECT_NEAR(outcome.best->variables[0], 0.25, 1e-6) << name;
    }
}

TEST(ParameterSearch, TheBestPointMeetsTheConstraints)
{
    // The least distance from the origin of x + y >= 1 is at (0.5, 0.5).
    for (const char* searchText :
         {"{ algorithm COBYLA; tolerance 1e-9; }",
          "{ algorithm DIRECT_L; maximumEvaluations 300; } { algorithm COBYLA; tolerance 1e-9; }",
          "{ algorithm ISRES; maximumEvaluations 4000; } { algorithm COBYLA; tolerance 1e-9; }"})
    {
        const auto settings = settingsOf(fmt::format(
            "objective {{ goal minimise; value f; }} constraints {{ far {{ value \"x + y\"; atLeast 1; }} "
            "left {{ value x; atMost 0.5; }} }} search ( {} );",
            searchText));
        const SearchOutcome outcome =
            search(settings, [](const std::vector<double>& at) { return at[0] * at[0] + at[1] * at[1]; });
        EXPECT_EQ(outcome.end, SearchEnd::converged);
        EXPECT_EQ(outcome.best->violation, 0);
        EXPECT_THAT(outcome.best->variables, ElementsAre(DoubleNear(0.5, 1e-4), DoubleNear(0.5, 1e-4)));
    }
}

TEST(ParameterSearch, ConstraintsThatNothingMeetsLeaveThePointNearestToThem)
{
    const auto settings =
        settingsOf("objective { goal minimise; value f; } constraints { impossible { value \"x + y\"; "
                   "atLeast 5; } } search ( { algorithm COBYLA; } );");
    const SearchOutcome outcome = search(settings, bowl);
    ASSERT_TRUE(outcome.best);
    EXPECT_NEAR(outcome.best->violation, 1, 1e-5); // both at their upper bounds
    EXPECT_THAT(outcome.best->variables, ElementsAre(DoubleNear(2, 1e-5), DoubleNear(2, 1e-5)));
}

TEST(ParameterSearch, ASearchThatIsMisledByAPlateauDoesNotCallItselfConverged)
{
    // A model of the constraint learns nothing where it is -0.1 throughout.
    const auto settings =
        settingsOf("objective { goal minimise; value x; } constraints { stands { value f; atLeast "
                   "0; } } search ( { algorithm COBYLA; } );",
                   1);
    const double border = -0.32;
    const SearchOutcome outcome = searchBest(
        settings, {border + 1e-4},
        [&](const std::vector<double>& at)
        { return std::optional(evaluate(settings, at, {at[0] < border ? -0.1 : 0.3 * (at[0] - border)})); });
    EXPECT_EQ(outcome.end, SearchEnd::astray);
    EXPECT_EQ(outcome.best->violation, 0);
}

TEST(ParameterSearch, BisectionFindsWhereConstraintsEndToHoldFromEitherSide)
{
    const double border = 0.3217;
    for (const bool isLow : {true, false})
    {
        const auto settings = settingsOf(fmt::format("objective {{ goal {}; value x; }} constraints {{ "
                                                     "stands {{ value f; atLeast 0; }} }} search ( {{ "
                                                     "algorithm bisection; tolerance 1e-12; }} );",
                                                     isLow ? "minimise" : "maximise"),
                                         1);
        const SearchOutcome outcome = search(settings, [&](const std::vector<double>& at)
                                             { return (at[0] >= border) == isLow ? 1 : -1; });
        EXPECT_EQ(outcome.end, SearchEnd::converged);
        EXPECT_EQ(outcome.best->violation, 0);
        EXPECT_NEAR(outcome.best->variables[0], border, 1e-11);
    }
    const auto settings =
        settingsOf("objective { goal minimise; value x; } constraints { stands { value f; atLeast 0; } } "
                   "search ( { algorithm bisection; } );",
                   1);
    EXPECT_EQ(search(settings, [](const auto&) { return 1; }).best->variables[0], -1)
        << "all hold: the bound";
    EXPECT_EQ(search(settings, [](const auto&) { return -1; }).end, SearchEnd::failed) << "none hold";
}

TEST(ParameterSearch, BisectionSaysThatAnObjectiveDoesNotGrowAllTheWay)
{
    for (const char* value : {"abs(x - 0.1)", "-abs(x - 0.1)"})
    {
        const auto settings = settingsOf(
            fmt::format("objective {{ goal minimise; value \"{}\"; }} constraints {{ stands {{ value f; "
                        "atLeast 0; }} }} search ( {{ algorithm bisection; }} );",
                        value),
            1);
        EXPECT_EQ(search(settings, [](const auto&) { return 1; }).end, SearchEnd::notMonotone) << value;
    }
}

TEST(ParameterSearch, StopsAtOnceWhenAskedAndAsksForTheSamePointsAgain)
{
    for (const auto& [name, algorithm] : namesOf(SearchAlgorithm()))
    {
        if (algorithm == SearchAlgorithm::bisection)
        {
            continue;
        }
        const auto settings = settingsOf(fmt::format(
            "objective {{ goal minimise; value f; }} search ( {{ algorithm {}; maximumEvaluations 60; }} );",
            name));
        std::vector<std::vector<double>> all;
        std::vector<std::vector<double>> some;
        std::vector<std::vector<double>> again;
        search(settings, bowl, &all);
        EXPECT_EQ(search(settings, bowl, &some, 17).end, SearchEnd::interrupted) << name;
        EXPECT_EQ(some.size(), 17u) << name;
        search(settings, bowl, &again);
        EXPECT_EQ(again, all) << name;
        EXPECT_TRUE(std::equal(some.begin(), some.end(), all.begin())) << name;
    }
}

// CRS2_LM made 7 of 5, as it went on until its population was full.
TEST(ParameterSearch, LooksAtNoMorePointsThanItMay)
{
    for (const auto& [name, algorithm] : namesOf(SearchAlgorithm()))
    {
        if (algorithm == SearchAlgorithm::bisection)
        {
            continue;
        }
        for (const std::size_t most : {1u, 5u, 23u})
        {
            const auto settings = settingsOf(fmt::format("objective {{ goal minimise; value f; }} search ( "
                                                         "{{ algorithm {}; maximumEvaluations {}; }} );",
                                                         name, most));
            std::vector<std::vector<double>> all;
            EXPECT_EQ(search(settings, bowl, &all).end, SearchEnd::evaluations) << name << ' ' << most;
            EXPECT_EQ(all.size(), most) << name;
        }
    }
}

// DIRECT and DIRECT_L of NLopt read a point that they had not set when the first one stopped them: SIGSEGV.
TEST(ParameterSearch, TheFirstPointsMayEndAnySearch)
{
    for (const auto& [name, algorithm] : namesOf(SearchAlgorithm()))
    {
        for (const char* constraints : {"", "constraints { c { value x; atLeast -0.5; } } "})
        {
            if (algorithm == SearchAlgorithm::bisection)
            {
                continue;
            }
            std::optional<ParameterSearchSettings> settings;
            try
            {
                settings =
                    settingsOf(fmt::format("objective {{ goal minimise; value f; }} {}search ( {{ algorithm "
                                           "{}; maximumEvaluations 60; }} );",
                                           constraints, name));
            }
            catch (const FatalIOError&)
            {
                continue; // an algorithm without constraints
            }
            for (const std::size_t most : {0u, 1u, 2u})
            {
                std::vector<std::vector<double>> asked;
                EXPECT_EQ(search(*settings, bowl, &asked, most).end, SearchEnd::interrupted) << name << most;
                EXPECT_EQ(asked.size(), most) << name;
                std::size_t count = 0;
                const auto failing = [&](const std::vector<double>& at)
                { return count++ == most ? throw FatalError("a fault of the case") : bowl(at); };
                EXPECT_THROW(search(*settings, failing), FatalError) << name << most;
                EXPECT_EQ(count, most + 1) << name;
            }
        }
    }
}

TEST(ParameterSearch, AnErrorOfTheEvaluationPassesThroughNLopt)
{
    const auto settings =
        settingsOf("objective { goal minimise; value f; } search ( { algorithm SBPLX; } );");
    EXPECT_THROW(search(settings, [](const auto&) -> double { throw FatalError("a fault of the case"); }),
                 FatalError);
    EXPECT_THROW(
        search(settingsOf("objective { goal minimise; value \"log(f)\"; } search ( { algorithm SBPLX; } );"),
               [](const auto&) { return -1; }),
        FatalError);
}

TEST(ParameterSearch, AnExpressionWithoutAValueIsToldWithItsPlace)
{
    const auto settings = settingsOf(
        "objective { goal minimise; value f; }\nconstraints { own {\n value \"log(f)\"; atLeast 0; "
        "} }\nsearch ( { algorithm COBYLA; } );");
    const std::string report = reportOf([&] { evaluate(settings, {0.1, 0.2}, {-1}); });
    EXPECT_THAT(report, HasSubstr("`log(f)` of system/parameterSearchDict has no value at a point"));
    EXPECT_THAT(report, HasSubstr("system/parameterSearchDict/constraints/own/value at line 3."));
    const auto other = settingsOf("\nobjective { goal minimise; value \"sqrt(x)*f\"; } search ( { algorithm "
                                  "DIRECT; } );");
    EXPECT_THAT(reportOf(
                    [&] {
                        evaluate(other, {-0.5, 0.2}, {1});
                    }),
                HasSubstr("system/parameterSearchDict/objective/value at line 2."));
}

TEST(ParameterSearch, PraxisIsQuestionedAsItDoesNotKeepToBounds)
{
    const auto warnings = [](const std::string& algorithms)
    {
        testing::internal::CaptureStderr();
        settingsOf("objective { goal minimise; value f; }\nsearch ( " + algorithms + " );");
        return testing::internal::GetCapturedStderr();
    };
    EXPECT_EQ(warnings("{ algorithm DIRECT; } { algorithm SBPLX; }"), "");
    const std::string warning = warnings("{ algorithm DIRECT; } { algorithm PRAXIS; tolerance 1e-4; }");
    EXPECT_THAT(warning, HasSubstr("an optimum at a bound may be missed"));
    EXPECT_THAT(warning, HasSubstr("BOBYQA"));
    EXPECT_THAT(warning, HasSubstr("parameterSearchDict/search at line 2"));
}

TEST(ParameterSearch, EvaluationsOfPraxisOutsideTheBoundsAreCounted)
{
    for (const std::string algorithm : {"PRAXIS", "SBPLX"})
    {
        const auto settings = settingsOf("objective { goal minimise; value f; } search ( { algorithm "
                                         + algorithm + "; maximumEvaluations 100; tolerance 1e-12; } );");
        int within = 0;
        const auto outcome = search(settings,
                                    [&within](const std::vector<double>& at)
                                    {
                                        ++within;
                                        return at[0] + std::abs(at[0] - 3 * at[1]);
                                    });
        const bool isPraxis = algorithm == "PRAXIS";
        EXPECT_EQ(outcome.beyondBounds > 0, isPraxis) << algorithm;
        if (isPraxis)
        {
            EXPECT_EQ(outcome.end, SearchEnd::evaluations);
            EXPECT_LT(within, 100);
            EXPECT_LE(within + outcome.beyondBounds, 100);
        }
    }
}
