// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Which intensities are tried, and what a set of verdicts says.
#include "ensembles/Intensity.h"

#include "../ReportOf.h"
#include "core/Error.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

using namespace drystone;
using testing::DoubleNear;
using testing::ElementsAre;
using testing::HasSubstr;

namespace
{

IntensityPlan planOf(const std::string& text)
{
    return intensityTypes().select(Dictionary::readString(text, "system/incrementalDynamicsDict"));
}

std::string faultOf(const std::string& text)
{
    return reportOf([&] { planOf(text); });
}

/// All runs of a plan on something that moves from a threshold on.
std::vector<Trial> triedWith(const IntensityPlan& plan, const std::function<Verdict(double)>& verdictAt)
{
    std::vector<Trial> trials;
    for (std::vector<double> next = plan.next(trials); !next.empty(); next = plan.next(trials))
    {
        for (const double intensity : next)
        {
            trials.push_back({intensity, verdictAt(intensity)});
        }
    }
    return trials;
}

std::function<Verdict(double)> movesFrom(double threshold)
{
    return [threshold](double intensity)
    { return intensity >= threshold ? Verdict::meets : Verdict::stands; };
}

} // namespace

TEST(Intensity, StepsReachTheirEnd)
{
    const auto intensities = planOf("type step; from 0.6; to 0.7; step 0.001;").next({});
    ASSERT_EQ(intensities.size(), 101u);
    EXPECT_EQ(intensities.front(), 0.6);
    EXPECT_NEAR(intensities[43], 0.643, 1e-15);
    EXPECT_NEAR(intensities.back(), 0.7, 1e-15);
    EXPECT_EQ(planOf("type step; from 0.1; to 0.25; step 0.1;").next({}).size(), 2u);
}

TEST(Intensity, StepsThatMissTheirEndAreQuestioned)
{
    const auto doubtAbout = [](const std::string& text)
    {
        testing::internal::CaptureStderr();
        planOf(text);
        return testing::internal::GetCapturedStderr();
    };
    EXPECT_EQ(doubtAbout("type step; from 0.6; to 0.7; step 0.001;"), "");
    EXPECT_EQ(doubtAbout("type step; from 0.1; to 0.7; step 0.2;"), "");
    const std::string doubt = doubtAbout("type step; from 0.3;\nto 0.5;\nstep 0.15;");
    EXPECT_THAT(doubt, HasSubstr("The highest intensity that is tried is 0.45, and not to 0.5"));
    EXPECT_THAT(doubt, HasSubstr("such as 0.1."));
    EXPECT_THAT(doubt, HasSubstr("line 3."));
    EXPECT_THAT(doubtAbout("type step; from 0.3; to 0.4; step 1;"),
                HasSubstr("tried is 0.3, and not to 0.4"));
}

// Accelerations in m/s2 without `unit m/s2;` are read as multiples of g.
TEST(Intensity, BeyondEveryEarthquakeIsQuestioned)
{
    const auto doubtAbout = [](const std::string& text)
    {
        testing::internal::CaptureStderr();
        planOf(text);
        return testing::internal::GetCapturedStderr();
    };
    EXPECT_THAT(doubtAbout("type list;\nvalues (1 3.5 10);"),
                testing::AllOf(HasSubstr("10 g"), HasSubstr("`unit m/s2;`"), HasSubstr("values at line 2.")));
    EXPECT_THAT(doubtAbout("type step; from 1;\n\nto 5; step 1;"), HasSubstr("to at line 3."));
    EXPECT_THAT(doubtAbout("type bisection; low 1;\n\n\nhigh 8; tolerance 0.1;"),
                HasSubstr("high at line 4."));
    EXPECT_THAT(doubtAbout("type list; unit m/s2; values (1 981);"), HasSubstr("981 m/s2"));
    EXPECT_EQ(doubtAbout("type list; unit m/s2; values (1 3.5 10);"), "");
    EXPECT_EQ(doubtAbout("type bisection; low 0.1; high 4; tolerance 0.1;"), "");
}

TEST(Intensity, UnitsAreReadWithAndWithoutQuotes)
{
    EXPECT_EQ(planOf("type list; values (1 2);").unit, IntensityUnit::g);
    EXPECT_EQ(planOf("type list; unit g; values (1 2);").unit, IntensityUnit::g);
    EXPECT_EQ(planOf("type list; unit m/s2; values (1 2);").unit, IntensityUnit::metresPerSecondSquared);
    EXPECT_EQ(planOf("type list; unit \"m/s2\"; values (1 2);").unit, IntensityUnit::metresPerSecondSquared);
}

TEST(Intensity, BisectionFindsWhatStepFindsForEveryThreshold)
{
    const IntensityPlan step = planOf("type step; from 0.3; to 0.35; step 0.001;");
    const IntensityPlan bisection = planOf("type bisection; low 0.3; high 0.35; tolerance 0.001;");
    for (double threshold = 0.2995; threshold < 0.352; threshold += 0.001)
    {
        const LeastIntensity bySteps = leastIntensity(triedWith(step, movesFrom(threshold)));
        const std::vector<Trial> halved = triedWith(bisection, movesFrom(threshold));
        const LeastIntensity byHalves = leastIntensity(halved);
        EXPECT_EQ(bySteps.kind, byHalves.kind) << threshold;
        EXPECT_NEAR(bySteps.value, byHalves.value, 1e-15) << threshold;
        EXPECT_LE(halved.size(), 2u + 6u); // 50 steps: at most six halvings
        if (bySteps.kind == LeastIntensity::Kind::found)
        {
            EXPECT_GE(byHalves.value, threshold);
            EXPECT_LT(byHalves.value - 0.001, threshold);
            EXPECT_NEAR(byHalves.value - byHalves.below, 0.001, 1e-15);
        }
    }
}

TEST(Intensity, BisectionStaysInItsBracket)
{
    // 0.1, 0.4, 0.7 and 0.8: the last interval is shorter than the tolerance.
    const IntensityPlan plan = planOf("type bisection; low 0.1; high 0.8; tolerance 0.3;");
    for (const double threshold : {0.05, 0.2, 0.5, 0.75, 0.8, 0.9})
    {
        const std::vector<Trial> trials = triedWith(plan, movesFrom(threshold));
        for (const Trial& trial : trials)
        {
            EXPECT_GE(trial.intensity, 0.1);
            EXPECT_LE(trial.intensity, 0.8);
        }
        EXPECT_EQ(trials[1].intensity, 0.8);
        EXPECT_LE(static_cast<long>(trials.size()), plan.mostRuns);
        const LeastIntensity least = leastIntensity(trials);
        if (threshold > 0.1 && threshold <= 0.8)
        {
            EXPECT_EQ(least.kind, LeastIntensity::Kind::found) << threshold;
            EXPECT_GE(least.value, threshold);
            EXPECT_LT(least.below, threshold);
            EXPECT_LE(least.value - least.below, 0.3 + 1e-15);
        }
    }
    EXPECT_EQ(leastIntensity(triedWith(plan, movesFrom(0.75))).below, 0.7);
    EXPECT_EQ(planOf("type bisection; low 0.3; high 0.35; tolerance 0.05;").next({}),
              (std::vector{0.3, 0.35}));
    EXPECT_THAT(faultOf("type bisection; low 0.1;\nhigh 0.8;\ntolerance 5;"),
                testing::AllOf(HasSubstr("tolerance 5 is wider than the bracket from low 0.1 to high 0.8"),
                               HasSubstr("below 0.7"), HasSubstr("line 3")));
}

TEST(Intensity, BisectionGoesNoFurtherThanARunThatDidNotConverge)
{
    const IntensityPlan plan = planOf("type bisection; low 1; high 2; tolerance 0.01;");
    const auto trials = triedWith(plan,
                                  [](double intensity) {
                                      return intensity > 1.9   ? Verdict::meets
                                             : intensity < 1.1 ? Verdict::stands
                                                               : Verdict::notConverged;
                                  });
    EXPECT_EQ(trials.size(), 3u);
    EXPECT_EQ(leastIntensity(trials).kind, LeastIntensity::Kind::notConverged);
}

TEST(LeastIntensity, TellsWhatIsKnown)
{
    using Kind = LeastIntensity::Kind;
    const Verdict stands = Verdict::stands;
    const Verdict meets = Verdict::meets;
    const Verdict failed = Verdict::notConverged;
    const LeastIntensity found = leastIntensity({{3, meets}, {1, stands}, {2, meets}, {4, failed}});
    EXPECT_EQ(found.kind, Kind::found);
    EXPECT_EQ(found.value, 2);
    EXPECT_EQ(found.below, 1);
    EXPECT_TRUE(found.isMonotone);
    EXPECT_EQ(leastIntensity({{2, meets}, {1, meets}}).kind, Kind::belowRange);
    EXPECT_EQ(leastIntensity({{2, stands}, {1, stands}}).kind, Kind::aboveRange);
    EXPECT_EQ(leastIntensity({{2, stands}, {1, stands}}).value, 2);
    EXPECT_EQ(leastIntensity({{2, meets}, {1, failed}, {0.5, stands}}).kind, Kind::notConverged);
    EXPECT_EQ(leastIntensity({{2, failed}, {1, stands}}).kind, Kind::notConverged);
    EXPECT_FALSE(leastIntensity({{1, stands}, {2, meets}, {3, stands}}).isMonotone);
}

TEST(Intensity, SaysWhatIsWrongAndWhere)
{
    EXPECT_THAT(faultOf("type step;\nfrom 0.7;\nto 0.6;\nstep 0.001;"), HasSubstr("the range is empty"));
    EXPECT_THAT(faultOf("type step; from 0.7; to 0.8; step 1e-9;"), HasSubstr("more than 100000"));
    EXPECT_THAT(faultOf("type list; values ();"), HasSubstr("empty"));
    EXPECT_THAT(faultOf("type list; values (1 2 1);"), HasSubstr("twice"));
    EXPECT_THAT(faultOf("type list;\nunit cm/s2;\nvalues (1);"),
                testing::AllOf(HasSubstr("cm/s2"), HasSubstr("m/s2"), HasSubstr("line 2")));
    EXPECT_THAT(faultOf("type halving; low 1; high 2; tolerance 0.1;"), HasSubstr("bisection list step"));
    EXPECT_THAT(faultOf("type bisection; low -1; high 2; tolerance 0.1;"), HasSubstr("low"));
}
