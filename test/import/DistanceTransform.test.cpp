// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
#include "import/plane/DistanceTransform.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>

namespace drystone
{
namespace
{

/// From each pixel to all that are marked.
double nearestSquare(const Raster<std::uint8_t>& isMarked, int x, int y)
{
    double least = std::numeric_limits<double>::max();
    forEachPixel(isMarked,
                 [&](int px, int py)
                 {
                     if (isMarked.at(px, py) != 0)
                     {
                         least = std::min(least, double((x - px) * (x - px) + (y - py) * (y - py)));
                     }
                 });
    return least;
}

TEST(DistanceTransform, FindsTheNearestMarkOfRandomPictures)
{
    std::mt19937 random(1);
    for (int picture = 0; picture < 50; ++picture)
    {
        Raster<std::uint8_t> isMarked = rasterOf<std::uint8_t>(1 + picture % 9, 1 + picture % 7, 0);
        forEachPixel(isMarked, [&](int x, int y) { isMarked.at(x, y) = random() % 6 == 0 ? 1 : 0; });
        isMarked.at(picture % isMarked.width, picture % isMarked.height) = 1;
        const Raster<double> squares = squaredDistances(isMarked);
        forEachPixel(squares, [&](int x, int y)
                     { EXPECT_EQ(squares.at(x, y), nearestSquare(isMarked, x, y)) << picture; });
    }
}

TEST(DistanceTransform, OfNothingMarkedIsFar)
{
    const Raster<double> squares = squaredDistances(rasterOf<std::uint8_t>(4, 3, 0));
    EXPECT_GT(*std::min_element(squares.pixels.begin(), squares.pixels.end()), 1e14);
}

} // namespace
} // namespace drystone
