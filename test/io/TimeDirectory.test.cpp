// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// States: read back bit for bit, whole or not at all.
#include "io/TimeDirectory.h"
#include "Scene.h"
#include "core/Error.h"
#include "dictionary/Dictionary.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>

#include <csignal>
#include <sys/resource.h>

namespace drystone
{

namespace
{

using test::content;
using test::ScratchFolder;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

std::vector<std::uint64_t> bits(const std::vector<double>& values)
{
    std::vector<std::uint64_t> result;
    for (const double value : values)
    {
        result.push_back(std::bit_cast<std::uint64_t>(value));
    }
    return result;
}

/// Doubles of every size and sign, the smallest, the largest and minus zero among them.
std::vector<double> hardNumbers()
{
    using limits = std::numeric_limits<double>;
    std::vector<double> values{
        0.0,     -0.0, limits::denorm_min(), limits::min(), limits::max(),        -limits::max(), 0.1,
        1.0 / 3, 1e22, 123456789012345678.0, 5e-324,        1 + limits::epsilon()};
    std::mt19937_64 random(42);
    while (values.size() < 1000)
    {
        const double value = std::bit_cast<double>(random());
        if (std::isfinite(value))
        {
            values.push_back(value);
        }
    }
    return values;
}

class EveryFormat : public testing::TestWithParam<WriteFormat>
{
};

TEST_P(EveryFormat, GivesTheSameBitsBack)
{
    const ScratchFolder folder;
    State state;
    state.scalars["time"] = 0.1 + 0.2;
    state.scalars["energyLoss"] = -1e-300;
    state.arrays["displacement"] = hardNumbers();
    state.arrays["empty"] = {};
    state.arrays["single"] = {-0.0};
    writeState(folder.path(), "0.3", state, GetParam());
    const State back = readState(folder / "0.3/state");
    EXPECT_EQ(back.scalars, state.scalars);
    ASSERT_EQ(back.arrays.size(), 3u);
    for (const auto& [name, values] : state.arrays)
    {
        EXPECT_EQ(bits(stateArray(back, name, values.size())), bits(values)) << name;
    }
}

TEST_P(EveryFormat, CutAnywhereIsRefusedOrComplete)
{
    const ScratchFolder folder;
    State state;
    state.scalars["a"] = 1.5;
    state.arrays["b"] = {1, 2, 3};
    const std::string text = stateText(state, GetParam());
    int refused = 0;
    for (std::size_t size = 0; size + 1 < text.size(); ++size) // the last line end is not required
    {
        std::ofstream(folder / "state", std::ios::binary) << text.substr(0, size);
        try
        {
            const State back = readState(folder / "state");
            // Cut between entries: the missing entry is reported by name. Without its checksum it is
            // complete.
            const bool isComplete = size + 1 >= text.rfind("\nchecksum");
            EXPECT_LT(back.scalars.size() + back.arrays.size(), isComplete ? 3u : 2u) << size;
        }
        catch (const FatalError& error)
        {
            EXPECT_THAT(error.report(), AllOf(HasSubstr("/state"), HasSubstr(" at line ")));
            ++refused;
        }
    }
    EXPECT_GT(refused, static_cast<int>(text.size()) / 2);
}

TEST_P(EveryFormat, DamagedIsRefusedOrReadButNeverCrashes)
{
    const ScratchFolder folder;
    State state;
    state.scalars["time"] = 0.25;
    state.arrays["velocity"] = {1, 2, 3, 4.5e-300};
    const std::string text = stateText(state, GetParam());
    std::mt19937 random(11);
    int refused = 0;
    for (int i = 0; i < 1000; ++i)
    {
        std::string damaged = text;
        for (int k = 0; k < 3; ++k)
        {
            damaged[random() % damaged.size()] = static_cast<char>(random());
        }
        std::ofstream(folder / "state", std::ios::binary) << damaged;
        try
        {
            for (const auto& [name, values] : readState(folder / "state").arrays)
            {
                for (const double value : values)
                {
                    EXPECT_TRUE(std::isfinite(value)) << name;
                }
            }
        }
        catch (const FatalError&)
        {
            ++refused;
        }
    }
    EXPECT_GT(refused, 100);
}

TEST_P(EveryFormat, RefusesWhatIsNotFinite)
{
    const ScratchFolder folder;
    State state;
    state.arrays["velocity"] = {0, std::numeric_limits<double>::quiet_NaN()};
    EXPECT_THAT(reportOf([&] { writeState(folder.path(), "1", state, GetParam()); }), HasSubstr("velocity"));
    EXPECT_FALSE(std::filesystem::exists(folder / "1"));
    EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

INSTANTIATE_TEST_SUITE_P(TimeDirectory, EveryFormat,
                         testing::Values(WriteFormat::ascii, WriteFormat::binary));

TEST(TimeDirectory, ABinaryStateWithANumberThatIsNotFiniteIsRefused)
{
    const ScratchFolder folder;
    State state;
    state.arrays["velocity"] = {1.0};
    std::string text = stateText(state, WriteFormat::binary);
    const double bad = std::numeric_limits<double>::infinity();
    text.replace(text.find('(') + 1, 8, reinterpret_cast<const char*>(&bad), 8);
    std::ofstream(folder / "state", std::ios::binary) << text;
    EXPECT_THAT(reportOf([&] { readState(folder / "state"); }), HasSubstr("not a finite number"));
}

TEST_P(EveryFormat, AnotherNumberThanWasWrittenIsRefusedUnlessTheChecksumIsRemoved)
{
    const ScratchFolder folder;
    State state;
    state.scalars["time"] = 0.25;
    state.arrays["velocity"] = {1.0, 2.0};
    std::string text = stateText(state, GetParam());
    text.replace(text.find("0.25"), 4, "0.35");
    std::ofstream(folder / "state", std::ios::binary) << text;
    EXPECT_THAT(reportOf([&] { readState(folder / "state"); }),
                AllOf(HasSubstr("checksum does not fit"), HasSubstr("/state")));
    text = stateText(state, GetParam()) + "time 0.35;\n"; // which would count
    std::ofstream(folder / "state", std::ios::binary) << text;
    EXPECT_THAT(reportOf([&] { readState(folder / "state"); }), HasSubstr("checksum does not fit"));
    std::ofstream(folder / "state", std::ios::binary) << text.erase(text.rfind("\nchecksum") + 1);
    EXPECT_EQ(stateScalar(readState(folder / "state"), "time"), 0.25);
}

TEST(TimeDirectory, AnAsciiStateIsADictionaryLikeAnyOther)
{
    State state;
    state.scalars["time"] = 0.1 + 0.2;
    state.arrays["velocity"] = hardNumbers();
    state.arrays["empty"] = {};
    const Dictionary dictionary = Dictionary::readString(stateText(state, WriteFormat::ascii));
    EXPECT_EQ(dictionary.get<double>("time"), 0.1 + 0.2);
    EXPECT_EQ(bits(dictionary.get<std::vector<double>>("velocity")), bits(state.arrays["velocity"]));
    EXPECT_TRUE(dictionary.get<std::vector<double>>("empty").empty());
}

TEST_P(EveryFormat, GivesTextsBack)
{
    const ScratchFolder folder;
    State state;
    state.scalars["time"] = 0.5;
    state.texts["input"] = {"0123456789abcdef constant/g", "", "a (b; { c"};
    state.arrays["velocity"] = {1, 2};
    writeState(folder.path(), "0.5", state, GetParam());
    const State back = readState(folder / "0.5/state");
    EXPECT_EQ(back.texts, state.texts);
    EXPECT_EQ(back.scalars, state.scalars);
    EXPECT_EQ(back.arrays, state.arrays);
    if (GetParam() == WriteFormat::ascii)
    {
        EXPECT_EQ(Dictionary::readFile(folder / "0.5/state").get<std::vector<std::string>>("input"),
                  state.texts["input"]);
    }
    state.texts["input"] = {"a \"quote\""};
    EXPECT_THAT(reportOf([&] { stateText(state, GetParam()); }), HasSubstr("put between quotes"));
}

TEST(TimeDirectory, TextsThatEndTooEarlyAreErrors)
{
    const ScratchFolder folder;
    for (const char* text : {"input 1 (\"a", "input 2 (\"a\");", "input 1 (\"a\" \"b\");",
                             "input 1 (\"a\n\");", "input 1 (\"a\"", "input 2 (\"a\" 3);"})
    {
        std::ofstream(folder / "state") << text;
        EXPECT_THAT(reportOf([&] { readState(folder / "state"); }),
                    AllOf(HasSubstr("/state"), HasSubstr(" at line ")))
            << text;
    }
}

TEST(TimeDirectory, AStateMayBeEditedByHand)
{
    const ScratchFolder folder;
    std::ofstream(folder / "state")
        << "/* my\n state */\ntime 1e-3; // s\nvelocity 2 ( 1\n -2.5 );\nnone 0();\n";
    const State state = readState(folder / "state");
    EXPECT_EQ(stateScalar(state, "time"), 1e-3);
    EXPECT_THAT(stateArray(state, "velocity", 2), ElementsAre(1, -2.5));
    EXPECT_TRUE(stateArray(state, "none", 0).empty());
}

TEST(TimeDirectory, ErrorsOfAStateNameFileAndLine)
{
    const ScratchFolder folder;
    const auto read = [&](const std::string& text)
    {
        std::ofstream(folder / "state") << text;
        return reportOf([&] { readState(folder / "state"); });
    };
    EXPECT_THAT(read("time 1;\nvelocity 2(1 x);\n"), HasSubstr("state/velocity at line 2"));
    EXPECT_THAT(read("time 1;\nvelocity 3(1 2);\n"), HasSubstr("says that it has 3 values, but has 2"));
    EXPECT_THAT(read("time nan;\n"), HasSubstr("state/time at line 1"));
    EXPECT_THAT(read("time 1\nvelocity 2;\n"), HasSubstr("Is a `;` missing at the end of line 1?"));
    EXPECT_THAT(read("a 99999999999999(1);\n"), HasSubstr("says that it has 99999999999999 values"));
    EXPECT_THAT(read("a -1(1);\n"), HasSubstr("A list cannot have -1 values"));
    EXPECT_THAT(read("\n\n/* never\n"), HasSubstr("not closed"));
    // A name that is damaged into a comment leaves its list alone.
    EXPECT_THAT(read("time 1;\n//ntactGap 2\n(\n0.2\n0\n);\n"),
                HasSubstr("is no name of an entry of a state"));
    EXPECT_THAT(reportOf([&] { readState(folder / "absent/state"); }), HasSubstr("absent/state"));
    EXPECT_THAT(reportOf([&] { readState(folder.path()); }), HasSubstr("is a directory"));
    EXPECT_THAT(read(std::string("\x7f"
                                 "ELF\0\0\x01\x02",
                                 8)),
                HasSubstr("state at line 1"));
}

TEST(TimeDirectory, MissingOrMissizedEntriesNameTheFile)
{
    const ScratchFolder folder;
    State state;
    state.arrays["velocity"] = {1, 2, 3};
    writeState(folder.path(), "2", state, WriteFormat::ascii);
    const State back = readState(folder / "2/state");
    EXPECT_THAT(reportOf([&] { stateScalar(back, "time"); }),
                AllOf(HasSubstr("has no entry time"), HasSubstr("remove the time directory"),
                      HasSubstr("2/state at line 1")));
    std::ofstream(folder / "empty") << "";
    EXPECT_THAT(reportOf([&] { stateScalar(readState(folder / "empty"), "time"); }),
                AllOf(HasSubstr("holds nothing"), HasSubstr("remove the time directory"),
                      HasSubstr("empty at line 1")));
    EXPECT_THAT(reportOf([&] { stateArray(back, "rotation", 3); }), HasSubstr("rotation"));
    EXPECT_THAT(reportOf([&] { stateArray(back, "velocity", 6); }),
                HasSubstr("3 values where this case needs 6"));
}

TEST(TimeDirectory, TimesAreListedInOrderAndOtherFoldersLeftOut)
{
    const ScratchFolder folder;
    for (const char* name :
         {"0", "10", "2", "0.5", "1e-05", "constant", "system", "VTK", "0.orig", "-1", ".3.77.tmp"})
    {
        std::filesystem::create_directory(folder / name);
    }
    std::ofstream(folder / "3") << "a file";
    std::vector<std::string> names;
    for (const TimeDirectory& directory : timeDirectories(folder.path()))
    {
        names.push_back(directory.name);
    }
    EXPECT_THAT(names, ElementsAre("-1", "0", "1e-05", "0.5", "2", "10"));
    EXPECT_TRUE(timeDirectories(folder / "absent").empty());
}

TEST(TimeDirectory, WritingIntoADirectoryThatExistsKeepsItsOtherFiles)
{
    const ScratchFolder folder;
    std::filesystem::create_directory(folder / "0");
    std::ofstream(folder / "0/motion") << "mine";
    State state;
    state.scalars["time"] = 0;
    writeState(folder.path(), "0", state, WriteFormat::ascii);
    state.scalars["time"] = 1;
    writeState(folder.path(), "0", state, WriteFormat::ascii);
    EXPECT_EQ(content(folder / "0/motion"), "mine");
    EXPECT_EQ(stateScalar(readState(folder / "0/state"), "time"), 1);
}

std::vector<std::string> namesOfTimes(const std::filesystem::path& folder)
{
    std::vector<std::string> names;
    for (const TimeDirectory& directory : timeDirectories(folder))
    {
        names.push_back(directory.name);
    }
    return names;
}

TEST(TimeDirectory, PurgeKeepsTheLastOnesOfThisRunAndAllOfOthers)
{
    const ScratchFolder folder;
    State state;
    writeState(folder.path(), "0", state, WriteFormat::ascii);
    writeState(folder.path(), "0.25", state, WriteFormat::ascii);
    {
        StateWriter writer(folder.path(), WriteFormat::binary, 2);
        for (const char* name : {"0.5", "1", "1.5", "2", "2.5"})
        {
            writer.write(name, state);
        }
    }
    EXPECT_THAT(namesOfTimes(folder.path()), ElementsAre("0", "0.25", "2", "2.5"));
    for (const auto& entry : std::filesystem::directory_iterator(folder.path()))
    {
        EXPECT_NE(entry.path().filename().string().front(), '.');
    }
}

// As OpenFOAM has it: what a run writes counts, also where an earlier run has written before.
TEST(TimeDirectory, ARepeatedRunKeepsAsManyStatesAsTheFirst)
{
    const ScratchFolder folder;
    for (int run = 0; run < 3; ++run)
    {
        StateWriter writer(folder.path(), WriteFormat::ascii, 1);
        for (const char* name : {"1", "2", "3", "3"}) // a signal writes what was due anyway
        {
            writer.write(name, {});
        }
        EXPECT_THAT(namesOfTimes(folder.path()), ElementsAre("3")) << "run " << run;
    }
}

TEST(TimeDirectory, WhatAUserHasPutIntoATimeBeforeARunIsNotPurged)
{
    const ScratchFolder folder;
    writeState(folder.path(), "1", {}, WriteFormat::ascii);
    std::ofstream(folder / "1/notes") << "mine";
    StateWriter writer(folder.path(), WriteFormat::ascii, 1);
    for (const char* name : {"1", "2", "3"})
    {
        writer.write(name, {});
    }
    EXPECT_THAT(namesOfTimes(folder.path()), ElementsAre("1", "3"));
    EXPECT_EQ(content(folder / "1/notes"), "mine");
}

TEST(TimeDirectory, AStateWrittenOverALongerOneIsWhole)
{
    const ScratchFolder folder;
    State longer;
    longer.arrays["velocity"].assign(1000, 1.0 / 3);
    State shorter;
    shorter.arrays["velocity"] = {1, 2};
    StateWriter writer(folder.path(), WriteFormat::ascii, 1);
    writer.write("1", longer);
    writer.write("2", longer); // in a new directory, and that of 1 is purged
    writer.write("3", shorter);
    const ScratchFolder reference;
    writeState(reference.path(), "3", shorter, WriteFormat::ascii);
    EXPECT_EQ(content(folder / "3/state"), content(reference / "3/state"));
    EXPECT_FALSE(std::filesystem::exists(folder / "2"));
}

TEST(TimeDirectory, APurgedDirectoryTakesNothingOfAUserToAnotherTime)
{
    const ScratchFolder folder;
    StateWriter writer(folder.path(), WriteFormat::ascii, 1);
    writer.write("1", {});
    std::ofstream(folder / "1/notes") << "mine";
    writer.write("2", {});
    writer.write("3", {});
    EXPECT_FALSE(std::filesystem::exists(folder / "1"));
    EXPECT_FALSE(std::filesystem::exists(folder / "3/notes"));
    EXPECT_TRUE(std::filesystem::exists(folder / "3/state"));
}

TEST(TimeDirectory, WhatAKilledRunHadPurgedIsTheNextOnesState)
{
    const ScratchFolder folder;
    writeState(folder.path(), ".purgedState", {}, WriteFormat::ascii);
    State state;
    state.scalars["time"] = 2;
    {
        StateWriter writer(folder.path(), WriteFormat::ascii, 1);
        writer.write("2", state);
    }
    EXPECT_EQ(stateScalar(readState(folder / "2/state"), "time"), 2);
    EXPECT_FALSE(std::filesystem::exists(folder / ".purgedState"));
}

TEST(TimeDirectory, ACaseThatCannotBeWrittenIsNamed)
{
    const ScratchFolder folder;
    std::ofstream(folder / "case") << "a file";
    EXPECT_THAT(reportOf([&] { writeState(folder / "case", "1", {}, WriteFormat::ascii); }),
                HasSubstr("case/"));
}

TEST(TimeDirectory, AFullDiskLeavesNothingBehind)
{
    // A limit to the size of files fails as a full disk does, with the first bytes written.
    const ScratchFolder folder;
    rlimit before{};
    ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &before), 0);
    const auto handler = std::signal(SIGXFSZ, SIG_IGN);
    const rlimit small{100, before.rlim_max};
    ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &small), 0);
    State state;
    state.arrays["displacement"] = std::vector<double>(1000, 1.25);
    const std::string message =
        reportOf([&] { writeState(folder.path(), "0.19", state, WriteFormat::ascii); });
    ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &before), 0);
    std::signal(SIGXFSZ, handler);
    EXPECT_THAT(message, HasSubstr("0.19"));
    EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

} // namespace

} // namespace drystone
