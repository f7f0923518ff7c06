// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Areas of a picture as a graph: what surrounds others is a cut vertex of it.
#include "import/plane/FilledHoles.h"

#include <algorithm>

namespace drystone
{
namespace
{

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
    map.areas = rasterOf(labels.width + 2, labels.height + 2, -1);
    const auto stoneAt = [&](int x, int y)
    { return labels.has(x - 1, y - 1) ? labels.at(x - 1, y - 1) : noStone; };
    Raster<std::uint8_t> isReached = rasterOf<std::uint8_t>(map.areas.width, map.areas.height, 0);
    forEachPixel(map.areas,
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
    forEachPixel(map.areas,
                 [&](int x, int y)
                 {
                     for (const auto& [dx, dy] : neighbourPixels)
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

} // namespace

void fillHoles(Raster<int>& labels, Raster<std::uint8_t>& isFilled)
{
    const AreaMap map = areasOf(labels);
    const std::vector<int> surrounding = surroundingAreas(map);
    forEachPixel(labels,
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

} // namespace drystone
