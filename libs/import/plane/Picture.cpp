// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Reading of a picture and labelling of the stones in it.
#include "import/plane/Picture.h"

#include "import/plane/DistanceTransform.h"
#include "import/plane/FilledHoles.h"

#include <fmt/format.h>
#include <png.h>

#include <algorithm>
#include <queue>

namespace drystone
{

namespace
{

constexpr std::size_t mostPixels = 50'000'000;
/// Stones as they are in the picture.
Raster<int> findStones(const Raster<std::uint8_t>& brightness, const StoneSettings& settings, int& count)
{
    const auto isStone = [&](int x, int y)
    { return (brightness.at(x, y) > settings.threshold) == settings.areLight; };
    Raster<int> labels = rasterOf(brightness.width, brightness.height, noStone);
    Raster<std::uint8_t> isReached = rasterOf<std::uint8_t>(brightness.width, brightness.height, 0);
    count = 0;
    forEachPixel(labels,
                 [&](int x, int y)
                 {
                     if (isReached.at(x, y) != 0 || !isStone(x, y))
                     {
                         return;
                     }
                     const auto area = areaFrom(x, y, isStone, isReached);
                     if (static_cast<int>(area.size()) < settings.leastArea)
                     {
                         return;
                     }
                     for (const auto& [px, py] : area)
                     {
                         labels.at(px, py) = count;
                     }
                     ++count;
                 });
    return labels;
}

/// What stones may grow over: their closing, and the strip at their base.
Raster<std::uint8_t> roomOf(const Raster<int>& labels, const StoneSettings& settings)
{
    const double reach = settings.mortar / 2.0 + 0.5;
    // Pixels beyond the edge of the picture count: they are as free as those within.
    const int margin = static_cast<int>(reach) + 2;
    const int width = labels.width + 2 * margin;
    const int height = labels.height + 2 * margin;
    Raster<std::uint8_t> isStone = rasterOf<std::uint8_t>(width, height, 0);
    forEachPixel(labels, [&](int x, int y)
                 { isStone.at(x + margin, y + margin) = labels.at(x, y) != noStone ? 1 : 0; });
    const Raster<double> fromStones = squaredDistances(isStone);
    Raster<std::uint8_t> isOutside = rasterOf<std::uint8_t>(width, height, 0);
    forEachPixel(isOutside,
                 [&](int x, int y) { isOutside.at(x, y) = fromStones.at(x, y) > reach * reach ? 1 : 0; });
    const Raster<double> fromOutside = squaredDistances(isOutside);
    Raster<std::uint8_t> room = rasterOf<std::uint8_t>(labels.width, labels.height, 0);
    int lowest = -1;
    forEachPixel(room,
                 [&](int x, int y)
                 {
                     const bool isClosed = fromOutside.at(x + margin, y + margin) > reach * reach;
                     room.at(x, y) = isClosed || labels.at(x, y) != noStone ? 1 : 0;
                     lowest = labels.at(x, y) != noStone ? y : lowest;
                 });
    // From the lowest row upwards: a row of the strip is as wide as the stones in it and below.
    int left = labels.width;
    int right = -1;
    for (int y = lowest; y >= 0 && y > lowest - settings.base; --y)
    {
        for (int x = 0; x < labels.width; ++x)
        {
            if (labels.at(x, y) != noStone)
            {
                left = std::min(left, x);
                right = std::max(right, x);
            }
        }
        for (int x = left; x <= right; ++x)
        {
            room.at(x, y) = 1;
        }
    }
    return room;
}

/// Stones grow from all their pixels at once, side by side, so that each stays connected.
void grow(Raster<int>& labels, const Raster<std::uint8_t>& room)
{
    std::queue<std::pair<int, int>> front;
    forEachPixel(labels,
                 [&](int x, int y)
                 {
                     if (labels.at(x, y) != noStone)
                     {
                         front.emplace(x, y);
                     }
                 });
    while (!front.empty())
    {
        const auto [x, y] = front.front();
        front.pop();
        for (const auto& [dx, dy] : neighbourPixels)
        {
            if (labels.has(x + dx, y + dy) && labels.at(x + dx, y + dy) == noStone
                && room.at(x + dx, y + dy) != 0)
            {
                labels.at(x + dx, y + dy) = labels.at(x, y);
                front.emplace(x + dx, y + dy);
            }
        }
    }
}

/// Where two pixels of a stone touch at a corner only, a third is added to it.
void removeCornerTouches(Raster<int>& labels)
{
    constexpr int mostPasses = 50;
    bool isChanged = true;
    for (int pass = 0; isChanged && pass < mostPasses; ++pass)
    {
        isChanged = false;
        for (int y = 0; y + 1 < labels.height; ++y)
        {
            for (int x = 0; x + 1 < labels.width; ++x)
            {
                const int a = labels.at(x, y);
                const int b = labels.at(x + 1, y);
                const int c = labels.at(x, y + 1);
                const int d = labels.at(x + 1, y + 1);
                if (a == d && a != b && a != c && a != noStone)
                {
                    labels.at(x + 1, y) = a;
                    isChanged = true;
                }
                else if (b == c && b != a && b != d && b != noStone)
                {
                    labels.at(x, y) = b;
                    isChanged = true;
                }
            }
        }
    }
}

/// The largest piece of each stone stays; others become free. Stones are numbered anew.
void keepLargestPieces(Raster<int>& labels, int& count)
{
    std::vector<std::vector<std::pair<int, int>>> largest(static_cast<std::size_t>(count));
    Raster<std::uint8_t> isReached = rasterOf<std::uint8_t>(labels.width, labels.height, 0);
    forEachPixel(labels,
                 [&](int x, int y)
                 {
                     const int label = labels.at(x, y);
                     if (label == noStone || isReached.at(x, y) != 0)
                     {
                         return;
                     }
                     auto area = areaFrom(
                         x, y, [&](int px, int py) { return labels.at(px, py) == label; }, isReached);
                     if (area.size() > largest[static_cast<std::size_t>(label)].size())
                     {
                         largest[static_cast<std::size_t>(label)] = std::move(area);
                     }
                 });
    std::fill(labels.pixels.begin(), labels.pixels.end(), noStone);
    count = 0;
    for (const auto& area : largest)
    {
        for (const auto& [x, y] : area)
        {
            labels.at(x, y) = count;
        }
        count += area.empty() ? 0 : 1;
    }
}

} // namespace

Raster<std::uint8_t> readPng(const ImportedFile& file)
{
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    if (png_image_begin_read_from_memory(&image, file.bytes.data(), file.bytes.size()) == 0)
    {
        refuse(file, 0, fmt::format("This is no PNG that can be read: {}.", shown(image.message)));
    }
    if (static_cast<std::size_t>(image.width) * image.height > mostPixels)
    {
        const std::string size = fmt::format("{} x {}", image.width, image.height);
        png_image_free(&image);
        refuse(file, 0, fmt::format("The picture has {} pixels, more than {}: reduce it.", size, mostPixels));
    }
    image.format = PNG_FORMAT_GRAY;
    Raster<std::uint8_t> picture =
        rasterOf<std::uint8_t>(static_cast<int>(image.width), static_cast<int>(image.height), 255);
    png_color white{255, 255, 255};
    if (png_image_finish_read(&image, &white, picture.pixels.data(), 0, nullptr) == 0)
    {
        refuse(file, 0,
               fmt::format("The picture is damaged: {}. Get a complete copy of it.", shown(image.message)));
    }
    return picture;
}

StoneRaster labelStones(const Raster<std::uint8_t>& brightness, const StoneSettings& settings)
{
    StoneRaster stones;
    stones.labels = findStones(brightness, settings, stones.count);
    if (stones.count == 0)
    {
        return stones;
    }
    Raster<int>& labels = stones.labels;
    Raster<std::uint8_t> isFilled = rasterOf<std::uint8_t>(labels.width, labels.height, 0);
    grow(labels, roomOf(labels, settings));
    fillHoles(labels, isFilled);
    removeCornerTouches(labels);
    keepLargestPieces(labels, stones.count);
    fillHoles(labels, isFilled);
    keepLargestPieces(labels, stones.count);
    stones.filled.assign(static_cast<std::size_t>(stones.count), 0);
    forEachPixel(labels,
                 [&](int x, int y)
                 {
                     if (labels.at(x, y) != noStone)
                     {
                         stones.filled[static_cast<std::size_t>(labels.at(x, y))] += isFilled.at(x, y);
                     }
                 });
    return stones;
}

} // namespace drystone
