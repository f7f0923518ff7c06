// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Borders between stones, as lines along the sides of pixels.
#include "import/plane/StoneBorders.h"

#include "geometry/PolygonShape.h"

#include <algorithm>
#include <array>
#include <map>
#include <utility>

namespace drystone
{

namespace
{

/// A corner of pixels: that of pixel (x, y) at the top left.
using Corner = std::pair<int, int>;

/// Labels of the four pixels at a corner, 0 where there is no picture.
std::array<int, 4> around(const Raster<int>& labels, const Corner& corner)
{
    std::array<int, 4> found{};
    for (int k = 0; k < 4; ++k)
    {
        const int x = corner.first - 1 + k % 2;
        const int y = corner.second - 1 + k / 2;
        found[static_cast<std::size_t>(k)] = labels.has(x, y) ? labels.at(x, y) : noStone;
    }
    return found;
}

/// Whether three areas meet there, or two as on a chess board: borders end.
bool isNode(const Raster<int>& labels, const Corner& corner)
{
    const auto [a, b, c, d] = around(labels, corner);
    return int(a != b) + int(b != d) + int(d != c) + int(c != a) > 2;
}

/// Directions right, down, left, up.
constexpr std::array<std::pair<int, int>, 4> steps{{{1, 0}, {0, 1}, {-1, 0}, {0, -1}}};

/// Whether the stone is to the right of a step from a corner (y points down), and something else to the left:
/// its outline runs clockwise on the screen.
bool isOutline(const Raster<int>& labels, int stone, const Corner& corner, int direction)
{
    const auto [a, b, c, d] = around(labels, corner);
    const std::array<int, 4> right{d, c, a, b};
    const std::array<int, 4> left{b, d, c, a};
    const auto k = static_cast<std::size_t>(direction);
    return right[k] == stone && left[k] != stone;
}

void simplify(const std::vector<Corner>& line, std::size_t first, std::size_t last, double tolerance,
              std::vector<bool>& isKept)
{
    std::vector<std::pair<std::size_t, std::size_t>> open{{first, last}};
    const auto at = [&](std::size_t i) { return Vector<2>(line[i].first, line[i].second); };
    while (!open.empty())
    {
        const auto [from, to] = open.back();
        open.pop_back();
        double farthest = tolerance;
        std::size_t split = from;
        for (std::size_t i = from + 1; i < to; ++i)
        {
            const double apart = distance(at(i), at(from), at(to));
            if (apart > farthest)
            {
                farthest = apart;
                split = i;
            }
        }
        if (split != from)
        {
            isKept[split] = true;
            open.emplace_back(from, split);
            open.emplace_back(split, to);
        }
    }
}

/// The corners of a border that are kept. The same from both ends: it is simplified in the order of the lower
/// end.
std::vector<Corner> simplified(std::vector<Corner> line, double tolerance)
{
    const bool isReversed = std::pair(line.back(), line[line.size() - 2]) < std::pair(line.front(), line[1]);
    if (isReversed)
    {
        std::reverse(line.begin(), line.end());
    }
    std::vector<bool> isKept(line.size(), false);
    isKept.front() = true;
    isKept.back() = true;
    if (line.front() == line.back())
    {
        // A ring: the corner farthest from its beginning, too.
        std::size_t far = 0;
        long most = -1;
        for (std::size_t i = 0; i < line.size(); ++i)
        {
            const long dx = line[i].first - line.front().first;
            const long dy = line[i].second - line.front().second;
            if (dx * dx + dy * dy > most)
            {
                most = dx * dx + dy * dy;
                far = i;
            }
        }
        isKept[far] = true;
        simplify(line, 0, far, tolerance, isKept);
        simplify(line, far, line.size() - 1, tolerance, isKept);
    }
    else
    {
        simplify(line, 0, line.size() - 1, tolerance, isKept);
    }
    std::vector<Corner> kept;
    for (std::size_t i = 0; i < line.size(); ++i)
    {
        if (isKept[i])
        {
            kept.push_back(line[i]);
        }
    }
    if (isReversed)
    {
        std::reverse(kept.begin(), kept.end());
    }
    return kept;
}

/// All corners round a stone, from a first pixel of it in the order of the rows: the step along its top.
std::vector<Corner> cornersRound(const Raster<int>& labels, int stone, const Corner& start)
{
    std::vector<Corner> corners;
    Corner corner = start;
    int direction = 0;
    const std::size_t most = 4 * labels.pixels.size();
    do
    {
        corners.push_back(corner);
        corner.first += steps[static_cast<std::size_t>(direction)].first;
        corner.second += steps[static_cast<std::size_t>(direction)].second;
        // Right turns first: a stone is connected by sides of pixels only.
        for (const int turn : {1, 0, 3})
        {
            if (isOutline(labels, stone, corner, (direction + turn) % 4))
            {
                direction = (direction + turn) % 4;
                break;
            }
        }
    } while ((corner != start || direction != 0) && corners.size() < most);
    return corners;
}

} // namespace

std::vector<Polygon> stoneOutlines(const Raster<int>& labels, int count, double tolerance)
{
    std::vector<Corner> starts(static_cast<std::size_t>(count), Corner(-1, -1));
    for (int y = labels.height - 1; y >= 0; --y)
    {
        for (int x = labels.width - 1; x >= 0; --x)
        {
            if (labels.at(x, y) != noStone)
            {
                starts[static_cast<std::size_t>(labels.at(x, y))] = {x, y};
            }
        }
    }
    std::vector<Polygon> outlines;
    for (int stone = 0; stone < count; ++stone)
    {
        std::vector<Corner> round = cornersRound(labels, stone, starts[static_cast<std::size_t>(stone)]);
        // Begins where a border does; a stone with one neighbour only begins where its neighbour would.
        const auto first = std::find_if(round.begin(), round.end(),
                                        [&](const Corner& corner) { return isNode(labels, corner); });
        std::rotate(round.begin(),
                    first != round.end() ? first : std::min_element(round.begin(), round.end()), round.end());
        round.push_back(round.front());
        Polygon outline;
        for (std::size_t from = 0; from + 1 < round.size();)
        {
            std::size_t to = from + 1;
            while (to + 1 < round.size() && !isNode(labels, round[to]))
            {
                ++to;
            }
            const std::vector<Corner> kept = simplified({round.begin() + static_cast<std::ptrdiff_t>(from),
                                                         round.begin() + static_cast<std::ptrdiff_t>(to) + 1},
                                                        tolerance);
            for (std::size_t i = 0; i + 1 < kept.size(); ++i)
            {
                outline.emplace_back(kept[i].first, labels.height - kept[i].second);
            }
            from = to;
        }
        // Clockwise on the screen is clockwise with y upwards, too: both turns are of the eye.
        std::reverse(outline.begin(), outline.end());
        outlines.push_back(std::move(outline));
    }
    return outlines;
}

} // namespace drystone
