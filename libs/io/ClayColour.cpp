// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Clay from light, where blocks rest, to dark, where they move farthest.
#include "io/ClayColour.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace drystone
{

std::string clayColour(double value, double light)
{
    constexpr std::array<std::array<double, 3>, 4> stops{
        {{247, 240, 230}, {236, 198, 158}, {214, 137, 94}, {165, 73, 47}}};
    const double position = std::clamp(value, 0.0, 1.0) * (stops.size() - 1);
    const auto below = std::min(static_cast<std::size_t>(position), stops.size() - 2);
    const double part = position - static_cast<double>(below);
    std::array<int, 3> colour{};
    for (std::size_t i = 0; i < 3; ++i)
    {
        const double component = (1 - part) * stops[below][i] + part * stops[below + 1][i];
        colour[i] = static_cast<int>(std::lround(std::clamp(light * component, 0.0, 255.0)));
    }
    return fmt::format("#{:02x}{:02x}{:02x}", colour[0], colour[1], colour[2]);
}

double paintClayLegend(Canvas& drawing, const Vector<2>& corner)
{
    const TextStyle small{.size = 12};
    double x = corner.x();
    const double y = corner.y();
    drawing.text({x, y + 11}, "at rest", small);
    x += textWidth("at rest", 12) + 6;
    constexpr int steps = 24;
    for (int i = 0; i < steps; ++i)
    {
        drawing.rectangle({x + 5 * i, y}, 5.2, 13,
                          {.fill = clayColour(static_cast<double>(i) / (steps - 1))});
    }
    drawing.rectangle({x, y}, 5 * steps, 13, {.stroke = "#3b2a22", .strokeWidth = 0.8});
    x += 5 * steps + 8;
    drawing.text({x, y + 11}, "moves most", small);
    return x + textWidth("moves most", 12);
}

} // namespace drystone
