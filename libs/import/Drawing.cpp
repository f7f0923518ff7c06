// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Blocks from the outlines of a drawing.
#include "import/Drawing.h"

#include "core/Log.h"
#include "geometry/BroadPhase.h"
#include "geometry/PolygonShape.h"
#include "import/Zones.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <utility>

namespace drystone
{

namespace
{

constexpr std::size_t mostCorners = 5000; // of a block: checks take time of the order of their square

Polygon inMetres(const DrawnOutline& drawn, double scale, double tolerance, const ImportedFile& file)
{
    Polygon outline;
    for (const Vector<2>& corner : drawn.corners)
    {
        outline.emplace_back(scale * corner);
        if (!(outline.back().cwiseAbs().maxCoeff() <= farthestCoordinate))
        {
            refuse(file, drawn.line,
                   fmt::format(
                       "A corner is at ({:g} {:g}) m: coordinates are at most {:g} m. Correct it, or give a "
                       "smaller scale.",
                       outline.back().x(), outline.back().y(), farthestCoordinate));
        }
    }
    const BoundingBox box = boundingBox(outline);
    const double near = std::max(tolerance, 1e-6 * (box.upper - box.lower).norm());
    Polygon distinct;
    for (const Vector<2>& corner : outline)
    {
        if (distinct.empty() || (corner - distinct.back()).norm() > near)
        {
            distinct.push_back(corner);
        }
    }
    while (distinct.size() > 1 && (distinct.front() - distinct.back()).norm() <= near)
    {
        distinct.pop_back();
    }
    return distinct;
}

/// The corners of an outline in the same order, from the least one on: alike for outlines that are the same.
std::vector<std::pair<double, double>> fromLeastCorner(const Polygon& outline)
{
    std::vector<std::pair<double, double>> corners;
    corners.reserve(outline.size());
    for (const Vector<2>& corner : outline)
    {
        corners.emplace_back(corner.x(), corner.y());
    }
    std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
    return corners;
}

} // namespace

Assembly<2> drawnBlocks(const Drawing& drawing, const DrawingSettings& settings, const ImportedFile& file)
{
    const double scale = settings.scale.value_or(drawing.unit.value_or(1));
    Assembly<2> assembly;
    ZoneList zones;
    std::size_t elsewhere = 0;
    std::size_t twice = 0;
    int firstTwice = 0;
    std::set<std::vector<std::pair<double, double>>> known;
    for (const DrawnOutline& drawn : drawing.outlines)
    {
        const auto isOf = [&](const std::string& layer)
        { return layer == drawn.layer || layer == zoneName(drawn.layer); };
        if (!settings.layers.empty() && std::none_of(settings.layers.begin(), settings.layers.end(), isOf))
        {
            ++elsewhere;
            continue;
        }
        Polygon outline = inMetres(drawn, scale, settings.tolerance.value_or(0), file);
        if (outline.size() > mostCorners)
        {
            refuse(file, drawn.line,
                   fmt::format("This outline has {} corners, more than {}: simplify it.", outline.size(),
                               mostCorners));
        }
        if (const std::string fault = outlineFault(outline); !fault.empty())
        {
            refuse(file, drawn.line,
                   fmt::format("The outline of block {} {}.", assembly.blocks.size(), fault));
        }
        if (areaProperties(outline).area < 0)
        {
            std::reverse(outline.begin(), outline.end());
        }
        if (!known.insert(fromLeastCorner(outline)).second)
        {
            firstTwice = twice++ == 0 ? drawn.line : firstTwice;
            continue;
        }
        zones.add(drawn.layer, static_cast<int>(assembly.blocks.size()));
        assembly.blocks.push_back({std::move(outline), settings.thickness});
    }
    for (const std::string& ignored : drawing.ignored)
    {
        info("Import: left out {}", ignored);
    }
    if (elsewhere > 0)
    {
        info("Import: left out {} outlines on other layers", elsewhere);
    }
    if (twice > 0)
    {
        info("Import: left out {} outlines that are drawn more than once, the first in line {}", twice,
             firstTwice);
    }
    if (assembly.blocks.empty())
    {
        refuse(file, 0, "There is no closed outline in this drawing, or none on the layers that are named.");
    }
    info("Import: a unit of the drawing is {:g} m, {}", scale,
         settings.scale ? "as `scale` says"
                        : (drawing.unit ? "as the file says" : "as the file does not say"));
    assembly.zones = zones.take();
    assembly.jointTolerance = settings.tolerance;
    return assembly;
}

} // namespace drystone
