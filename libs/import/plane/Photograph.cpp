// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Blocks from the stones of a picture.
#include "import/plane/Photograph.h"

#include "core/Error.h"
#include "core/Log.h"
#include "core/NamedFile.h"
#include "core/ShownList.h"
#include "geometry/BroadPhase.h"
#include "geometry/PolygonShape.h"
#include "import/plane/StoneBorders.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace drystone
{

namespace
{

constexpr std::size_t mostStones = 100'000;

/// What is wrong with an outline, as a part of a sentence; empty: nothing.
std::string faultOf(const Polygon& outline)
{
    const std::string fault = outlineFault(outline);
    return fault.empty() && areaProperties(outline).area <= 0 ? "is turned inside out" : fault;
}

/// Index of the first outline that is no block; -1 if none.
int firstFault(const std::vector<Polygon>& outlines)
{
    for (std::size_t i = 0; i < outlines.size(); ++i)
    {
        if (!faultOf(outlines[i]).empty())
        {
            return static_cast<int>(i);
        }
    }
    return -1;
}

bool doOverlap(const std::vector<Polygon>& outlines)
{
    std::vector<BoundingBox> boxes;
    for (const Polygon& outline : outlines)
    {
        boxes.push_back(boundingBox(outline));
    }
    const auto pairs = findMeetingPairs(boxes);
    return std::any_of(pairs.begin(), pairs.end(),
                       [&](const auto& pair)
                       {
                           constexpr double rounding = 1e-6; // of a pixel
                           return overlapArea(outlines[static_cast<std::size_t>(pair.first)],
                                              outlines[static_cast<std::size_t>(pair.second)])
                                  > rounding;
                       });
}

/// Says which stones had holes, the largest holes first: the blocks are heavier by them.
void reportHoles(const std::vector<int>& filled, double scale)
{
    std::vector<int> stones;
    double sum = 0;
    for (std::size_t stone = 0; stone < filled.size(); ++stone)
    {
        sum += filled[stone];
        if (filled[stone] > 0)
        {
            stones.push_back(static_cast<int>(stone));
        }
    }
    if (stones.empty())
    {
        return;
    }
    const auto areaOf = [&](int stone) { return filled[static_cast<std::size_t>(stone)] * scale * scale; };
    std::stable_sort(stones.begin(), stones.end(), [&](int a, int b) { return areaOf(a) > areaOf(b); });
    std::vector<std::string> texts;
    for (const int stone : stones)
    {
        texts.push_back(fmt::format("{} ({:.3g})", stone, areaOf(stone)));
    }
    info("Import: holes are filled, with what lies in them, {:.3g} m2 in all: blocks {}", sum * scale * scale,
         shownList(texts, 8));
}

/// \throws FatalIOError for a point that is not in the picture: its scale would be wrong
void refusePointsOutside(const Photograph& photograph, const Raster<std::uint8_t>& picture,
                         const ImportedFile& file, const SourceLocation& place)
{
    for (const Vector<2>& point : {photograph.points.first, photograph.points.second})
    {
        if (!(point.minCoeff() >= 0 && point.x() <= picture.width && point.y() <= picture.height))
        {
            throw FatalIOError(
                fmt::format("The point ({:g} {:g}) of `points` lies outside of this picture of {} x {} "
                            "pixels, {}, so that its scale would be wrong: measure it from the top left "
                            "corner.",
                            point.x(), point.y(), picture.width, picture.height, file.name),
                place);
        }
    }
}

StoneRaster stonesOf(const Photograph& photograph, const Raster<std::uint8_t>& picture,
                     const ImportedFile& file)
{
    StoneSettings settings = photograph.labels;
    settings.areLight = photograph.stones == Stones::light;
    StoneRaster stones = labelStones(picture, settings);
    if (stones.count == 0)
    {
        refuse(file, 0,
               "There is no stone in this picture: check `stones` (dark or light), `threshold` and "
               "`leastArea`.");
    }
    if (static_cast<std::size_t>(stones.count) > mostStones)
    {
        refuse(
            file, 0,
            fmt::format("There are {} stones in this picture, more than {}: a larger `leastArea` leaves out "
                        "specks.",
                        stones.count, mostStones));
    }
    return stones;
}

/// Outlines that are blocks and do not overlap. \param tolerance of the borders, halved until they are so
/// [pixels]
std::vector<Polygon> soundOutlines(const StoneRaster& stones, double& tolerance, const ImportedFile& file)
{
    constexpr int mostHalvings = 4;
    std::vector<Polygon> outlines = stoneOutlines(stones.labels, stones.count, tolerance);
    for (int halving = 0; (firstFault(outlines) >= 0 || doOverlap(outlines)) && halving < mostHalvings;
         ++halving)
    {
        tolerance = halving + 1 < mostHalvings ? tolerance / 2 : 0;
        outlines = stoneOutlines(stones.labels, stones.count, tolerance);
    }
    if (const int stone = firstFault(outlines); stone >= 0)
    {
        refuse(file, 0,
               fmt::format("The outline of stone {} {}: smooth the picture, or raise `leastArea`.", stone,
                           faultOf(outlines[static_cast<std::size_t>(stone)])));
    }
    return outlines;
}

/// Warns of stones whose areas, and so weights, straight borders change. \param tolerance of these [pixels]
void questionAreas(const StoneRaster& stones, const std::vector<Polygon>& outlines, double tolerance,
                   double scale)
{
    constexpr double mostChange =
        0.2; // of a stone; small ones change by an eighth within the usual tolerance
    std::vector<double> pixels(outlines.size(), 0);
    for (const int label : stones.labels.pixels)
    {
        if (label != noStone)
        {
            ++pixels[static_cast<std::size_t>(label)];
        }
    }
    double largest = mostChange;
    std::size_t worst = 0;
    int changed = 0;
    for (std::size_t stone = 0; stone < outlines.size(); ++stone)
    {
        const double change = std::abs(areaProperties(outlines[stone]).area / pixels[stone] - 1);
        changed += change > mostChange ? 1 : 0;
        if (change > largest)
        {
            largest = change;
            worst = stone;
        }
    }
    if (changed > 0)
    {
        printWarning(
            fmt::format("Borders within {:g} pixels change the areas of {} of {} stones by more than "
                        "{:g}%, and their weights: block {} has {:.3g} m2 instead of {:.3g} m2. A "
                        "smaller `tolerance` follows the stones.",
                        tolerance, changed, outlines.size(), 100 * mostChange, worst,
                        scale * scale * areaProperties(outlines[worst]).area, scale * scale * pixels[worst]));
    }
}

} // namespace

void declare(Options& options, Photograph& photograph)
{
    options.required("file", photograph.file, "picture, PNG, relative to the case")
        .example("\"constant/triSurface/wall.png\"");
    options
        .required("points", photograph.points,
                  "two points of the picture whose distance is known, from its top left corner [pixels]")
        .example("((40 470) (490 470))");
    options.required("distance", photograph.distance, "of these points").unit("m").above(0).example("2.5");
    options.optional("stones", photograph.stones, "whether stones are dark, or light, between mortar");
    options
        .optional("threshold", photograph.labels.threshold,
                  "brightness between the two, 0 black to 255 white")
        .atLeast(0)
        .atMost(254);
    options
        .optional("leastArea", photograph.labels.leastArea, "of a stone [pixels]; smaller spots are mortar")
        .atLeast(1);
    options.optional("mortar", photograph.labels.mortar, "widest joint that stones grow into [pixels]")
        .atLeast(0)
        .atMost(1000);
    options
        .optional("base", photograph.labels.base,
                  "height above the lowest stone from which stones reach down to the ground [pixels]")
        .atLeast(0)
        .atMost(10000);
    options
        .optional("tolerance", photograph.tolerance,
                  "by how far borders may leave the sides of pixels, to have fewer corners [pixels]")
        .atLeast(0)
        .atMost(100);
    options.optional("thickness", photograph.thickness, "out of plane").unit("m").above(0);
    options.check("points",
                  [&photograph]() -> std::string
                  {
                      return (photograph.points.first - photograph.points.second).norm() > 0
                                 ? ""
                                 : "The two points coincide: their distance gives no scale.";
                  });
}

Assembly<2> makeAssembly(const Photograph& photograph, const std::filesystem::path& caseDirectory,
                         const SourceLocation& place, const SourceLocation& placeOfPoints)
{
    const std::filesystem::path path = caseDirectory / photograph.file; // or the file, where it is absolute
    requireFile(path, place);
    const ImportedFile file = readSource(path);
    const Raster<std::uint8_t> picture = readPng(file);
    refusePointsOutside(photograph, picture, file, placeOfPoints);
    const StoneRaster stones = stonesOf(photograph, picture, file);
    double tolerance = photograph.tolerance;
    const std::vector<Polygon> outlines = soundOutlines(stones, tolerance, file);
    BoundingBox box;
    std::size_t corners = 0;
    for (const Polygon& outline : outlines)
    {
        corners += outline.size();
        for (const Vector<2>& corner : outline)
        {
            extend<2>(box, corner);
        }
    }
    const double scale = photograph.distance / (photograph.points.second - photograph.points.first).norm();
    info("Import: {}, {} x {} pixels of {:.4g} m: {} stones with {} corners, borders within {:g} pixels",
         file.name, picture.width, picture.height, scale, stones.count, corners, tolerance);
    reportHoles(stones.filled, scale);
    questionAreas(stones, outlines, tolerance, scale);
    if (tolerance < photograph.tolerance)
    {
        info("Import: borders within the stated tolerance of {:g} pixels would cross each other",
             photograph.tolerance);
    }
    Assembly<2> assembly;
    for (const Polygon& outline : outlines)
    {
        Polygon placed;
        for (const Vector<2>& corner : outline)
        {
            placed.emplace_back(scale * (corner - box.lower));
        }
        assembly.blocks.push_back({std::move(placed), photograph.thickness});
    }
    return assembly;
}

} // namespace drystone
