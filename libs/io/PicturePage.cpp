// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// One scale fits width and height; a load that is seen along its own direction becomes a dot.
#include "io/PicturePage.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace drystone
{

namespace
{

/// Seen along its own direction a load is a point.
constexpr double leastSeen = 0.2;

constexpr double margin = 16; // [px]

/// [px/m] \param world size of what is drawn [m]
double scaleOf(const MechanismPicture& picture, const Vector<2>& world)
{
    return std::min((picture.width - 2 * margin) / world.x(), 1.4 * picture.width / world.y());
}

/// From tail to tip [px].
double lengthOf(const LoadTip& tip)
{
    return 18 + 22 * tip.part;
}

} // namespace

PicturePage makePicturePage(const MechanismPicture& picture, const Vector<2>& world)
{
    constexpr double legend = 72;
    const double head = picture.title.empty() && picture.subtitle.empty() ? margin : 64;
    const double scale = scaleOf(picture, world);
    const Vector<2> room = scale * world;
    PicturePage page{
        scale, {(picture.width - room.x()) / 2, head}, room, Canvas(picture.width, head + room.y() + legend)};
    const double widest = picture.width - 2 * margin;
    if (!picture.title.empty())
    {
        page.drawing.textWithin(widest, {picture.width / 2, 28}, picture.title,
                                {.size = 17, .anchor = TextAnchor::middle, .weight = "bold"});
    }
    if (!picture.subtitle.empty())
    {
        page.drawing.textWithin(widest, {picture.width / 2, 50}, picture.subtitle,
                                {.size = 14, .anchor = TextAnchor::middle});
    }
    return page;
}

double roundLength(double length)
{
    const double power = std::pow(10, std::floor(std::log10(length)));
    for (const double factor : {5.0, 2.0})
    {
        if (factor * power <= length * (1 + 1e-12))
        {
            return factor * power;
        }
    }
    return power;
}

void paintLoadArrow(Canvas& drawing, const Vector<2>& tip, const Vector<2>& onPage, double length)
{
    const ShapeStyle red{.stroke = "#b3261e", .strokeWidth = 2.2};
    if (onPage.norm() < leastSeen)
    {
        drawing.circle(tip, 3, {.fill = red.stroke});
        return;
    }
    const Vector<2> along = onPage.normalized();
    const Vector<2> across(-along.y(), along.x());
    drawing.line(tip - length * onPage, tip - 5 * along, red);
    drawing.polygon({tip, tip - 8 * along + 4 * across, tip - 8 * along - 4 * across}, {.fill = red.stroke});
}

Box<2> areaWithLoads(const MechanismPicture& picture, const Box<2>& area, const std::vector<LoadTip>& tips,
                     const Vector<2>& onPage)
{
    // What arrows add to the area makes the scale smaller, and so them longer in metres: each turn leaves at
    // most a sixth of what the last one lacked.
    constexpr int turns = 8;
    constexpr double halfHead = 5; // across the arrow [px]
    const Vector<2> along(onPage.x(), -onPage.y());
    Box<2> result = area;
    for (int turn = 0; turn < turns; ++turn)
    {
        const double scale = scaleOf(picture, result.upper - result.lower);
        result = area;
        for (const LoadTip& tip : tips)
        {
            for (const Vector<2>& end : {tip.place, Vector<2>(tip.place - lengthOf(tip) / scale * along)})
            {
                extend<2>(result, Vector<2>(end.array() - halfHead / scale));
                extend<2>(result, Vector<2>(end.array() + halfHead / scale));
            }
        }
    }
    return result;
}

void paintLoads(PicturePage& page, const Box<2>& area, const std::vector<LoadTip>& tips,
                const Vector<2>& onPage)
{
    for (const LoadTip& tip : tips)
    {
        const Vector<2> place(tip.place.x() - area.lower.x(), area.upper.y() - tip.place.y());
        paintLoadArrow(page.drawing, page.corner + page.scale * place, onPage, lengthOf(tip));
    }
}

void paintNotes(PicturePage& page, const MechanismPicture& picture, const Vector<2>& onPage)
{
    constexpr double size = 12;
    Canvas& drawing = page.drawing;
    const double y = page.legend() + 30;
    double x = leftOfLegend;
    // A sixth of the page, rounded down.
    const double metres = roundLength(picture.width / 6 / page.scale);
    const double bar = metres * page.scale;
    const ShapeStyle ink{.stroke = "#222222", .strokeWidth = 1.4};
    drawing.line({x, y + 7}, {x + bar, y + 7}, ink);
    for (const double end : {x, x + bar})
    {
        drawing.line({end, y + 3}, {end, y + 11}, ink);
    }
    const std::string length = fmt::format("{:g} m", metres);
    drawing.text({x + bar + 6, y + 11}, length, {.size = size});
    x += bar + 6 + textWidth(length, size) + 18;
    if (picture.load)
    {
        const bool isPoint = onPage.norm() < leastSeen;
        paintLoadArrow(drawing, Vector<2>(x + 13, y + 7) + (isPoint ? 0 : 13) * onPage, onPage, 26);
        drawing.text({x + 32, y + 11}, picture.load->label, {.size = size});
        x += 32 + textWidth(picture.load->label, size) + 18;
    }
    if (!picture.motion.empty())
    {
        drawing.text({x, y + 11}, picture.motion, {.size = size});
    }
}

} // namespace drystone
