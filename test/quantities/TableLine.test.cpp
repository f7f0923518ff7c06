// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Lines of tables: words, cells between separators, and names of columns.
#include "quantities/TableLine.h"

#include <gmock/gmock.h>

#include <sstream>

namespace drystone
{
namespace
{

using testing::ElementsAre;
using testing::IsEmpty;
using testing::Optional;
using testing::Pair;

TEST(TableLine, HasWordsAndItsNumberInTheFile)
{
    std::istringstream table("# Time[s]\t alpha[-]\r\n\n0 1.5\n#2 nan");
    TableLine line;
    ASSERT_TRUE(nextLine(table, line));
    EXPECT_TRUE(line.isHeading);
    EXPECT_THAT(line.words, ElementsAre("Time[s]", "alpha[-]"));
    ASSERT_TRUE(nextLine(table, line));
    EXPECT_THAT(line.words, IsEmpty());
    ASSERT_TRUE(nextLine(table, line));
    EXPECT_FALSE(line.isHeading);
    EXPECT_EQ(line.text, "0 1.5");
    EXPECT_EQ(line.number, 3);
    ASSERT_TRUE(nextLine(table, line));
    EXPECT_TRUE(line.isHeading);
    EXPECT_THAT(line.words, ElementsAre("2", "nan"));
    EXPECT_FALSE(nextLine(table, line));
}

TEST(TableLine, HasCellsThatMayBeEmptyOrHoldBlanks)
{
    std::istringstream table("deltaT[s],flow rule ,,\n");
    TableLine line;
    ASSERT_TRUE(nextLine(table, line, ','));
    EXPECT_THAT(line.words, ElementsAre("deltaT[s]", "flow rule", "", ""));
}

// samples.dat has names of files with blanks between quotes: their rows had a word too many and were left
// out, and report said of the samples that they were missing.
TEST(TableLine, WhatIsBetweenQuotesIsOneWordWithoutThem)
{
    const auto wordsOf = [](const std::string& text, char separator)
    {
        std::istringstream table(text);
        TableLine line;
        EXPECT_TRUE(nextLine(table, line, separator));
        return line.words;
    };
    EXPECT_THAT(wordsOf("1 \"a b.dxf\"  0.5 \"\" c\"d\n", ' '),
                ElementsAre("1", "a b.dxf", "0.5", "", "c\"d"));
    EXPECT_THAT(wordsOf("1, \"a, b\" ,\"say \"\"so\"\"\",c\"d", ','),
                ElementsAre("1", "a, b", "say \"so\"", "c\"d"));
    EXPECT_THAT(wordsOf("1 \"a b", ' '), ElementsAre("1", "a b")); // cut off
}

TEST(TableLine, NumbersAreWholeWords)
{
    EXPECT_THAT(numberIn("-1.5e-3"), Optional(-1.5e-3));
    EXPECT_FALSE(numberIn("1.5m"));
    EXPECT_FALSE(numberIn(""));
}

TEST(TableLine, ColumnsAreKnownWithOrWithoutTheirUnits)
{
    EXPECT_THAT(nameAndUnit("kinetic[J]"), Pair("kinetic", "J"));
    EXPECT_THAT(nameAndUnit("a[b"), Pair("a[b", ""));
    EXPECT_TRUE(isColumn("alpha[-]", "alpha"));
    EXPECT_TRUE(isColumn("alpha[-]", "alpha[-]"));
    EXPECT_FALSE(isColumn("alphaOfDead[-]", "alpha"));
    EXPECT_THAT(findColumn(std::vector<std::string>{"Time[s]", "alpha[-]"}, "alpha"), Optional(1));
    EXPECT_FALSE(findColumn(std::vector<std::string>{"Time[s]"}, "alpha"));
}

} // namespace
} // namespace drystone
