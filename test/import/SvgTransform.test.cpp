// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
#include "import/SvgTransform.h"

#include "ImportTesting.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace drystone
{
namespace
{

using testing::HasSubstr;

Vector<2> movedBy(std::string_view attribute, const Vector<2>& point)
{
    const ImportedFile file = test::fileOf("");
    const SvgTransform transform = svgTransform(SvgScanner(file, 7, attribute));
    return transform.matrix * point + transform.shift;
}

TEST(SvgTransform, MovesPointsAsSvgDefines)
{
    const double tolerance = 1e-15;
    EXPECT_EQ(movedBy("", {3, 4}), Vector<2>(3, 4));
    EXPECT_EQ(movedBy("translate(2)", {3, 4}), Vector<2>(5, 4));
    EXPECT_EQ(movedBy("scale(2,3)", {3, 4}), Vector<2>(6, 12));
    EXPECT_EQ(movedBy("scale(2)", {3, 4}), Vector<2>(6, 8));
    EXPECT_EQ(movedBy("matrix(1 2 3 4 5 6)", {1, 10}), Vector<2>(36, 48));
    EXPECT_TRUE(movedBy("rotate(90)", {1, 0}).isApprox(Vector<2>(0, 1), tolerance));
    EXPECT_TRUE(movedBy("rotate(90 1 1)", {2, 1}).isApprox(Vector<2>(1, 2), tolerance));
    EXPECT_TRUE(movedBy("skewX(45)", {1, 2}).isApprox(Vector<2>(3, 2), tolerance));
    EXPECT_TRUE(movedBy("skewY(45)", {1, 2}).isApprox(Vector<2>(1, 3), tolerance));
}

TEST(SvgTransform, OfSeveralBeginsWithTheLast)
{
    EXPECT_EQ(movedBy("translate(10 0) scale(2)", {1, 1}), Vector<2>(12, 2));
    EXPECT_EQ(movedBy("scale(2) translate(10 0)", {1, 1}), Vector<2>(22, 2));
}

TEST(SvgTransform, RefusesOtherNamesAndNumbersOfValues)
{
    const auto report = [](std::string_view attribute) {
        return reportOf([&] { movedBy(attribute, {0, 0}); });
    };
    EXPECT_THAT(report("turn(3)"), HasSubstr("`turn` with 1 numbers is not known"));
    EXPECT_THAT(report("matrix(1 2 3)"), HasSubstr("`matrix` with 3 numbers is not known"));
    EXPECT_THAT(report("scale 2"), HasSubstr("has no `(`"));
    EXPECT_THAT(report("scale(2"), HasSubstr("has no `)`"));
}

} // namespace
} // namespace drystone
