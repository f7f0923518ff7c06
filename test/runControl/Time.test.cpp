// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Time, its write control and its restart, in case directories made for the purpose.
#include "runControl/Time.h"

#include "../ReportOf.h"
#include "core/Error.h"
#include "core/Log.h"
#include "core/Signals.h"
#include "core/WholeFile.h"
#include "runControl/Case.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <unistd.h>

namespace drystone
{

namespace
{

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;

/// A case directory that is removed at the end of its test.
class TimeCase : public testing::Test
{
protected:
    void SetUp() override
    {
        forgetStopSignal();
        const auto* test = testing::UnitTest::GetInstance()->current_test_info();
        directory = fs::temp_directory_path() / fmt::format("drystone-{}-{}", ::getpid(), test->name());
        fs::create_directories(directory / "system");
    }
    void TearDown() override
    {
        forgetStopSignal();
        fs::remove_all(directory);
    }
    void control(const std::string& text) { writeWholeFile(directory / "system/controlDict", text); }
    /// Rewrites controlDict so that it counts as changed, whatever the resolution of the file system's clock.
    void change(const std::string& text)
    {
        const fs::path file = directory / "system/controlDict";
        const auto before = fs::last_write_time(file);
        control(text);
        fs::last_write_time(file, before + std::chrono::seconds(2));
    }
    std::string failure(const std::string& text)
    {
        control(text);
        return reportOf([&] { Time time(directory, ControlDict::required); });
    }
    std::vector<std::string> writeTimes(Time& time)
    {
        std::vector<std::string> names;
        while (time.loop())
        {
            if (time.isWriteTime())
            {
                names.push_back(time.name());
            }
        }
        return names;
    }

    fs::path directory;
};

TEST_F(TimeCase, HasDefaultsWithoutAControlDict)
{
    Time time(directory);
    EXPECT_EQ(time.value(), 0);
    EXPECT_EQ(time.name(), "0");
    EXPECT_THROW(Time(directory, ControlDict::required), FatalIOError);
}

TEST_F(TimeCase, WhatAStepNeedsIsRequiredWithAnExample)
{
    EXPECT_THAT(failure("endTime 1;"),
                testing::AllOf(HasSubstr("The entry deltaT is missing: length of a time step [s]. "
                                         "Write for example `deltaT 0.01;`."),
                               HasSubstr("controlDict")));
    EXPECT_THAT(failure("deltaT 0.1;"),
                testing::AllOf(HasSubstr("The entry endTime is missing"),
                               HasSubstr("Write for example `endTime 1;`"), HasSubstr("controlDict")));
    EXPECT_EQ(failure("deltaT 0.1; stopAt writeNow;"), "no error");
    EXPECT_THAT(failure("deltaT 0.1; stopAt nextWrite; writeControl none;"),
                HasSubstr("would never end the run"));
    EXPECT_THAT(failure("deltaT 0.1; endTime 1; startTime 2;"), HasSubstr("endTime lies before startTime"));
    for (const OptionDescription& about : describeOptions<SteppedTimeControls>())
    {
        if (about.key == "deltaT")
        {
            EXPECT_EQ(about.presence, OptionDescription::Presence::required);
        }
        if (about.key == "endTime")
        {
            EXPECT_EQ(about.presence, OptionDescription::Presence::mayBeAbsent);
            EXPECT_THAT(about.doc, HasSubstr("required"));
        }
    }
    control("application limitAnalysis;");
    EXPECT_EQ(Time(directory).controls().endTime, 1);
}

TEST_F(TimeCase, StepsWhoseTimesAreTheSameAreRefused)
{
    EXPECT_THAT(failure("deltaT 1e-300; endTime 1;"),
                testing::AllOf(HasSubstr("deltaT 1e-300 s is too short"), HasSubstr("Give at least 1e-13 s"),
                               HasSubstr("controlDict/deltaT at line 1")));
    EXPECT_THAT(failure("deltaT 1e-14; stopAt nextWrite;"), HasSubstr("Give at least 1e-13 s"));
    EXPECT_THAT(failure("deltaT 1e-10; endTime 1e6;"), HasSubstr("is too short"));
    EXPECT_EQ(failure("deltaT 1e-9; endTime 1;"), "no error");
}

TEST_F(TimeCase, AnApplicationOfAnotherProgramIsQuestioned)
{
    const auto warnings = [this](const std::string& application)
    {
        control("application " + application + "; deltaT 0.1; endTime 1;");
        testing::internal::CaptureStderr();
        testing::internal::CaptureStdout();
        Time time(directory, ControlDict::required);
        return testing::internal::GetCapturedStdout() + testing::internal::GetCapturedStderr();
    };
    EXPECT_EQ(warnings("contactDynamics"), "");
    EXPECT_EQ(warnings("limitAnalysis"), "");
    EXPECT_EQ(warnings("\"\""), "");
    EXPECT_THAT(warnings("simpleFoam"),
                testing::AllOf(HasSubstr("application simpleFoam is none of Drystone's"),
                               HasSubstr("limitAnalysis"), HasSubstr("line 1")));
    EXPECT_THAT(warnings("contactDynamic"), HasSubstr("Did you mean contactDynamics?"));
}

TEST_F(TimeCase, ReachesTheEndAndWritesEachInterval)
{
    control("deltaT 0.1; endTime 1; writeControl timeStep; writeInterval 4;");
    Time time(directory, ControlDict::required);
    EXPECT_THAT(writeTimes(time), ElementsAre("0.4", "0.8"));
    EXPECT_EQ(time.index(), 10);
    EXPECT_EQ(time.name(), "1");
    EXPECT_EQ(time.exitStatus(), 0);
    EXPECT_EQ(time.progress(), 1);
}

TEST_F(TimeCase, DoesNotDriftInAMillionSteps)
{
    control("deltaT 0.001; endTime 1000; writeControl runTime; writeInterval 100; runTimeModifiable off;");
    Time time(directory, ControlDict::required);
    EXPECT_THAT(writeTimes(time),
                ElementsAre("100", "200", "300", "400", "500", "600", "700", "800", "900", "1000"));
    EXPECT_EQ(time.index(), 1000000);
    // Summing up 0.001 a million times is 1.7e-8 off.
    EXPECT_NEAR(time.value(), 1000, 2e-13);
}

TEST_F(TimeCase, WritesAtTheFirstStepThatReachesARunTime)
{
    control("deltaT 0.03; endTime 0.3; writeControl runTime; writeInterval 0.1;");
    Time time(directory, ControlDict::required);
    // As OpenFOAM: an instant is reached from half a step before it on.
    EXPECT_THAT(writeTimes(time), ElementsAre("0.09", "0.21", "0.3"));
}

TEST_F(TimeCase, EndsAdjustedStepsOnTheWriteTimes)
{
    control(
        "deltaT 0.03; endTime 0.5; adjustTimeStep on; writeControl adjustableRunTime; writeInterval 0.1;");
    Time time(directory, ControlDict::required);
    std::vector<double> written;
    while (time.loop())
    {
        EXPECT_LE(time.deltaT(), 0.03 * (1 + 1e-9));
        if (time.isWriteTime())
        {
            written.push_back(time.value());
        }
        time.setDeltaT(0.03);
    }
    ASSERT_EQ(written.size(), 5u);
    for (std::size_t i = 0; i < written.size(); ++i)
    {
        EXPECT_NEAR(written[i], 0.1 * static_cast<double>(i + 1), 1e-12);
    }
}

TEST_F(TimeCase, NamesTimesAsOpenFOAMDoes)
{
    EXPECT_EQ(timeName(0.1 + 0.2), "0.3");
    EXPECT_EQ(timeName(1e-5), "1e-05");
    EXPECT_EQ(timeName(1234567), "1.23457e+06");
    EXPECT_EQ(timeName(-1e-17), "0");
    EXPECT_EQ(timeName(2.5, TimeFormat::fixed, 3), "2.500");
    EXPECT_EQ(timeName(2.5, TimeFormat::scientific, 2), "2.50e+00");
}

TEST_F(TimeCase, TakesMoreDigitsWhereNamesWouldBeTheSame)
{
    control("deltaT 1e-5; startTime 100; endTime 100.001; startFrom startTime; writeControl timeStep; "
            "writeInterval 1;");
    Time time(directory, ControlDict::required);
    const std::vector<std::string> names = writeTimes(time);
    EXPECT_EQ(names.size(), 100u);
    EXPECT_EQ(std::set<std::string>(names.begin(), names.end()).size(), 100u);
    EXPECT_EQ(names[0], "100.00001");
}

TEST_F(TimeCase, StartsWhereItIsTold)
{
    for (const char* name : {"0", "0.5", "2", "10", "0.5x", "constant"})
    {
        fs::create_directories(directory / name);
    }
    const std::string rest = "deltaT 0.1; endTime 20;";
    control("startFrom latestTime;" + rest);
    EXPECT_EQ(Time(directory, ControlDict::required).startName(), "10");
    control("startFrom firstTime;" + rest);
    EXPECT_EQ(Time(directory, ControlDict::required).startName(), "0");
    control("startFrom startTime; startTime 0.5;" + rest);
    EXPECT_EQ(Time(directory, ControlDict::required).startName(), "0.5");
}

TEST_F(TimeCase, BeginsBeforeTimeZero)
{
    control("startFrom startTime; startTime -0.2; endTime 0.1; deltaT 0.1; writeInterval 1;");
    Time time(directory, ControlDict::required);
    EXPECT_THAT(writeTimes(time), ElementsAre("-0.1", "0", "0.1"));
}

// A run that distinguishes its steps with more digits than timePrecision leaves such directories.
TEST_F(TimeCase, StartsFromADirectoryWithMoreDigitsThanTimePrecision)
{
    for (const char* name : {"0", "1.201", "1.208571"})
    {
        fs::create_directories(directory / name);
    }
    const std::string rest = "endTime 2; deltaT 0.1;";
    control("startFrom latestTime;" + rest);
    EXPECT_EQ(Time(directory, ControlDict::required).startName(), "1.208571");
    EXPECT_EQ(Time(directory, ControlDict::required).startValue(), 1.208571);
    control("startFrom startTime; startTime 1.20857;" + rest); // timePrecision 6
    EXPECT_EQ(Time(directory, ControlDict::required).startName(), "1.208571");
    control("startFrom startTime; startTime 1.2086;" + rest);
    EXPECT_EQ(Time(directory, ControlDict::required).startName(), "1.2086");
    control("startFrom startTime; startTime 1.2; timePrecision 2;" + rest);
    EXPECT_EQ(Time(directory, ControlDict::required).startName(), "1.201"); // the nearest of two
}

TEST_F(TimeCase, ContinuesBitForBit)
{
    // 0.1 has no end in binary: a clock that is set anew at a restart would round otherwise.
    control("deltaT 0.1; endTime 30; writeControl timeStep; writeInterval 7;");
    Time whole(directory, ControlDict::required);
    std::vector<double> times;
    std::vector<std::string> written;
    TimeState saved;
    while (whole.loop())
    {
        times.push_back(whole.value());
        if (whole.isWriteTime())
        {
            written.push_back(whole.name());
        }
        if (whole.index() == 123)
        {
            saved = whole.state();
        }
    }
    Time rest(directory, ControlDict::required);
    rest.resume(saved);
    std::vector<std::string> writtenLater;
    while (rest.loop())
    {
        EXPECT_EQ(rest.value(), times[static_cast<std::size_t>(rest.index() - 1)]);
        if (rest.isWriteTime())
        {
            writtenLater.push_back(rest.name());
        }
    }
    EXPECT_EQ(rest.index(), 300);
    EXPECT_EQ(writtenLater, std::vector<std::string>(written.begin() + 17, written.end()));
}

TEST_F(TimeCase, StopsAsStopAtSays)
{
    const std::string rest = "deltaT 0.1; endTime 1; writeControl timeStep; writeInterval 3;";
    const auto run = [&](const std::string& stopAt)
    {
        control("stopAt " + stopAt + ";" + rest);
        Time time(directory, ControlDict::required);
        const std::vector<std::string> written = writeTimes(time);
        return std::pair(time.index(), written.size());
    };
    EXPECT_EQ(run("endTime"), std::pair(10L, std::size_t{3}));
    EXPECT_EQ(run("writeNow"), std::pair(1L, std::size_t{1}));
    EXPECT_EQ(run("noWriteNow"), std::pair(1L, std::size_t{0}));
    EXPECT_EQ(run("nextWrite"), std::pair(3L, std::size_t{1}));
}

TEST_F(TimeCase, EndsWithTheStateWrittenWhenInterrupted)
{
    control("deltaT 0.1; endTime 1000; writeControl timeStep; writeInterval 100;");
    catchStopSignals();
    Time time(directory, ControlDict::required);
    std::vector<std::string> written;
    while (time.loop())
    {
        if (time.index() == 5)
        {
            std::raise(SIGINT);
        }
        if (time.isWriteTime())
        {
            written.push_back(time.name());
        }
        EXPECT_EQ(time.isWriteTime(), time.index() == 5) << "the answer changes within a step";
    }
    EXPECT_THAT(written, ElementsAre("0.5"));
    EXPECT_EQ(time.exitStatus(), 130);
    forgetStopSignal();
    catchStopSignals();
    std::raise(SIGTERM);
    EXPECT_EQ(exitStatusOfSignal(stopSignal()), 143);
}

TEST_F(TimeCase, ReadsAControlDictThatHasChanged)
{
    control("deltaT 0.1; endTime 1;");
    Time time(directory, ControlDict::required);
    ASSERT_TRUE(time.loop());
    change("deltaT 0.2; endTime 0.5;");
    testing::internal::CaptureStdout();
    ASSERT_TRUE(time.loop());
    EXPECT_THAT(testing::internal::GetCapturedStdout(), HasSubstr("it has changed"));
    EXPECT_NEAR(time.value(), 0.3, 1e-15);
    ASSERT_TRUE(time.loop());
    EXPECT_NEAR(time.value(), 0.5, 1e-15);
    EXPECT_FALSE(time.loop());
}

TEST_F(TimeCase, HasDeltaTAgainWhenStepsAreAdjustedNoMore)
{
    control("deltaT 0.1; endTime 3; adjustTimeStep on;");
    Time time(directory, ControlDict::required);
    ASSERT_TRUE(time.loop());
    time.setDeltaT(0.5);
    ASSERT_TRUE(time.loop());
    const double before = time.value();
    EXPECT_GT(before, 0.5);
    change("deltaT 0.1; endTime 3; adjustTimeStep off;");
    ASSERT_TRUE(time.loop());
    EXPECT_NEAR(time.value(), before + 0.1, 1e-14);
}

TEST_F(TimeCase, GoesOnWithTheOldSettingsWhenTheNewOnesAreFaulty)
{
    control("deltaT 0.1; endTime 0.3;");
    Time time(directory, ControlDict::required);
    ASSERT_TRUE(time.loop());
    change("deltaT 0.1; endTime soon;");
    testing::internal::CaptureStderr();
    ASSERT_TRUE(time.loop());
    const std::string warning = testing::internal::GetCapturedStderr();
    EXPECT_THAT(warning, HasSubstr("--> DRYSTONE Warning :"));
    EXPECT_THAT(warning, HasSubstr("system/controlDict/endTime at line 1."));
    EXPECT_TRUE(time.loop());
    EXPECT_FALSE(time.loop());
}

TEST_F(TimeCase, LeavesAControlDictAloneThatMayNotBeModified)
{
    control("deltaT 0.1; endTime 0.3; runTimeModifiable no;");
    Time time(directory, ControlDict::required);
    ASSERT_TRUE(time.loop());
    change("deltaT 0.1; endTime 0.1;");
    EXPECT_TRUE(time.loop());
}

TEST_F(TimeCase, RepeatsAStepInPartsAndGoesOnAtTheTimesItWouldHaveHad)
{
    control("deltaT 0.1; endTime 0.7;");
    Time whole(directory, ControlDict::required);
    std::vector<double> regular;
    while (whole.loop())
    {
        regular.push_back(whole.value());
    }
    ASSERT_EQ(regular.size(), 7u);

    Time time(directory, ControlDict::required);
    ASSERT_TRUE(time.loop());
    ASSERT_TRUE(time.loop());
    time.shortenStep(0.05);
    time.shortenStep(0.025);
    EXPECT_EQ(time.index(), 2);
    EXPECT_NEAR(time.value(), 0.125, 1e-15);
    EXPECT_NEAR(time.previousValue(), 0.1, 1e-15);
    const TimeState inParts = time.state();
    ASSERT_TRUE(time.loop());
    EXPECT_EQ(time.value(), regular[1]) << "the rest of the step";
    EXPECT_NEAR(time.deltaT(), 0.075, 1e-15);
    time.shortenStep(0.0375);
    EXPECT_NEAR(time.value(), 0.1625, 1e-15);
    for (std::size_t i = 1; i < regular.size(); ++i)
    {
        ASSERT_TRUE(time.loop());
        EXPECT_EQ(time.value(), regular[i]);
    }
    EXPECT_FALSE(time.loop());

    Time restarted(directory, ControlDict::required);
    restarted.resume(inParts);
    for (std::size_t i = 1; i < regular.size(); ++i)
    {
        ASSERT_TRUE(restarted.loop());
        EXPECT_EQ(restarted.value(), regular[i]);
    }
    EXPECT_FALSE(restarted.loop());
}

TEST_F(TimeCase, DoesNotEndInTheMiddleOfAStepThatIsMadeInParts)
{
    control("deltaT 0.1; endTime 0.2;");
    Time time(directory, ControlDict::required);
    ASSERT_TRUE(time.loop());
    ASSERT_TRUE(time.loop());
    time.shortenStep(0.08);
    ASSERT_TRUE(time.loop());
    EXPECT_EQ(time.value(), 0.2);
    EXPECT_FALSE(time.loop());
}

TEST_F(TimeCase, CountsStepsThatAreMadeInPartsOnce)
{
    control("deltaT 0.1; endTime 0.8; writeControl timeStep; writeInterval 4;");
    Time time(directory, ControlDict::required);
    // Steps 2 and 4 are made in two parts, step 7 in three. \return the names of what was written
    const auto runInParts = [](Time& run, double until)
    {
        std::vector<std::string> names;
        while (run.state().value < until - 1e-9 && run.loop())
        {
            const auto ends = [&](double end) { return std::abs(run.value() - end) < 1e-9; };
            if (run.deltaT() > 0.09 && (ends(0.2) || ends(0.4) || ends(0.7)))
            {
                run.shortenStep(0.03);
            }
            else if (run.deltaT() > 0.06 && run.deltaT() < 0.09 && ends(0.7))
            {
                run.shortenStep(0.02);
            }
            if (run.isWriteTime())
            {
                names.push_back(run.name());
            }
        }
        return names;
    };
    EXPECT_THAT(runInParts(time, 1), ElementsAre("0.4", "0.8"));
    EXPECT_EQ(time.index(), 12);
    for (const double until : {0.13, 0.2, 0.33, 0.4, 0.63, 0.65, 0.7})
    {
        Time begun(directory, ControlDict::required);
        std::vector<std::string> names = runInParts(begun, until);
        EXPECT_NEAR(begun.value(), until, 1e-9);
        Time rest(directory, ControlDict::required);
        rest.resume(begun.state());
        const std::vector<std::string> later = runInParts(rest, 1);
        names.insert(names.end(), later.begin(), later.end());
        EXPECT_THAT(names, ElementsAre("0.4", "0.8")) << until;
    }
}

TEST_F(TimeCase, TakesAStepBackToTheLastBit)
{
    control("deltaT 0.1; endTime 5;");
    Time whole(directory, ControlDict::required);
    std::vector<double> regular;
    while (whole.loop())
    {
        regular.push_back(whole.value());
    }

    Time time(directory, ControlDict::required);
    for (int i = 0; i < 23; ++i)
    {
        ASSERT_TRUE(time.loop());
    }
    const TimeState before = time.state();
    ASSERT_TRUE(time.loop());
    for (double part = 0.05; part > 1e-4; part /= 2)
    {
        time.shortenStep(part);
    }
    time.abandonStep();
    const TimeState after = time.state();
    EXPECT_EQ(after.value, before.value);
    EXPECT_EQ(after.deltaT, before.deltaT);
    EXPECT_EQ(after.index, before.index);
    EXPECT_EQ(after.origin, before.origin);
    EXPECT_EQ(after.originIndex, before.originIndex);
    EXPECT_EQ(after.unfinished, before.unfinished);
    for (std::size_t i = 23; i < regular.size(); ++i)
    {
        ASSERT_TRUE(time.loop());
        EXPECT_EQ(time.value(), regular[i]);
    }
}

TEST_F(TimeCase, EndsAdjustedStepsWhereOthersAskAndAtTheEndTime)
{
    control("deltaT 0.03; endTime 0.5; adjustTimeStep on; writeControl runTime; writeInterval 0.2;");
    Time time(directory, ControlDict::required);
    OutputControl every({WriteControl::adjustableRunTime, 0.07}, {});
    time.stopAlsoAt([&](double value, double deltaT) { return every.timeToNextWrite(value, deltaT); });
    std::vector<double> times;
    while (time.loop())
    {
        times.push_back(time.value());
        time.setDeltaT(0.03);
    }
    for (int i = 1; i <= 7; ++i)
    {
        EXPECT_THAT(times, testing::Contains(testing::DoubleNear(0.07 * i, 1e-14)));
    }
    EXPECT_NEAR(times.back(), 0.5, 1e-15);
}

// Rounding of such times is more than a billionth of the step: steps as short as that followed each write.
TEST_F(TimeCase, EndsAdjustedStepsOnWriteTimesOnceHoweverLateTheyAre)
{
    control("deltaT 0.003; startTime 1e6; endTime 1000000.3; startFrom startTime; adjustTimeStep on; "
            "writeControl adjustableRunTime; writeInterval 0.03;");
    Time time(directory, ControlDict::required);
    const std::vector<double> others{1000000.0501, 1000000.1};
    time.stopAlsoAt(
        [&](double value, double deltaT)
        {
            const auto next =
                std::upper_bound(others.begin(), others.end(), value + sameInstant(value, deltaT));
            return next == others.end() ? std::numeric_limits<double>::infinity() : *next - value;
        });
    int written = 0;
    double before = time.value();
    while (time.loop())
    {
        EXPECT_GT(time.value() - before, 1e-4);
        before = time.value();
        written += time.isWriteTime() ? 1 : 0;
        time.setDeltaT(0.02);
    }
    EXPECT_EQ(written, 10);
    EXPECT_NEAR(before, 1000000.3, 1e-9);
}

TEST_F(TimeCase, EndsAdjustedStepsOnChangesOrOnWriteTimesBesideThem)
{
    control("deltaT 0.03; endTime 1; adjustTimeStep on; writeControl adjustableRunTime; writeInterval 0.2;");
    Time time(directory, ControlDict::required);
    // The change at 0.200001 is as good as the write time, and no step leads from the one to the other.
    const std::vector<double> changes{0.07, 0.11, 0.200001, 0.5, 0.999999};
    std::vector<double> times{0};
    time.setDeltaT(0.03, changes[0]);
    while (time.loop())
    {
        times.push_back(time.value());
        EXPECT_GT(times.back() - times[times.size() - 2], 0.01);
        const auto next = std::upper_bound(changes.begin(), changes.end(), time.value() + 3e-5);
        EXPECT_DOUBLE_EQ(time.wantedDeltaT(), 0.03);
        time.setDeltaT(0.03, next == changes.end() ? std::numeric_limits<double>::infinity() : *next);
    }
    for (const double instant : {0.07, 0.11, 0.2, 0.4, 0.5, 0.6, 0.8, 1.0})
    {
        EXPECT_THAT(times, testing::Contains(testing::DoubleNear(instant, 1e-14)));
    }
    EXPECT_EQ(times.size(), 1u + 3 + 2 + 3 + 7 + 4 + 4 + 7 + 7);
}

TEST_F(TimeCase, WritesAdjustedStepsThatEndOnWriteTimesOnlyThere)
{
    control("deltaT 0.03; endTime 1; adjustTimeStep on; writeControl adjustableRunTime; writeInterval 0.2;");
    Time time(directory, ControlDict::required);
    // A change less than half a step before a write time, as where a pulse ends, is no write time.
    time.setDeltaT(0.03, 0.39);
    std::vector<double> written;
    while (time.loop())
    {
        if (time.isWriteTime())
        {
            written.push_back(time.value());
        }
        time.setDeltaT(0.03, time.value() < 0.389 ? 0.39 : std::numeric_limits<double>::infinity());
    }
    ASSERT_EQ(written.size(), 5u);
    for (std::size_t i = 0; i < written.size(); ++i)
    {
        EXPECT_NEAR(written[i], 0.2 * static_cast<double>(i + 1), 1e-12);
    }
}

TEST_F(TimeCase, NamesWhatIsWrongWithAControlDict)
{
    EXPECT_THAT(failure("endTime 1;"), HasSubstr("deltaT"));
    EXPECT_THAT(failure("deltaT 0.1;"), HasSubstr("endTime"));
    EXPECT_THAT(failure("deltaT 0.1; stopAt nextWrite;"), "no error");
    EXPECT_THAT(failure("endTime 1;\ndeltaT -0.1;"), HasSubstr("controlDict/deltaT at line 2."));
    EXPECT_THAT(failure("endTime 1;\ndeltaT 0;"), HasSubstr("controlDict/deltaT at line 2."));
    EXPECT_THAT(failure("endTime 1; deltaT 0.1;\n\nwriteControll timeStep;"),
                testing::AllOf(HasSubstr("Did you mean writeControl?"), HasSubstr("at line 3.")));
    EXPECT_THAT(failure("endTime 1; deltaT 0.1; startFrom lastTime;"), HasSubstr("latestTime"));
    EXPECT_THAT(failure("endTime 1; deltaT 0.1; writeInterval 0.5;"), HasSubstr("whole number"));
    EXPECT_THAT(failure("endTime 1; deltaT 0.1; writeControl writeTime;"), HasSubstr("function objects"));
    EXPECT_THAT(failure("startTime 2;\nendTime 1; deltaT 0.1;"),
                testing::AllOf(HasSubstr("endTime lies before startTime"), HasSubstr("at line 2.")));
    fs::create_directories(directory / "0.5"); // from where a run starts unless it says startTime
    EXPECT_THAT(failure("startTime 2; endTime 1; deltaT 0.1;"), "no error");
    EXPECT_THAT(failure("startTime 2; endTime 1; deltaT 0.1; startFrom firstTime;"), "no error");
    EXPECT_THAT(failure("startTime 2; endTime 1; deltaT 0.1; startFrom startTime;"),
                HasSubstr("endTime lies before startTime"));
    EXPECT_THAT(failure("endTime 1; deltaT nan;"), HasSubstr("deltaT"));
    EXPECT_THAT(failure("endTime 1; deltaT 0.1; functions { energy { type energy; } }"), "no error");
}

TEST(OutputControl, CountsTheWriteTimesOfTheRun)
{
    OutputControl control({WriteControl::writeTime, 2}, TimePoint{});
    std::vector<int> due;
    for (int i = 1; i <= 12; ++i)
    {
        if (control.due({0.1 * i, 0.1, i, i / 3}))
        {
            due.push_back(i);
        }
    }
    EXPECT_THAT(due, ElementsAre(6, 12));
}

TEST(OutputControl, CountsSecondsOfTheClocks)
{
    OutputControl cpu({WriteControl::cpuTime, 10}, TimePoint{});
    EXPECT_FALSE(cpu.due({0, 0, 1, 0, 9.9, 50}));
    EXPECT_TRUE(cpu.due({0, 0, 2, 0, 10.1, 50}));
    EXPECT_FALSE(cpu.due({0, 0, 3, 0, 12, 500}));
    OutputControl none({WriteControl::none, 1}, TimePoint{});
    EXPECT_FALSE(none.due({5, 1, 5, 1, 5, 5}));
}

TEST(OutputControl, TakesIntervalsOfAnySize)
{
    OutputControl never({WriteControl::timeStep, 1e20}, TimePoint{});
    OutputControl always({WriteControl::runTime, 1e-25}, TimePoint{});
    for (int i = 1; i <= 5; ++i)
    {
        EXPECT_FALSE(never.due({0.1 * i, 0.1, i, 0, 0, 0})) << i;
        EXPECT_TRUE(always.due({0.1 * i, 0.1, i, 0, 0, 0})) << i;
    }
}

TEST_F(TimeCase, AMissingControlDictIsRepairedFromAFileThatExists)
{
    const std::string message = reportOf([&] { Time time(directory, ControlDict::required); });
    const std::size_t begin = message.find("etc/");
    ASSERT_NE(begin, std::string::npos) << message;
    const std::string named = message.substr(begin, message.find(' ', begin) - begin);
    EXPECT_TRUE(fs::is_regular_file(fs::path(DRYSTONE_SOURCE_DIR) / named)) << named;
}

TEST(Case, SaysWhatACaseIsMadeOf)
{
    const fs::path empty = fs::temp_directory_path() / fmt::format("drystone-empty-{}", ::getpid());
    fs::create_directories(empty);
    const std::string report = reportOf([&] { requireCase(empty); });
    EXPECT_THAT(report, HasSubstr("neither system/ nor constant/"));
    EXPECT_THAT(report, HasSubstr("system/blockTextureDict"));
    fs::create_directories(empty / "system");
    EXPECT_NO_THROW(requireCase(empty));
    EXPECT_THROW(requireCaseFile(empty, "system/controlDict", "Copy one."), FatalIOError);
    fs::create_directories(empty / "system/controlDict");
    EXPECT_THROW(requireCaseFile(empty, "system/controlDict", "Copy one."), FatalIOError);
    fs::remove_all(empty);
}

TEST(Log, TellsDurationsAsPeopleDo)
{
    EXPECT_EQ(durationText(0.4), "0 s");
    EXPECT_EQ(durationText(59.6), "1 min 0 s");
    EXPECT_EQ(durationText(3725), "1 h 2 min");
    EXPECT_EQ(durationText(200000), "2 d 7 h");
    EXPECT_EQ(durationText(-1), "unknown");
}

TEST(Log, MeasuresTimeSinceTheProcessBegan)
{
    const double first = clockTime();
    EXPECT_GE(first, 0);
    EXPECT_LT(first, 3600);
    EXPECT_GE(clockTime(), first);
    EXPECT_GT(cpuTime(), 0);
    EXPECT_GE(threadCount(), 1);
}

} // namespace

} // namespace drystone
