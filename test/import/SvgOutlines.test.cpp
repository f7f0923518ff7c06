// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
#include "import/SvgOutlines.h"

#include "ImportTesting.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace drystone
{
namespace
{

using testing::ElementsAre;
using testing::HasSubstr;

SvgOutlines outlinesOf(std::string_view path)
{
    const ImportedFile file = test::fileOf("");
    DigitCount digits;
    return svgPath(SvgScanner(file, 7, path), digits);
}

TEST(SvgOutlines, FollowTheirCommandsFromCornerToCorner)
{
    const SvgOutlines absolute = outlinesOf("M1 2 5 2V4H1Z");
    ASSERT_EQ(absolute.closed.size(), 1u);
    EXPECT_THAT(absolute.closed[0],
                ElementsAre(Vector<2>(1, 2), Vector<2>(5, 2), Vector<2>(5, 4), Vector<2>(1, 4)));
    EXPECT_EQ(outlinesOf("m1 2 4 0v2h-4z").closed, absolute.closed);
}

TEST(SvgOutlines, GoOnWhereTheLastOneWasClosed)
{
    const SvgOutlines outlines = outlinesOf("M0 0 2 0 2 2Z l0 -1 1 0 0 1z");
    ASSERT_EQ(outlines.closed.size(), 2u);
    EXPECT_THAT(outlines.closed[1],
                ElementsAre(Vector<2>(0, 0), Vector<2>(0, -1), Vector<2>(1, -1), Vector<2>(1, 0)));
}

TEST(SvgOutlines, AreClosedByTheirLastCornerOrOpen)
{
    const SvgOutlines outlines = outlinesOf("M0 0 2 0 2 2 0 0 M5 5 6 5 6 6 M9 9");
    EXPECT_EQ(outlines.closed.size(), 1u);
    EXPECT_EQ(outlines.open, 1);
}

TEST(SvgOutlines, RefuseCurvesAndNumbersWithoutACommand)
{
    EXPECT_THAT(reportOf([] { outlinesOf("M0 0C1 1 2 2 3 3"); }), HasSubstr("the command `C`"));
    EXPECT_THAT(reportOf([] { outlinesOf("0 0 L 1 1"); }), HasSubstr("begins with a command"));
    EXPECT_THAT(reportOf([] { outlinesOf("M0 0 1 0 1 1 Z 3 4"); }), HasSubstr("Numbers follow"));
}

} // namespace
} // namespace drystone
