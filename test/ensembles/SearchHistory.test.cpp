// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Points that are known are not computed again; rows that have been changed or are there twice are refused.
#include "ensembles/SearchHistory.h"

#include "../ReportOf.h"
#include "core/Error.h"
#include "core/WholeFile.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

using namespace drystone;
using testing::HasSubstr;

namespace
{

class SearchHistoryTest : public testing::Test
{
protected:
    void SetUp() override
    {
        search.caseDirectory =
            std::filesystem::temp_directory_path() / fmt::format("drystone-search-{}", ::getpid());
        search.settings = readSearchSettings(Dictionary::readString(
            "applications (limitAnalysis); variables { x { file a; entry x; bounds (-1 2); } } results { f { "
            "table t; column f; } } objective { goal minimise; value f; } search ( { algorithm BOBYQA; } );",
            "system/parameterSearchDict"));
        file = searchFolder(search.caseDirectory) / "history.dat";
    }
    void TearDown() override { std::filesystem::remove_all(search.caseDirectory); }

    /// What is reported of a text of the file.
    std::string faultOf(const std::string& text) const
    {
        writeWholeFile(file, text);
        return reportOf([&] { const SearchHistory history(search); });
    }

    ParameterSearch search;
    std::filesystem::path file;
};

TEST_F(SearchHistoryTest, PointsAreReadBackToTheLastBit)
{
    {
        SearchHistory written(search);
        written.add({{0.1 + 0.2}, {1 / 3.0}, 0, 0.25});
        written.add({{0.5}, {std::nan("")}, 1, 0.5});
    }
    const SearchHistory read(search);
    ASSERT_EQ(read.records().size(), 2u);
    ASSERT_TRUE(read.find({0.1 + 0.2}));
    EXPECT_EQ(read.find({0.1 + 0.2})->results[0], 1 / 3.0);
    EXPECT_TRUE(std::isnan(read.find({0.5})->results[0]));
    EXPECT_EQ(read.find({0.5})->exitStatus, 1);
}

TEST_F(SearchHistoryTest, ADigitThatWasChangedIsFoundInEveryColumn)
{
    {
        SearchHistory written(search);
        written.add({{0.75}, {0.25}, 0, 0.125});
        written.add({{0.5}, {0.125}, 0, 0.375});
    }
    const std::string sound = contentOfFile(file);
    EXPECT_EQ(faultOf(sound), "no error");
    const std::size_t row = sound.find("0.75");
    const std::size_t end = sound.find('\n', row);
    ASSERT_NE(end, sound.npos);
    for (std::size_t at = row; at < end; ++at)
    {
        std::string changed = sound;
        changed[at] = changed[at] == '1' ? '2' : '1';
        EXPECT_THAT(faultOf(changed),
                    testing::AllOf(HasSubstr("history.dat at line "), HasSubstr("emove the row")))
            << changed;
    }
    EXPECT_THAT(faultOf(sound.substr(0, end - 1) + sound.substr(end)),
                HasSubstr("is not what was written there"));
    // Rows of older versions say nothing of themselves.
    EXPECT_EQ(faultOf(sound + "0.625  0.5  0  0.1\n"), "no error");
}

TEST_F(SearchHistoryTest, APointThatIsThereTwiceIsRefusedWithTheLineOfTheSecond)
{
    SearchHistory(search).add({{0.75}, {0.25}, 0, 0.125});
    const std::string text = contentOfFile(file);
    const auto line = std::count(text.begin(), text.end(), '\n') + 1;
    EXPECT_THAT(faultOf(text + "0.75  0.5  0  0.1\n"),
                testing::AllOf(HasSubstr("x, column 1 of a row of the history, is 0.75: it takes what no row "
                                         "before has"),
                               HasSubstr(fmt::format("history.dat at line {}.", line))));
}

} // namespace
