// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Pictures as values of pixels, and areas of pixels that are connected.
#pragma once

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

namespace drystone
{

/// Values of pixels, row by row from the top left corner.
template<class Value>
struct Raster
{
    int width = 0;
    int height = 0;
    std::vector<Value> pixels;

    Value& at(int x, int y)
    {
        return pixels[static_cast<std::size_t>(y) * static_cast<std::size_t>(width)
                      + static_cast<std::size_t>(x)];
    }
    const Value& at(int x, int y) const
    {
        return pixels[static_cast<std::size_t>(y) * static_cast<std::size_t>(width)
                      + static_cast<std::size_t>(x)];
    }
    bool has(int x, int y) const { return x >= 0 && y >= 0 && x < width && y < height; }
};

/// Calls visit(x, y) for each pixel.
template<class Value, class Visit>
void forEachPixel(const Raster<Value>& raster, const Visit& visit)
{
    for (int y = 0; y < raster.height; ++y)
    {
        for (int x = 0; x < raster.width; ++x)
        {
            visit(x, y);
        }
    }
}

/// From a pixel to those at its sides.
inline constexpr std::array<std::pair<int, int>, 4> neighbourPixels{{{1, 0}, {-1, 0}, {0, 1}, {0, -1}}};

/// The pixels that are reached from one through neighbours at a side for which `belongs(x, y)` holds.
/// \param isReached is set for them; what it is set for before is passed over
template<class Belongs>
std::vector<std::pair<int, int>> areaFrom(int x, int y, const Belongs& belongs,
                                          Raster<std::uint8_t>& isReached)
{
    std::vector<std::pair<int, int>> area{{x, y}};
    isReached.at(x, y) = 1;
    for (std::size_t next = 0; next < area.size(); ++next)
    {
        const auto [px, py] = area[next];
        for (const auto& [dx, dy] : neighbourPixels)
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

/// A picture of one value.
template<class Value>
Raster<Value> rasterOf(int width, int height, Value value)
{
    return {width, height,
            std::vector<Value>(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), value)};
}

} // namespace drystone
