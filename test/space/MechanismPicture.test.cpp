// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// What is seen of bonded walls in their picture: bricks do not show what others hide.
#include "io/MechanismPicture.h"
#include "../MadeStructure.h"

#include "geometry/PolygonShape.h"
#include "io/Canvas.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <regex>
#include <sstream>

namespace drystone
{
namespace
{

struct Painted
{
    Polygon outline;
    std::string fill;
};

std::vector<Painted> polygonsOf(const std::string& svg)
{
    std::vector<Painted> result;
    const std::regex polygon("<polygon points=\"([^\"]*)\" fill=\"([^\"]*)\"");
    for (auto at = std::sregex_iterator(svg.begin(), svg.end(), polygon); at != std::sregex_iterator(); ++at)
    {
        Painted painted;
        painted.fill = (*at)[2];
        std::istringstream points((*at)[1]);
        char comma = ',';
        for (double x = 0, y = 0; points >> x >> comma >> y;)
        {
            painted.outline.emplace_back(x, y);
        }
        result.push_back(std::move(painted));
    }
    return result;
}

/// By even and odd crossings.
bool contains(const Polygon& outline, const Vector<2>& point)
{
    bool inside = false;
    for (std::size_t i = 0, j = outline.size() - 1; i < outline.size(); j = i++)
    {
        if ((outline[i].y() > point.y()) != (outline[j].y() > point.y())
            && point.x() < outline[i].x()
                               + (outline[j].x() - outline[i].x()) * (point.y() - outline[i].y())
                                     / (outline[j].y() - outline[i].y()))
        {
            inside = !inside;
        }
    }
    return inside;
}

TEST(MechanismPicture, ShowsOfBondedWallsNoBrickUnderAnother)
{
    const Assembly<3> walls = madeStructure<3>(Dictionary::readString(
        "dimensions 3;\n"
        "texture { type walls; unit (0.25 0.125 0.065); bond english; courses 20;\n"
        "    walls { front { from (0 0); direction (1 0); length 8; thickness left; }\n"
        "            side { from (0 0); direction (0 1); length 6; thickness right; } }\n"
        "    openings ( { wall front; from (2 4); to (4 12); lintel 0.5; } ); }\n"
        "supports { ground { type ground; } }\n"));
    const std::string svg = mechanismSvg(walls, std::vector<Placement<3>>(walls.blocks.size()), {});
    const std::vector<Painted> painted = polygonsOf(svg);
    ASSERT_GT(painted.size(), walls.blocks.size());

    // At rest faces have one colour a direction. What a grid of points shows is what was painted last there.
    std::map<std::string, double> shown;
    for (double x = 0.5; x < 640; x += 2)
    {
        for (double y = 0.5; y < 900; y += 2)
        {
            std::string fill;
            for (const Painted& polygon : painted)
            {
                if (contains(polygon.outline, {x, y}))
                {
                    fill = polygon.fill;
                }
            }
            shown[fill] += 1;
        }
    }
    shown.erase("");                   // the page
    shown.erase(painted.front().fill); // the ground, painted first
    ASSERT_EQ(shown.size(), 3U);       // what looks to the front, to the right and up
    double front = 0;
    double top = std::numeric_limits<double>::max();
    for (const auto& [fill, area] : shown)
    {
        front = std::max(front, area);
        top = std::min(top, area);
    }
    // Nothing hides the front of 2 x 1.3 m with its opening of 0.5 x 0.52 m. Seen from above are the tops of
    // 2 x 0.25 and 1.25 x 0.25 m and some of the sill of 0.5 x 0.25 m, from an azimuth of -55 degrees, 25
    // high.
    const double degree = std::acos(-1.0) / 180;
    const double wholeFront = (2 * 1.3 - 0.5 * 0.52) * std::cos(25 * degree) * std::sin(55 * degree);
    const double tops = 3.25 * 0.25 * std::sin(25 * degree);
    const double sill = 0.5 * 0.25 * std::sin(25 * degree);
    EXPECT_GE(top / front, 0.97 * tops / wholeFront);
    EXPECT_LE(top / front, 1.03 * (tops + sill) / wholeFront);
}

TEST(MechanismPicture, ShowsTheWholeGroundAndNothingOutsideItsPage)
{
    const Assembly<3> wall = madeStructure<3>(Dictionary::readString(
        "dimensions 3;\n"
        "texture { type walls; unit (0.25 0.125 0.065); bond running; courses 10;\n"
        "    walls { front { from (0 0); direction (1 0); length 8; thickness left; } } }\n"
        "supports { ground { type ground; } }\n"));
    const Canvas drawn = drawnMechanism(wall, std::vector<Placement<3>>(wall.blocks.size()), {});
    const auto isClip = [](const CanvasShape& shape) { return std::holds_alternative<CanvasClip>(shape); };
    const auto clip = std::find_if(drawn.shapes.begin(), drawn.shapes.end(), isClip);
    ASSERT_NE(clip, drawn.shapes.end());
    const auto& room = std::get<CanvasClip>(*clip);
    std::size_t polygons = 0;
    for (auto shape = clip; !std::holds_alternative<CanvasClipEnd>(*shape); ++shape)
    {
        if (const auto* path = std::get_if<CanvasPath>(&*shape))
        {
            ++polygons;
            for (const Vector<2>& point : path->pieces.front())
            {
                EXPECT_GE(point.x(), room.corner.x());
                EXPECT_LE(point.x(), room.corner.x() + room.width);
                EXPECT_GE(point.y(), room.corner.y());
                EXPECT_LE(point.y(), room.corner.y() + room.height);
            }
        }
    }
    EXPECT_GT(polygons, wall.blocks.size()); // the ground, first, and the blocks
}

} // namespace
} // namespace drystone
