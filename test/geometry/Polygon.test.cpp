// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Areas and moments of polygons against closed forms.
#include "geometry/Polygon.h"

#include <gtest/gtest.h>

#include <numbers>

using namespace drystone;

namespace
{

TEST(Polygon, ARectangleFarFromTheOriginKeepsItsMoments)
{
    const double x = 1e6;
    const double y = -3e5;
    const AreaProperties area = areaProperties({{x, y}, {x + 2, y}, {x + 2, y + 0.5}, {x, y + 0.5}});
    EXPECT_DOUBLE_EQ(area.area, 1);
    EXPECT_DOUBLE_EQ(area.centroid.x(), x + 1);
    EXPECT_DOUBLE_EQ(area.centroid.y(), y + 0.25);
    EXPECT_NEAR(area.polarMoment, 1 * (4 + 0.25) / 12, 1e-15);
}

TEST(Polygon, AreaOfAConcaveOutlineIsSigned)
{
    const Polygon counterClockwise{{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}};
    const Polygon clockwise(counterClockwise.rbegin(), counterClockwise.rend());
    EXPECT_DOUBLE_EQ(areaProperties(counterClockwise).area, 3);
    EXPECT_DOUBLE_EQ(areaProperties(clockwise).area, -3);
    // Three unit squares with centres (.5 .5), (1.5 .5), (.5 1.5).
    EXPECT_NEAR(areaProperties(counterClockwise).centroid.x(), 2.5 / 3, 1e-15);
    EXPECT_NEAR(areaProperties(clockwise).centroid.y(), 2.5 / 3, 1e-15);
}

TEST(Polygon, VerticesThatSplitAStraightEdgeAreLeftOutWhereverTheListStarts)
{
    Polygon square{{0, 0}, {0.3, 0}, {0.7, 0}, {1, 0}, {1, 0.5}, {1, 1}, {0, 1}, {0, 0.9}, {0, 0.1}};
    for (std::size_t shift = 0; shift < square.size(); ++shift)
    {
        EXPECT_EQ(withoutStraightVertices(square, 1e-9).size(), 4U) << shift;
        std::rotate(square.begin(), square.begin() + 1, square.end());
    }
}

TEST(Polygon, AFineCircleIsNotStraightenedAwayBitByBit)
{
    // Each vertex is only 5e-7 off the chord of its neighbours, below the tolerance; the run of them is not.
    Polygon circle;
    for (int i = 0; i < 3142; ++i)
    {
        const double angle = 2 * std::numbers::pi * i / 3142;
        circle.emplace_back(std::cos(angle), std::sin(angle));
    }
    const double tolerance = 1e-5;
    const Polygon kept = withoutStraightVertices(circle, tolerance);
    // A chord of sagitta s on the unit circle has area 4/3 s sqrt(2 s) less than its arc; with s <= tolerance
    // the loss is below 2 pi tolerance.
    EXPECT_LT(areaProperties(circle).area - areaProperties(kept).area, 2 * std::numbers::pi * tolerance);
    EXPECT_LT(kept.size(), 1600U);
}

} // namespace
