// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The `functions` dictionary: reading, times, restarts, and what is refused.
#include "functionObjects/FunctionList.h"

#include "../ReportOf.h"
#include "core/Error.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <limits>

#include <unistd.h>

using namespace drystone;
using testing::ElementsAre;
using testing::HasSubstr;

namespace
{

class FunctionListTest : public testing::Test
{
protected:
    std::filesystem::path folder =
        std::filesystem::temp_directory_path() / fmt::format("drystone_functionList_{}", getpid());
    Assembly<2> assembly;
    std::vector<Placement<2>> placements{2};
    std::vector<BlockVelocity<2>> velocities{2};

    FunctionListTest() { assembly.blocks.resize(2); }
    void TearDown() override { std::filesystem::remove_all(folder); }

    FunctionList<2> read(const std::string& text, const std::string& startName = "0",
                         const TimePoint& begin = {}) const
    {
        return {Dictionary::readString(text, "system/controlDict"), folder, startName, begin, 0, assembly};
    }

    std::string refusal(const std::string& text) const
    {
        return reportOf([&] { read(text); });
    }

    /// Steps of 0.1 s from one index to another; the run writes its state at every fifth.
    void run(FunctionList<2>& functions, long from, long to) const
    {
        for (long index = from + 1; index <= to; ++index)
        {
            TimePoint now;
            now.value = 0.1 * static_cast<double>(index);
            now.deltaT = 0.1;
            now.index = index;
            now.writeTimes = index / 5;
            StepObservation<2> step;
            step.time = now.value;
            step.timeStep = now.deltaT;
            step.step = index;
            step.assembly = &assembly;
            step.placements = placements;
            step.velocities = velocities;
            functions.write(step, now);
        }
    }

    /// First column of a table.
    std::vector<double> times(const std::string& file) const
    {
        std::ifstream stream(folder / "postProcessing" / file);
        std::vector<double> result;
        for (std::string line; std::getline(stream, line);)
        {
            if (line.front() != '#')
            {
                result.push_back(std::stod(line));
            }
        }
        return result;
    }
};

} // namespace

TEST_F(FunctionListTest, EachFunctionWritesAtItsOwnTimes)
{
    FunctionList<2> functions =
        read("energy { type energy; writeInterval 4; }"
             "residuals { writeControl writeTime; }"
             "tip { type blockMotion; blocks (1); writeControl runTime; writeInterval 0.3; }"
             "late { type energy; timeStart 0.8; }"
             "early { type energy; timeEnd 0.2; }"
             "off { type energy; enabled off; }");
    EXPECT_THAT(functions.names(), ElementsAre("energy", "residuals", "tip", "late", "early"));
    EXPECT_FALSE(std::filesystem::exists(folder));
    run(functions, 0, 10);
    const auto near = [](double time) { return testing::DoubleNear(time, 1e-9); };
    EXPECT_THAT(times("energy/0/energy.dat"), ElementsAre(near(0.4), near(0.8)));
    EXPECT_THAT(times("residuals/0/residuals.dat"), ElementsAre(near(0.5), near(1)));
    EXPECT_THAT(times("tip/0/block1.dat"), ElementsAre(near(0.3), near(0.6), near(0.9)));
    EXPECT_THAT(times("late/0/energy.dat"), ElementsAre(near(0.8), near(0.9), near(1)));
    EXPECT_THAT(times("early/0/energy.dat"), ElementsAre(near(0.1), near(0.2)));
    EXPECT_FALSE(std::filesystem::exists(folder / "postProcessing/off"));
}

TEST_F(FunctionListTest, StepsThatEndOnTheTimesOfAFunctionAreWrittenThereOnly)
{
    FunctionList<2> functions =
        read("tip { type blockMotion; blocks (1); writeControl adjustableRunTime; writeInterval 0.4; }");
    long index = 0;
    double before = 0;
    for (const double time : {0.1, 0.2, 0.3, 0.39, 0.4, 0.5, 0.6, 0.7, 0.8})
    {
        TimePoint now{time, time - before, ++index, 0};
        now.endsOnInstants = true;
        before = time;
        StepObservation<2> step;
        step.time = now.value;
        step.timeStep = now.deltaT;
        step.assembly = &assembly;
        step.placements = placements;
        step.velocities = velocities;
        functions.write(step, now);
    }
    const auto near = [](double time) { return testing::DoubleNear(time, 1e-9); };
    EXPECT_THAT(times("tip/0/block1.dat"), ElementsAre(near(0.4), near(0.8)));
}

TEST_F(FunctionListTest, SaysWhatIsBeyondTheEndOfTheRun)
{
    const FunctionList<2> functions = read("energy { }\n"
                                           "late { type energy; timeStart 2.5; }\n"
                                           "never { type motionPictures; times (3 4); }\n"
                                           "some { type motionPictures; times (1 2.04 3); }\n"
                                           "all { type motionPictures; times (1 2.04); }\n");
    testing::internal::CaptureStderr();
    functions.questionTimes(2, 0.1);
    const std::string said = testing::internal::GetCapturedStderr();
    EXPECT_THAT(said, HasSubstr("late writes nothing: it begins at 2.5 s"));
    EXPECT_THAT(said, HasSubstr("never writes nothing: it begins at 3 s"));
    EXPECT_THAT(said, HasSubstr("some does not write at 3 s: the run ends at endTime 2 s"));
    EXPECT_THAT(said, testing::Not(HasSubstr("energy ")));
    EXPECT_THAT(said, testing::Not(HasSubstr("all ")));
}

TEST_F(FunctionListTest, SaysWhatIsBeforeTheBeginningOfTheMotion)
{
    const FunctionList<2> functions = read("before { type motionPictures; times (-1); }\n"
                                           "start { type motionPictures; times (0 1); }\n"
                                           "steps { type motionPictures; times (0.1 1); }\n"
                                           "all { type motionPictures; }\n");
    testing::internal::CaptureStderr();
    functions.questionTimesBeforeMotion();
    const std::string said = testing::internal::GetCapturedStderr();
    EXPECT_THAT(said, HasSubstr("before does not write at -1 s"));
    EXPECT_THAT(said, HasSubstr("start does not write at 0 s"));
    EXPECT_THAT(said, testing::Not(HasSubstr("steps ")));
    EXPECT_THAT(said, testing::Not(HasSubstr("all ")));
}

TEST_F(FunctionListTest, SaysAfterTheRunWhatHasWrittenNothing)
{
    FunctionList<2> functions = read("energy { }\n"
                                     "rare { type energy; writeInterval 11; }\n"
                                     "slow { type energy; writeControl runTime; writeInterval 20; }\n"
                                     "past { type energy; timeEnd -1; }\n"
                                     "late { type energy; timeStart 2; }\n"
                                     "never { type energy; writeControl none; }\n"
                                     "off { type energy; enabled off; }\n");
    run(functions, 0, 10);
    testing::internal::CaptureStderr();
    functions.questionUnwritten(1);
    const std::string said = testing::internal::GetCapturedStderr();
    EXPECT_THAT(said,
                HasSubstr("Function rare has written nothing: its writeInterval 11 (in steps) came due at "
                          "no step of the run, which has ended at 1 s."));
    EXPECT_THAT(said, HasSubstr("Function slow has written nothing: its writeInterval 20 (in s) "));
    EXPECT_THAT(said,
                HasSubstr("Function past has written nothing: its writeInterval 1 (in steps) came due at "
                          "no step up to its timeEnd -1 s."));
    EXPECT_THAT(said, HasSubstr("line 2."));
    EXPECT_THAT(said, testing::Not(HasSubstr("energy has")));
    EXPECT_THAT(said, testing::Not(HasSubstr("late "))); // of which questionTimes warns
    EXPECT_THAT(said, testing::Not(HasSubstr("never ")));
    EXPECT_THAT(said, testing::Not(HasSubstr("off ")));
}

TEST_F(FunctionListTest, ARestartWritesBesideTheEarlierTables)
{
    FunctionList<2> first = read("energy { }");
    run(first, 0, 5);
    TimePoint begin;
    begin.value = 0.5;
    begin.index = 5;
    FunctionList<2> second = read("energy { }", "0.5", begin);
    run(second, 5, 8);
    EXPECT_EQ(times("energy/0/energy.dat").size(), 5u);
    EXPECT_EQ(times("energy/0.5/energy.dat").size(), 3u);
}

TEST_F(FunctionListTest, AllBlocksCanBeFollowed)
{
    FunctionList<2> functions = read("blockMotion { blocks all; }");
    run(functions, 0, 1);
    EXPECT_EQ(times("blockMotion/0/block0.dat").size(), 1u);
    EXPECT_EQ(times("blockMotion/0/block1.dat").size(), 1u);
}

TEST_F(FunctionListTest, PrecisionIsTheUsers)
{
    placements[1].translation.x() = 1.0 / 3;
    FunctionList<2> functions = read("blockMotion { blocks (1); writePrecision 4; }");
    run(functions, 0, 1);
    std::ifstream stream(folder / "postProcessing/blockMotion/0/block1.dat");
    std::string line;
    std::getline(stream, line);
    std::getline(stream, line);
    EXPECT_EQ(line, "0.1  0.3333  0  0  0  0  0");
}

TEST_F(FunctionListTest, WhatIsWrongIsSaidBeforeTheRun)
{
    EXPECT_THAT(refusal("enrgy { }"),
                testing::AllOf(HasSubstr("Unknown function type enrgy"), HasSubstr("Did you mean energy"),
                               HasSubstr("residuals")));
    EXPECT_THAT(refusal("a { type nothing; }"),
                HasSubstr("blockMotion contactForces energy groundMotion motionPictures residuals "
                          "stageTimes"));
    EXPECT_THAT(refusal("energy { writeIntervall 3; }"), HasSubstr("writeIntervall"));
    EXPECT_THAT(refusal("energy { writeInterval -3; }"), HasSubstr("writeInterval"));
    EXPECT_THAT(refusal("energy { writePrecision 40; }"), HasSubstr("writePrecision"));
    EXPECT_THAT(refusal("blockMotion { }"), HasSubstr("blocks"));
    EXPECT_THAT(refusal("blockMotion { blocks (); }"), HasSubstr("no block to follow"));
    EXPECT_THAT(refusal("\nblockMotion { blocks (0 2); }"),
                testing::AllOf(HasSubstr("no block 2"), HasSubstr("0 to 1"), HasSubstr("line 2")));
    EXPECT_THAT(refusal("blockMotion { blocks (-1); }"), HasSubstr("no block -1"));
    EXPECT_THAT(refusal("blockMotion { blocks some; }"), HasSubstr("blocks"));
    EXPECT_THAT(refusal("energy 3;"), HasSubstr("energy"));
    EXPECT_THAT(refusal("\"e.*\" { type energy; }"), HasSubstr("name of a function"));
    EXPECT_FALSE(std::filesystem::exists(folder));
}

TEST_F(FunctionListTest, NoFolderButItsOwnIsAName)
{
    for (const std::string name : {"..", ".", "\"a/b\""})
    {
        EXPECT_THAT(refusal(name + " { type energy; }"), HasSubstr("is that of its folder: a word, not"))
            << name;
    }
    EXPECT_EQ(refusal("a.b { type energy; } ... { type energy; }"), "no error");
}

TEST_F(FunctionListTest, ChosenTimesAreWrittenAtTheNearestStepAndOnceEach)
{
    assembly.blocks = {{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}, 1, -1}, {{{1, 0}, {2, 0}, {2, 1}, {1, 1}}, 1, -1}};
    const auto pictures = [this](const std::string& start)
    {
        std::vector<std::string> names;
        for (const auto& entry :
             std::filesystem::directory_iterator(folder / "postProcessing/collapse" / start))
        {
            names.push_back(entry.path().filename().string());
        }
        std::sort(names.begin(), names.end());
        return names;
    };
    const std::string text = "collapse { type motionPictures; times (0.2 0.33 0.6 3); }";
    FunctionList<2> functions = read(text);
    EXPECT_NEAR(functions.timeToNextWrite(0.2, 0.1), 0.13, 1e-12);
    EXPECT_NEAR(functions.timeToNextWrite(0, 0.1), 0.2, 1e-12);
    EXPECT_EQ(functions.timeToNextWrite(3, 0.1), std::numeric_limits<double>::infinity());
    placements[1].translation = {0.3, -0.4};
    run(functions, 0, 5);
    EXPECT_THAT(pictures("0"), ElementsAre("motion_0.2.svg", "motion_0.3.svg"));
    std::ifstream stream(folder / "postProcessing/collapse/0/motion_0.3.svg");
    const std::string svg(std::istreambuf_iterator<char>(stream), {});
    EXPECT_THAT(svg, HasSubstr("t = 0.3 s, largest displacement of a mass centre 0.5 m"));
    // A run that continues has those of its own times.
    TimePoint begin;
    begin.value = 0.5;
    begin.index = 5;
    FunctionList<2> second = read(text, "0.5", begin);
    run(second, 5, 8);
    EXPECT_THAT(pictures("0.5"), ElementsAre("motion_0.6.svg"));
}

TEST_F(FunctionListTest, PicturesOfMotionMagnifyDisplacements)
{
    assembly.blocks = {{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}, 1, -1},
                       {{{9, 0}, {10, 0}, {10, 1}, {9, 1}}, 1, -1}};
    placements[0].translation = {0, 0.01};
    const auto liftOf = [this](const std::string& name)
    {
        // How much higher the first corner of the first block is than that of the second [px].
        std::ifstream stream(folder / "postProcessing" / name / "0/motion_0.1.svg");
        const std::string svg(std::istreambuf_iterator<char>(stream), {});
        const auto heightAt = [&](std::size_t polygon)
        { return std::stod(svg.substr(svg.find(',', polygon) + 1)); };
        const std::size_t first = svg.find("<polygon points=");
        return heightAt(svg.find("<polygon points=", first + 1)) - heightAt(first);
    };
    FunctionList<2> functions =
        read("asItIs { type motionPictures; } large { type motionPictures; magnification 50; }");
    run(functions, 0, 1);
    EXPECT_GT(liftOf("asItIs"), 0.3);
    EXPECT_NEAR(liftOf("large") / liftOf("asItIs"), 50, 2); // of pixels with two decimals
}

TEST_F(FunctionListTest, TablesAreDrawnOverTimeWhereRequested)
{
    FunctionList<2> functions = read("tip { type blockMotion; blocks (1); pictures yes; } energy { } late { "
                                     "type energy; timeStart 9; pictures yes; }");
    for (long step = 0; step < 3; ++step)
    {
        placements[1].translation.x() = 0.1 * static_cast<double>(step * step);
        run(functions, step, step + 1);
    }
    testing::internal::CaptureStdout();
    functions.writePictures();
    const std::string log = testing::internal::GetCapturedStdout();
    const std::filesystem::path tip = folder / "postProcessing/tip/0";
    EXPECT_TRUE(std::filesystem::exists(tip / "block1_m.svg"));
    EXPECT_FALSE(std::filesystem::exists(tip / "block1_rad.svg")); // zero throughout
    EXPECT_FALSE(std::filesystem::exists(folder / "postProcessing/energy/0/energy_J.svg"));
    std::ifstream stream(tip / "block1_m.svg");
    const std::string svg(std::istreambuf_iterator<char>(stream), {});
    EXPECT_THAT(svg, HasSubstr("tip, block1</text>"));
    EXPECT_THAT(svg, HasSubstr("displacement [m]</text>"));
    EXPECT_THAT(log, HasSubstr("1 picture"));
    EXPECT_THAT(log, HasSubstr("late: there are no two rows"));
}

TEST_F(FunctionListTest, TheMotionOfTheGroundIsListed)
{
    std::filesystem::create_directories(folder / "constant");
    EXPECT_THAT(reportOf([&] { read("record { type groundMotion; }"); }), HasSubstr("constant/groundMotion"));
    std::ofstream(folder / "constant/groundMotion")
        << "direction (0 2 0); acceleration { type table; values ((0 0) (1 10)); }";
    FunctionList<2> functions = read("record { type groundMotion; writePrecision 6; }");
    run(functions, 0, 3);
    std::ifstream stream(folder / "postProcessing/record/0/groundMotion.dat");
    std::vector<std::string> lines;
    for (std::string line; std::getline(stream, line);)
    {
        lines.push_back(line);
    }
    EXPECT_THAT(lines, ElementsAre("# Time[s]  ax[m/s2]  ay[m/s2]", "0.1  0  1", "0.2  0  2", "0.3  0  3"));
}

TEST_F(FunctionListTest, PicturesOfMotionRefuseWhatTheyCannotDraw)
{
    EXPECT_THAT(refusal("p { type motionPictures; times (0.2 0.1); }"), HasSubstr("must ascend"));
    EXPECT_THAT(refusal("p { type motionPictures; times (0.1 0.1); }"), HasSubstr("must ascend"));
    EXPECT_THAT(refusal("p { type motionPictures; magnification 0; }"), HasSubstr("magnification"));
    EXPECT_THAT(refusal("p { type motionPictures; view front; }"),
                HasSubstr("in the plane there is one view"));
    EXPECT_THAT(refusal("p { type motionPictures; tines (0.1); }"), HasSubstr("Did you mean times"));
}
