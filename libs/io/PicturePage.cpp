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

} // namespace

PicturePage makePicturePage(const MechanismPicture& picture, const Vector<2>& world)
{
    constexpr double margin = 16;
    constexpr double legend = 72;
    const double head = picture.title.empty() && picture.subtitle.empty() ? margin : 64;
    const double scale = std::min((picture.width - 2 * margin) / world.x(), 1.4 * picture.width / world.y());
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
