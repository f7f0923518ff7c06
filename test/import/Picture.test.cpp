// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Stones of pictures that are drawn with letters.
#include "import/plane/Picture.h"

#include "ImportTesting.h"
#include "import/plane/Photograph.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

using namespace drystone;

namespace
{

/// The stones of a picture in which `#` is dark, without mortar to grow into.
StoneRaster stonesOf(const std::vector<std::string>& rows)
{
    Raster<std::uint8_t> picture{static_cast<int>(rows.front().size()), static_cast<int>(rows.size()), {}};
    for (const std::string& row : rows)
    {
        for (const char pixel : row)
        {
            picture.pixels.push_back(pixel == '#' ? 0 : 255);
        }
    }
    StoneSettings settings;
    settings.leastArea = 1;
    settings.mortar = 0;
    return labelStones(picture, settings);
}

std::string textOf(const StoneRaster& stones)
{
    std::string text;
    for (int y = 0; y < stones.labels.height; ++y)
    {
        for (int x = 0; x < stones.labels.width; ++x)
        {
            const int stone = stones.labels.at(x, y);
            text += stone == noStone ? '.' : static_cast<char>('0' + stone);
        }
        text += '\n';
    }
    return text;
}

TEST(Picture, TheStripAtTheBaseIsAsWideAsTheStonesInItAndBelow)
{
    Raster<std::uint8_t> picture{8, 4, std::vector<std::uint8_t>(32, 255)};
    for (const auto& [x, y] :
         {std::pair(0, 0), std::pair(1, 1), std::pair(5, 1), std::pair(3, 2), std::pair(6, 2)})
    {
        picture.at(x, y) = 0;
    }
    StoneSettings settings;
    settings.leastArea = 1;
    settings.mortar = 0;
    settings.base = 2;
    const std::string text = textOf(labelStones(picture, settings));
    std::string isTaken = text;
    for (char& stone : isTaken)
    {
        stone = stone >= '0' && stone <= '9' ? '#' : stone;
    }
    EXPECT_EQ(isTaken, "#.......\n.######.\n...####.\n........\n") << text;
    settings.base = 1'000'000'000; // of all rows
    EXPECT_NE(labelStones(picture, settings).labels.at(6, 0), noStone);
    EXPECT_EQ(labelStones(picture, settings).labels.at(7, 0), noStone);
}

TEST(Picture, AHoleIsPartOfItsStone)
{
    const StoneRaster stones = stonesOf({".####.##", ".#..#.##", ".#..#.##", ".####..."});
    EXPECT_EQ(textOf(stones), ".0000.11\n.0000.11\n.0000.11\n.0000...\n");
    EXPECT_EQ(stones.filled, (std::vector<int>{4, 0}));
}

TEST(Picture, StonesWithinAStoneArePartOfIt)
{
    // A stone that lies free in the hole, with a hole of its own and a stone in that, and one beside it.
    const StoneRaster stones = stonesOf({
        "###########", //
        "#.........#", //
        "#.#####...#", //
        "#.#...#.#.#", //
        "#.#.#.#.#.#", //
        "#.#...#...#", //
        "#.#####...#", //
        "#.........#", //
        "###########", //
    });
    EXPECT_EQ(stones.count, 1);
    EXPECT_EQ(stones.filled, std::vector<int>{9 * 7});
}

TEST(Picture, WhatOpensToTheOutsideOrToTwoStonesIsNoHole)
{
    const StoneRaster open = stonesOf({"####", "#..#", "#..#", "#..#"});
    EXPECT_EQ(open.filled, std::vector<int>{0});
    // Two stones that touch at a corner surround the area between them; none alone does.
    const StoneRaster two = stonesOf({
        "####.", //
        "#..#.", //
        "#....", //
        "#.#.#", //
        "..###", //
    });
    EXPECT_EQ(two.filled, std::vector<int>(static_cast<std::size_t>(two.count), 0));
    EXPECT_EQ(two.labels.at(1, 1), noStone);
}

TEST(Picture, WithoutStonesHasNone)
{
    EXPECT_EQ(stonesOf({"...", "..."}).count, 0);
}

// A point that is not in the picture makes its scale wrong.
TEST(Photograph, PointsOfKnownDistanceAreInThePicture)
{
    const std::filesystem::path tutorial =
        std::filesystem::path(DRYSTONE_SOURCE_DIR) / "tutorials/limitAnalysis/photographedRubble";
    Photograph photograph;
    photograph.file = "constant/triSurface/wall.png";
    photograph.distance = 3.5;
    const auto report = [&](const Vector<2>& first, const Vector<2>& second)
    {
        photograph.points = {first, second};
        return reportOf([&] { makeAssembly(photograph, tutorial, {}); });
    };
    EXPECT_EQ(report({30, 295}, {450, 295}), "no error");
    for (const Vector<2>& outside : {Vector<2>(45000, 295), Vector<2>(450, 2950), Vector<2>(-450, 295)})
    {
        EXPECT_THAT(report({30, 295}, outside),
                    testing::HasSubstr("outside of this picture of 480 x 320 pixels"));
        // The points are wrong, not the picture.
        EXPECT_THAT(reportOf(
                        [&]
                        {
                            makeAssembly(photograph, tutorial, {"system/blockTextureDict", "texture/file", 7},
                                         {"system/blockTextureDict", "texture/points", 8});
                        }),
                    testing::HasSubstr("texture/points at line 8"));
    }
}

// Borders within 100 pixels took up to four fifths of the stones without a word.
TEST(Photograph, BordersThatTakeStonesAwayAreWarnedOf)
{
    const std::filesystem::path tutorial =
        std::filesystem::path(DRYSTONE_SOURCE_DIR) / "tutorials/limitAnalysis/photographedRubble";
    Photograph photograph;
    photograph.file = "constant/triSurface/wall.png";
    photograph.distance = 3.5;
    photograph.points = {{30, 295}, {450, 295}};
    const auto warningWith = [&](double tolerance)
    {
        photograph.tolerance = tolerance;
        testing::internal::CaptureStderr();
        makeAssembly(photograph, tutorial, {});
        return testing::internal::GetCapturedStderr();
    };
    EXPECT_EQ(warningWith(0), "");
    EXPECT_EQ(warningWith(1.5), "");
    EXPECT_THAT(warningWith(100), testing::HasSubstr("smaller `tolerance`"));
}

} // namespace
