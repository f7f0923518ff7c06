// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Rows of journals come back as they were written, or not at all.
#include "ensembles/SampleStore.h"

#include "core/WholeFile.h"

#include <fmt/format.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

using namespace drystone;
using testing::HasSubstr;

namespace
{

class JournalTest : public testing::Test
{
protected:
    void SetUp() override
    {
        folder = std::filesystem::temp_directory_path() / fmt::format("drystone-journal-{}", ::getpid());
        std::filesystem::create_directories(folder);
        Journal journal(folder / "journal.a");
        for (long sample = 3; sample < 6; ++sample)
        {
            journal.add(sample, {SampleStatus::done, 1, 0.25, {0.1 * static_cast<double>(sample), 1e-300}});
        }
        journal.sync();
    }
    void TearDown() override { std::filesystem::remove_all(folder); }

    std::map<long, SampleRow> read() { return readJournals(folder, 2, &doubts); }

    /// Replaces something in the journal.
    void change(const std::string& before, const std::string& after) const
    {
        std::string text = contentOfFile(folder / "journal.a");
        const std::size_t at = text.find(before);
        ASSERT_NE(at, text.npos) << text;
        writeWholeFile(folder / "journal.a", text.replace(at, before.size(), after));
    }

    std::filesystem::path folder;
    std::vector<Doubt> doubts;
};

TEST_F(JournalTest, RowsComeBackToTheLastBit)
{
    const auto rows = read();
    ASSERT_EQ(rows.size(), 3u);
    EXPECT_EQ(rows.at(4).results, (std::vector<double>{0.1 * 4.0, 1e-300}));
    EXPECT_EQ(rows.at(4).attempts, 1);
    EXPECT_TRUE(doubts.empty());
}

// Whatever changes in a row, it is not taken for one; what is not there is computed again.
TEST_F(JournalTest, ARowThatWasChangedIsNamedAndNotUsed)
{
    for (const auto& [before, after] :
         std::vector<std::pair<std::string, std::string>>{{"\n4 0 1", "\n4 1 1"},
                                                          {"\n4 0 1", "\n7 0 1"},
                                                          {"0.25 0.4", "0.25 0.5"},
                                                          {"\n4 ", "\n\xff "},
                                                          {"\n4 0", std::string("\n4\0000", 4)}})
    {
        TearDown();
        SetUp();
        doubts.clear();
        change(before, after);
        const auto rows = read();
        EXPECT_EQ(rows.size(), 2u) << after;
        EXPECT_FALSE(rows.count(4)) << after;
        ASSERT_EQ(doubts.size(), 1u) << after;
        EXPECT_THAT(doubts[0].text, HasSubstr("1 row of this journal is not what was written there"));
        EXPECT_EQ(doubts[0].place.file, (folder / "journal.a").string());
        EXPECT_EQ(doubts[0].place.line, 3); // the first is empty
    }
}

// A worker that is killed leaves a part of a row, which is nothing to worry about.
TEST_F(JournalTest, ARowThatIsTornIsNotUsed)
{
    std::string text = contentOfFile(folder / "journal.a");
    writeWholeFile(folder / "journal.a", text.substr(0, text.size() - 7));
    EXPECT_EQ(read().size(), 2u);
    EXPECT_TRUE(doubts.empty());
}

TEST_F(JournalTest, RowsOfOlderVersionsHaveNoFingerprint)
{
    writeWholeFile(folder / "journal.b", "\n8 0 1 0.25 0.75 2 ;\n9 0 1 0.25 0.7x 2 ;\n");
    const auto rows = read();
    ASSERT_EQ(rows.size(), 4u);
    EXPECT_EQ(rows.at(8).results, (std::vector<double>{0.75, 2}));
    ASSERT_EQ(doubts.size(), 1u);
    EXPECT_EQ(doubts[0].place.line, 3);
}

// As where the folders of two machines are put together, and what they were computed from differs.
TEST_F(JournalTest, AJournalOfAnotherEnsembleIsNamedAndNotUsed)
{
    const auto write = [this](const std::string& plan, long sample)
    {
        writeWholeFile(folder / "plan", plan);
        Journal journal(folder / fmt::format("journal.{}", sample));
        journal.add(sample, {SampleStatus::done, 1, 0.25, {0.1, 0.2}});
        journal.sync();
    };
    write("variables 1\n", 7);
    write("variables 2\n", 8);
    const auto rows = read();
    EXPECT_EQ(rows.size(), 4u); // those of journal.a say nothing of their plan
    EXPECT_FALSE(rows.count(7));
    EXPECT_TRUE(rows.count(8));
    ASSERT_EQ(doubts.size(), 1u);
    EXPECT_THAT(doubts[0].text, HasSubstr("1 row of this journal is of another ensemble"));
    EXPECT_EQ(doubts[0].place.file, (folder / "journal.7").string());
}

TEST_F(JournalTest, TwoRowsOfASampleThatDifferAreQuestioned)
{
    writeWholeFile(folder / "journal.b",
                   "4 0 1 0.5 0.4 1e-300 ;\n5 0 1 0.25 0.75 1e-300 ;\n3 2 1 0.25 nan nan ;\n");
    const auto rows = read();
    EXPECT_EQ(rows.at(5).results[0], 0.5);
    ASSERT_EQ(doubts.size(), 1u);
    EXPECT_THAT(doubts[0].text, HasSubstr("Sample 5 has other results in this row than in one before"));
    EXPECT_EQ(doubts[0].place.line, 2);
}

} // namespace
