// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Lays out the walls of the texture `walls` and finds where they cross.
#include "texture/space/WallPlan.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace drystone
{

namespace
{

/// The rectangle of a wall in the coordinates of another one, along and across.
std::array<Interval, 2> rectangleIn(const WallInPlan& frame, const WallInPlan& wall)
{
    std::array<Interval, 2> box{{{1e300, -1e300}, {1e300, -1e300}}};
    for (const double s : {0.0, wall.length})
    {
        for (const double d : {0.0, wall.thickness})
        {
            const Vector<2> arm = wall.from + s * wall.along + d * wall.across - frame.from;
            const double coordinates[2] = {frame.along.dot(arm), frame.across.dot(arm)};
            for (int axis = 0; axis < 2; ++axis)
            {
                box[axis].from = std::min(box[axis].from, coordinates[axis]);
                box[axis].to = std::max(box[axis].to, coordinates[axis]);
            }
        }
    }
    return box;
}

} // namespace

std::vector<WallInPlan> wallsInPlan(const Walls& settings)
{
    std::vector<WallInPlan> walls;
    for (const auto& [name, line] : settings.walls)
    {
        WallInPlan wall;
        wall.from = line.from;
        wall.along = line.direction.normalized();
        wall.across = perpendicular(wall.along);
        if (line.thickness == WallSide::right)
        {
            wall.across = -wall.across;
        }
        wall.length = wallLength(settings, line.length);
        wall.thickness = wallThickness(settings);
        walls.push_back(wall);
    }
    return walls;
}

bool overlap(const Interval& a, const Interval& b, double tolerance)
{
    return std::min(a.to, b.to) - std::max(a.from, b.from) > tolerance;
}

double planTolerance(const Walls& settings)
{
    return 1e-6 * settings.unit.minCoeff();
}

std::vector<std::vector<WallCrossing>> findCrossings(const Walls& settings,
                                                     const std::vector<WallInPlan>& walls, std::string& fault)
{
    const double tolerance = planTolerance(settings);
    std::vector<std::vector<WallCrossing>> crossings(walls.size());
    for (std::size_t i = 0; i < walls.size(); ++i)
    {
        for (std::size_t j = 0; j < walls.size(); ++j)
        {
            if (i == j)
            {
                continue;
            }
            const auto [along, across] = rectangleIn(walls[i], walls[j]);
            if (!overlap(along, {0, walls[i].length}, tolerance)
                || !overlap(across, {0, walls[i].thickness}, tolerance))
            {
                continue;
            }
            if (std::abs(walls[i].along.dot(walls[j].along)) > 1e-9)
            {
                // Rectangles round walls at another angle may meet although the walls do not.
                const auto [alongI, acrossI] = rectangleIn(walls[j], walls[i]);
                if (overlap(alongI, {0, walls[j].length}, tolerance)
                    && overlap(acrossI, {0, walls[j].thickness}, tolerance))
                {
                    fault = fmt::format(
                        "Walls {} ({:g} m long, {:g} m thick) and {} ({:g} m long, {:g} m thick) overlap "
                        "and are not at right angles: walls that meet must be.",
                        settings.walls[i].first, walls[i].length, walls[i].thickness, settings.walls[j].first,
                        walls[j].length, walls[j].thickness);
                }
                continue;
            }
            if (across.from > tolerance || across.to < walls[i].thickness - tolerance)
            {
                fault = fmt::format(
                    "Wall {} ends within the thickness of wall {}: let it begin or end at the face of "
                    "this wall (it is then not toothed), or reach to its far face.",
                    settings.walls[j].first, settings.walls[i].first);
                continue;
            }
            crossings[i].push_back({static_cast<int>(j), along, j < i});
        }
        std::sort(crossings[i].begin(), crossings[i].end(),
                  [](const WallCrossing& a, const WallCrossing& b) { return a.along.from < b.along.from; });
    }
    return crossings;
}

} // namespace drystone
