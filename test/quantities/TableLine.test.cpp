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
