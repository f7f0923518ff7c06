// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Reading of a picture and labelling of the stones in it.
#include "import/plane/Picture.h"

#include <fmt/format.h>
#include <png.h>

#include <algorithm>
#include <array>
#include <queue>

namespace drystone
{

namespace
{

constexpr std::size_t mostPixels = 50'000'000;
constexpr std::array<std::pair<int, int>, 4> sides{{{1, 0}, {-1, 0}, {0, 1}, {0, -1}}};

/// Calls visit(x, y) for each pixel.
template<class Value, class Visit>
void forEach(const Raster<Value>& raster, const Visit& visit)
{
    for (int y = 0; y < raster.height; ++y)
    {
        for (int x = 0; x < raster.width; ++x)
        {
            visit(x, y);
        }
    }
}

/// The pixels that are reached from one through neighbours at a side for which `belongs` holds.
template<class Belongs>
std::vector<std::pair<int, int>> areaFrom(int x, int y, const Belongs& belongs,
                                          Raster<std::uint8_t>& isReached)
{
    std::vector<std::pair<int, int>> area{{x, y}};
    isReached.at(x, y) = 1;
    for (std::size_t next = 0; next < area.size(); ++next)
    {
        const auto [px, py] = area[next];
        for (const auto& [dx, dy] : sides)
        {
            if (isReached.has(px + dx, py + dy) && isReached.at(px + dx, py + dy) == 0
                && belongs(px + dx, py + dy))
            {
                isReached.at(px + dx, py + dy) = 1;
                area.emplace_back(px + dx, py + dy);
            }
        }
    }
    return area;
}

template<class Value>
Raster<Value> alike(int width, int height, Value value)
{
    return {width, height,
            std::vector<Value>(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), value)};
}

/// Square of the distance to the nearest pixel where `isOne`, by two passes of lower envelopes of parabolas
/// (Felzenszwalb and Huttenlocher, 2012): time of order of the pixels.
template<class IsOne>
Raster<double> distances(int width, int height, const IsOne& isOne)
{
    constexpr double far = 1e15;
    Raster<double> squares = alike(width, height, far);
    forEach(squares,
            [&](int x, int y)
            {
                if (isOne(x, y))
                {
                    squares.at(x, y) = 0;
                }
            });
    std::vector<double> line;
    std::vector<int> places;
    std::vector<double> bounds;
    const auto transform = [&](int size, const auto& value)
    {
        line.resize(static_cast<std::size_t>(size));
        places.assign(1, 0);
        bounds.assign(1, -far);
        for (int i = 0; i < size; ++i)
        {
            line[static_cast<std::size_t>(i)] = value(i);
        }
        const auto at = [&](int i) { return line[static_cast<std::size_t>(i)]; };
        for (int i = 1; i < size; ++i)
        {
            const auto meet = [&](int j)
            { return ((at(i) + double(i) * i) - (at(j) + double(j) * j)) / (2.0 * i - 2.0 * j); };
            double place = meet(places.back());
            while (place <= bounds.back() && places.size() > 1)
            {
                places.pop_back();
                bounds.pop_back();
                place = meet(places.back());
            }
            if (place <= bounds.back())
            {
                places.back() = i;
                continue;
            }
            places.push_back(i);
            bounds.push_back(place);
        }
        std::size_t k = 0;
        for (int i = 0; i < size; ++i)
        {
            while (k + 1 < places.size() && bounds[k + 1] < i)
            {
                ++k;
            }
            value(i) = double(i - places[k]) * (i - places[k]) + at(places[k]);
        }
    };
    for (int x = 0; x < width; ++x)
    {
        transform(height, [&](int y) -> double& { return squares.at(x, y); });
    }
    for (int y = 0; y < height; ++y)
    {
        transform(width, [&](int x) -> double& { return squares.at(x, y); });
    }
    return squares;
}

/// Stones as they are in the picture.
Raster<int> findStones(const Raster<std::uint8_t>& brightness, const StoneSettings& settings, int& count)
{
    const auto isStone = [&](int x, int y)
    { return (brightness.at(x, y) > settings.threshold) == settings.areLight; };
    Raster<int> labels = alike(brightness.width, brightness.height, noStone);
    Raster<std::uint8_t> isReached = alike<std::uint8_t>(brightness.width, brightness.height, 0);
    count = 0;
    forEach(labels,
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
    const auto isStone = [&](int x, int y)
    { return labels.has(x - margin, y - margin) && labels.at(x - margin, y - margin) != noStone; };
    const Raster<double> fromStones = distances(width, height, isStone);
    const Raster<double> fromOutside =
        distances(width, height, [&](int x, int y) { return fromStones.at(x, y) > reach * reach; });
    Raster<std::uint8_t> room = alike<std::uint8_t>(labels.width, labels.height, 0);
    int lowest = -1;
    forEach(room,
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
    forEach(labels,
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
        for (const auto& [dx, dy] : sides)
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

/// Connected areas of one stone, or of none, and which of them touch at sides of pixels. The picture has a
/// margin of one free pixel, so that area 0 is what lies around.
struct AreaMap
{
    Raster<int> areas;       ///< with the margin
    std::vector<int> stones; ///< of each area
    std::vector<std::vector<int>> neighbours;
};

AreaMap areasOf(const Raster<int>& labels)
{
    AreaMap map;
    map.areas = alike(labels.width + 2, labels.height + 2, -1);
    const auto stoneAt = [&](int x, int y)
    { return labels.has(x - 1, y - 1) ? labels.at(x - 1, y - 1) : noStone; };
    Raster<std::uint8_t> isReached = alike<std::uint8_t>(map.areas.width, map.areas.height, 0);
    forEach(map.areas,
            [&](int x, int y)
            {
                if (isReached.at(x, y) != 0)
                {
                    return;
                }
                const int stone = stoneAt(x, y);
                for (const auto& [px, py] : areaFrom(
                         x, y, [&](int qx, int qy) { return stoneAt(qx, qy) == stone; }, isReached))
                {
                    map.areas.at(px, py) = static_cast<int>(map.stones.size());
                }
                map.stones.push_back(stone);
            });
    map.neighbours.resize(map.stones.size());
    const auto join = [&](int one, int other)
    {
        std::vector<int>& known = map.neighbours[static_cast<std::size_t>(one)];
        if (one != other && (known.empty() || known.back() != other))
        {
            known.push_back(other);
        }
    };
    forEach(map.areas,
            [&](int x, int y)
            {
                for (const auto& [dx, dy] : sides)
                {
                    if (map.areas.has(x + dx, y + dy))
                    {
                        join(map.areas.at(x, y), map.areas.at(x + dx, y + dy));
                    }
                }
            });
    for (std::vector<int>& known : map.neighbours)
    {
        std::sort(known.begin(), known.end());
        known.erase(std::unique(known.begin(), known.end()), known.end());
    }
    return map;
}

/// For each area the stone's area that surrounds it, the outermost of several, or -1. Every way from an area
/// to what lies around passes through the stone that surrounds it: of a depth-first tree from there, the
/// stone is an ancestor below which nothing has a neighbour above it (Tarjan, 1972).
std::vector<int> surroundingAreas(const AreaMap& map)
{
    const std::size_t count = map.stones.size();
    std::vector<int> found(count, -1); // when, in order
    std::vector<int> lowest(count, 0); // the first that is a neighbour of the subtree
    std::vector<int> parent(count, -1);
    std::vector<std::size_t> next(count, 0);
    std::vector<int> order;
    std::vector<int> path{0};
    const auto at = [](auto& values, int area) -> auto&
    {
        return values[static_cast<std::size_t>(area)];
    };
    const auto find = [&](int area)
    {
        at(found, area) = at(lowest, area) = static_cast<int>(order.size());
        order.push_back(area);
    };
    find(0);
    while (!path.empty())
    {
        const int area = path.back();
        if (at(next, area) == at(map.neighbours, area).size())
        {
            path.pop_back();
            if (!path.empty())
            {
                at(lowest, path.back()) = std::min(at(lowest, path.back()), at(lowest, area));
            }
            continue;
        }
        const int neighbour = at(map.neighbours, area)[at(next, area)++];
        if (at(found, neighbour) < 0)
        {
            at(parent, neighbour) = area;
            find(neighbour);
            path.push_back(neighbour);
        }
        else
        {
            at(lowest, area) = std::min(at(lowest, area), at(found, neighbour));
        }
    }
    std::vector<int> surrounding(count, -1);
    for (std::size_t i = 1; i < order.size(); ++i)
    {
        const int area = order[i];
        const int above = at(parent, area);
        const bool isInside = at(map.stones, above) != noStone && at(lowest, area) >= at(found, above);
        at(surrounding, area) = at(surrounding, above) >= 0 ? at(surrounding, above) : isInside ? above : -1;
    }
    return surrounding;
}

/// What a stone surrounds becomes part of it, other stones too: an outline has no hole.
/// \param isFilled is set for these pixels
void fillHoles(Raster<int>& labels, Raster<std::uint8_t>& isFilled)
{
    const AreaMap map = areasOf(labels);
    const std::vector<int> surrounding = surroundingAreas(map);
    forEach(labels,
            [&](int x, int y)
            {
                const int around = surrounding[static_cast<std::size_t>(map.areas.at(x + 1, y + 1))];
                if (around >= 0)
                {
                    labels.at(x, y) = map.stones[static_cast<std::size_t>(around)];
                    isFilled.at(x, y) = 1;
                }
            });
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
    Raster<std::uint8_t> isReached = alike<std::uint8_t>(labels.width, labels.height, 0);
    forEach(labels,
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
        alike<std::uint8_t>(static_cast<int>(image.width), static_cast<int>(image.height), 255);
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
    Raster<std::uint8_t> isFilled = alike<std::uint8_t>(labels.width, labels.height, 0);
    grow(labels, roomOf(labels, settings));
    fillHoles(labels, isFilled);
    removeCornerTouches(labels);
    keepLargestPieces(labels, stones.count);
    fillHoles(labels, isFilled);
    keepLargestPieces(labels, stones.count);
    stones.filled.assign(static_cast<std::size_t>(stones.count), 0);
    forEach(labels,
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
