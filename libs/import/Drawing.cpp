// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Blocks from the outlines of a drawing.
#include "import/Drawing.h"

#include "assembly/WrittenDigits.h"
#include "core/Error.h"
#include "core/Log.h"
#include "geometry/BroadPhase.h"
#include "geometry/PointText.h"
#include "geometry/PolygonShape.h"
#include "geometry/WholeMetres.h"
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

Polygon inMetres(const DrawnOutline& drawn, double scale, const DrawingSettings& settings,
                 const ImportedFile& file)
{
    Polygon outline;
    for (const Vector<2>& corner : drawn.corners)
    {
        outline.emplace_back(scale * corner + settings.offset);
        if (!(outline.back().cwiseAbs().maxCoeff() <= farthestCoordinate))
        {
            refuse(file, drawn.line,
                   fmt::format(
                       "A corner is at {} m: coordinates are at most {:g} m. Correct it, or give a smaller "
                       "scale, or an offset that brings the blocks near 0, as `offset {};`.",
                       asWritten<2>(outline.back()), farthestCoordinate,
                       inWholeMetres<2>(settings.offset - outline.back())));
        }
    }
    const BoundingBox box = boundingBox(outline);
    const double near = std::max(settings.tolerance.value_or(0), 1e-6 * (box.upper - box.lower).norm());
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

bool isOnLayer(const DrawnOutline& drawn, const std::string& layer)
{
    return layer == drawn.layer || layer == zoneName(drawn.layer);
}

/// A layer without outlines is a mistyped one, or not drawn yet: its blocks would be missing without a word.
void refuseUnknownLayers(const Drawing& drawing, const DrawingSettings& settings, const ImportedFile& file)
{
    for (const std::string& layer : settings.layers)
    {
        if (std::none_of(drawing.outlines.begin(), drawing.outlines.end(),
                         [&](const DrawnOutline& drawn) { return isOnLayer(drawn, layer); }))
        {
            std::set<std::string> known;
            for (const DrawnOutline& drawn : drawing.outlines)
            {
                known.insert(zoneName(drawn.layer));
            }
            refuse(file, 0, unknownWordMessage("layer", layer, {known.begin(), known.end()}));
        }
    }
}

/// An outline in metres, counter-clockwise. \throws FatalIOError where it is no block
Polygon soundOutline(const DrawnOutline& drawn, double scale, const DrawingSettings& settings,
                     std::size_t block, const ImportedFile& file)
{
    Polygon outline = inMetres(drawn, scale, settings, file);
    if (outline.size() > mostCorners)
    {
        refuse(file, drawn.line,
               fmt::format("This outline has {} corners, more than {}: simplify it.", outline.size(),
                           mostCorners));
    }
    if (const std::string fault = outlineFault(outline); !fault.empty())
    {
        refuse(file, drawn.line, fmt::format("The outline of block {} {}.", block, fault));
    }
    if (areaProperties(outline).area < 0)
    {
        std::reverse(outline.begin(), outline.end());
    }
    return outline;
}

/// Warns of lines that are not closed on layers that have blocks: stones that would be missing without a
/// word.
void questionOpenLines(const Drawing& drawing, const std::set<std::string>& layersOfBlocks,
                       const ImportedFile& file)
{
    const auto isAmongBlocks = [&](const DrawnOutline& line) { return layersOfBlocks.contains(line.layer); };
    const auto first = std::find_if(drawing.open.begin(), drawing.open.end(), isAmongBlocks);
    if (first != drawing.open.end())
    {
        printWarningOnce(
            fmt::format("{} lines of three and more corners on layers that have blocks are not closed, the "
                        "first on layer {}: they are no blocks. Where they are the outlines of stones, which "
                        "are missing now, close them in the program that drew them.",
                        std::count_if(first, drawing.open.end(), isAmongBlocks), shown(first->layer)),
            {file.name, "", first->line});
    }
}

bool hasObliqueEdge(const Assembly<2>& assembly)
{
    return std::any_of(assembly.blocks.begin(), assembly.blocks.end(),
                       [](const Block<2>& block)
                       {
                           for (std::size_t i = 0; i < block.outline.size(); ++i)
                           {
                               const Vector<2> along =
                                   block.outline[(i + 1) % block.outline.size()] - block.outline[i];
                               if (along.x() != 0 && along.y() != 0)
                               {
                                   return true;
                               }
                           }
                           return false;
                       });
}

/// The tolerance that the digits of the file require and the coordinates in metres do not show, as after a
/// conversion from inches or a turn. Nothing where closeJoints finds the rounding by itself, or where all
/// edges are parallel to the axes: corners on one line round alike. \param rounding [m]
std::optional<double> toleranceOfRounding(const Assembly<2>& assembly, double rounding)
{
    constexpr double units = 1.5;      // half a unit along each axis, for two corners, and a little
    constexpr double usual = 1e-6;     // of the mean size of the blocks
    constexpr double coarsest = 1e-3;  // likewise: rounding is not followed beyond it
    constexpr double alike = 1 - 1e-6; // powers of ten times a unit in metres
    if (!(rounding > 0) || !hasObliqueEdge(assembly) || writtenRounding(assembly) >= alike * rounding)
    {
        return {};
    }
    const double size = meanBlockSize(assembly);
    const double tolerance = std::clamp(units * rounding, usual * size, coarsest * size);
    info("Import: coordinates are written to {:.3g} m; faces within {:.3g} m are joints", rounding,
         tolerance);
    return tolerance;
}

/// Outlines that become no blocks.
struct LeftOut
{
    std::size_t elsewhere = 0; ///< on other layers
    std::size_t twice = 0;     ///< drawn more than once
    int firstTwice = 0;        ///< line of the first of these
};

void printLeftOut(const Drawing& drawing, const LeftOut& leftOut)
{
    for (const std::string& ignored : drawing.ignored)
    {
        info("Import: left out {}", ignored);
    }
    if (leftOut.elsewhere > 0)
    {
        info("Import: left out {} outlines on other layers", leftOut.elsewhere);
    }
    if (leftOut.twice > 0)
    {
        info("Import: left out {} outlines that are drawn more than once, the first in line {}",
             leftOut.twice, leftOut.firstTwice);
    }
}

/// Whether an outline is on one of the layers that are imported, all where none is named.
bool isOnLayers(const DrawnOutline& drawn, const DrawingSettings& settings)
{
    return settings.layers.empty()
           || std::any_of(settings.layers.begin(), settings.layers.end(),
                          [&](const std::string& layer) { return isOnLayer(drawn, layer); });
}

void refuseWithoutOutlines(const Drawing& drawing, const ImportedFile& file)
{
    if (drawing.outlines.empty())
    {
        refuse(file, 0,
               fmt::format("There is no closed outline in this drawing.{}",
                           drawing.ignored.empty()
                               ? ""
                               : fmt::format(" Left out are {}. Join lines to closed polylines, and draw "
                                             "copies and curves as such.",
                                             fmt::join(drawing.ignored, ", "))));
    }
}

} // namespace

Assembly<2> drawnBlocks(const Drawing& drawing, const DrawingSettings& settings, const ImportedFile& file)
{
    refuseWithoutOutlines(drawing, file);
    refuseUnknownLayers(drawing, settings, file);
    const double scale = settings.scale.value_or(drawing.unit.value_or(1));
    Assembly<2> assembly;
    ZoneList zones;
    LeftOut leftOut;
    std::set<std::vector<std::pair<double, double>>> known;
    std::set<std::string> layersOfBlocks;
    for (const DrawnOutline& drawn : drawing.outlines)
    {
        if (!isOnLayers(drawn, settings))
        {
            ++leftOut.elsewhere;
            continue;
        }
        Polygon outline = soundOutline(drawn, scale, settings, assembly.blocks.size(), file);
        if (!known.insert(fromLeastCorner(outline)).second)
        {
            leftOut.firstTwice = leftOut.twice++ == 0 ? drawn.line : leftOut.firstTwice;
            continue;
        }
        layersOfBlocks.insert(drawn.layer);
        zones.add(drawn.layer, static_cast<int>(assembly.blocks.size()));
        assembly.blocks.push_back({std::move(outline), settings.thickness});
    }
    printLeftOut(drawing, leftOut);
    questionOpenLines(drawing, layersOfBlocks, file);
    info("Import: a unit of the drawing is {:g} m, {}", scale,
         settings.scale ? "as `scale` says"
                        : (drawing.unit ? "as the file says" : "as the file does not say"));
    assembly.zones = zones.take(file);
    assembly.jointTolerance =
        settings.tolerance ? settings.tolerance : toleranceOfRounding(assembly, scale * drawing.rounding);
    return assembly;
}

} // namespace drystone
