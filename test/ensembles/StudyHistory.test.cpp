// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Histories of studies: rows are read and checked, and what is damaged is said with file and line.
#include "ensembles/StudyHistory.h"

#include "../ReportOf.h"
#include "core/WholeFile.h"

#include <fmt/format.h>

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

using namespace drystone;
using testing::HasSubstr;

namespace
{

const std::string how = inputLines({}, "# ");
const std::string heading = how + "# input 0123456789abcdef constant/g\n# a[-] b[m]\n";

enum class Side
{
    left,
    right
};
std::array<std::pair<std::string_view, Side>, 2> namesOf(Side)
{
    return {{{"left", Side::left}, {"right", Side::right}}};
}

class StudyHistory : public testing::Test
{
protected:
    void SetUp() override
    {
        folder = std::filesystem::temp_directory_path() / fmt::format("drystone-study-{}", ::getpid());
        file = folder / "history.dat";
    }
    void TearDown() override { std::filesystem::remove_all(folder); }

    std::vector<HistoryRow> rowsOf(const std::string& text) const
    {
        writeWholeFile(file, text);
        return readHistory(file, heading, 2, "search");
    }
    /// What is reported of a text, or of the number that `take` takes from its last row.
    std::string faultOf(
        const std::string& text,
        const std::function<void(const HistoryRow&)>& take = [](const HistoryRow&) {}) const
    {
        return reportOf(
            [&]
            {
                const std::vector<HistoryRow> rows = rowsOf(text);
                take(rows.back());
            });
    }

    std::filesystem::path folder;
    std::filesystem::path file;
};

TEST_F(StudyHistory, NoFileHasNoRows)
{
    EXPECT_TRUE(readHistory(file, heading, 2, "search").empty());
    EXPECT_EQ(changedHistory(file, heading, "search"), "");
}

TEST_F(StudyHistory, NumbersAreReadAsTheyAre)
{
    EXPECT_TRUE(rowsOf(heading).empty());
    const std::vector<HistoryRow> rows = rowsOf(heading + "1 0.25\n0 nan\n");
    ASSERT_EQ(rows.size(), 2u);
    EXPECT_EQ(rows[0].whole(0, 0, 1), 1);
    EXPECT_EQ(rows[0].choice<Side>(0), Side::right);
    EXPECT_EQ(rows[0].finite(1, 0), 0.25);
    EXPECT_TRUE(std::isnan(rows[1].number(1)));
}

TEST_F(StudyHistory, NumbersThatAColumnDoesNotTakeAreNamedWithTheirLine)
{
    for (const char* number : {"-1", "2", "0.5", "1e300", "-1e300", "nan", "inf"})
    {
        const std::string fault =
            faultOf(heading + number + " 1\n", [](const HistoryRow& row) { row.choice<Side>(0); });
        EXPECT_THAT(fault, HasSubstr("a[-], column 1 of a row of the history, is "));
        EXPECT_THAT(fault, HasSubstr("it takes whole numbers from 0 to 1"));
        EXPECT_THAT(fault, HasSubstr("history.dat at line 4."));
    }
    for (const char* number : {"-1", "nan", "inf"})
    {
        EXPECT_THAT(
            faultOf(heading + "1 1\n1 " + number + "\n", [](const HistoryRow& row) { row.finite(1, 0); }),
            testing::AllOf(HasSubstr("b[m], column 2"), HasSubstr("history.dat at line 5.")));
    }
}

TEST_F(StudyHistory, RowsOfOtherLengthsAndOfOneThatIsCutOffAreNamedWithTheirLine)
{
    for (const char* row : {"1\n", "1 2 3\n", "1 x\n", "\n", "1 2"})
    {
        EXPECT_THAT(faultOf(heading + "1 1\n" + row),
                    testing::AllOf(HasSubstr("history.dat at line 5."), HasSubstr("Remove the row")))
            << row;
    }
}

TEST_F(StudyHistory, ARowThatWasChangedIsNamedWithItsLine)
{
    const std::string row = historyRow("1 0.25");
    ASSERT_EQ(rowsOf(heading + "0 0.5\n" + row + row).size(), 3u);
    EXPECT_EQ(rowsOf(heading + row)[0].number(1), 0.25);
    for (std::size_t at = 0; at + 1 < row.size(); ++at)
    {
        std::string changed = row;
        changed[at] = changed[at] == '3' ? '4' : '3';
        EXPECT_THAT(faultOf(heading + "0 0.5\n" + changed + row),
                    testing::AllOf(HasSubstr("history.dat at line 5."), HasSubstr("emove the row")))
            << changed;
    }
    EXPECT_THAT(faultOf(heading + row.substr(0, row.size() - 4)), HasSubstr("cut off in its last row"));
}

TEST_F(StudyHistory, ADamagedFileIsNotThatOfOtherInput)
{
    EXPECT_THAT(faultOf(""), HasSubstr("The history is damaged: it is empty."));
    EXPECT_THAT(faultOf("garbage\n1 2\n"), HasSubstr("damaged: it does not begin with the heading"));
    for (const std::size_t length : {5, 20, 40})
    {
        EXPECT_THAT(faultOf(heading.substr(0, length)),
                    HasSubstr("damaged: it is cut off before its first row"));
    }
    EXPECT_THAT(faultOf(how + "# input 0000000000000000 constant/g\n"), HasSubstr("damaged: it is cut off"));
    EXPECT_THAT(faultOf(""), HasSubstr("Remove postProcessing/search to start again."));
    EXPECT_THAT(faultOf(""), HasSubstr("history.dat at line 1."));
    std::filesystem::remove(file);
    std::filesystem::create_directories(file);
    EXPECT_THROW(readHistory(file, heading, 2, "search"), FatalError);
}

TEST_F(StudyHistory, OtherInputIsNamed)
{
    EXPECT_THAT(
        faultOf(how + "# input 0000000000000001 constant/g\n# a[-] b[m]\n1 2\n"),
        HasSubstr("belongs to another search, so that it cannot be continued: constant/g has changed"));
    EXPECT_THAT(faultOf(how + "# input 0123456789abcdef constant/g\n# a[-] c[m]\n1 2\n"),
                HasSubstr("what system/searchDict requests of a run has changed"));
    EXPECT_THAT(faultOf("# input 0123456789abcdef constant/g\n# a[-] b[m]\n1 2\n"),
                HasSubstr("an older version has begun it"));
}

} // namespace
