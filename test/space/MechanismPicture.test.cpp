// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// What is seen of a bonded wall in its picture: the faces that look at the viewer, each as large as it is.
#include "io/MechanismPicture.h"

#include "geometry/PolygonShape.h"
#include "texture/Texture.h"

#include <gtest/gtest.h>

#include <cmath>
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

TEST(MechanismPicture, ShowsOfABondedWallItsFrontItsSideAndItsTopAlone)
{
    const Assembly<3> wall = makeStructure<3>(Dictionary::readString(
        "dimensions 3;\n"
        "texture { type walls; unit (0.25 0.125 0.065); bond english; courses 20;\n"
        "    walls { wall { from (0 0); direction (1 0); length 8; thickness left; } } }\n"
        "supports { ground { type ground; } }\n"));
    const std::string svg = mechanismSvg(wall, std::vector<Placement<3>>(wall.blocks.size()), {});
    const std::vector<Painted> painted = polygonsOf(svg);
    ASSERT_GT(painted.size(), wall.blocks.size());

    // What a grid of points shows: the polygon that was painted last there.
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
    std::vector<double> areas;
    for (const auto& [fill, area] : shown)
    {
        areas.push_back(area);
    }
    std::sort(areas.rbegin(), areas.rend());
    ASSERT_EQ(areas.size(), 3U);
    // Faces of 2 x 1.3, 2 x 0.25 and 0.25 x 1.3 m, seen at an azimuth of -55 degrees and from 25 above.
    const double degree = std::acos(-1.0) / 180;
    const double front = 2 * 1.3 * std::cos(25 * degree) * std::sin(55 * degree);
    const double top = 2 * 0.25 * std::sin(25 * degree);
    const double side = 0.25 * 1.3 * std::cos(25 * degree) * std::cos(55 * degree);
    EXPECT_NEAR(areas[1] / areas[0], top / front, 0.01);
    EXPECT_NEAR(areas[2] / areas[0], side / front, 0.01);
}

} // namespace
} // namespace drystone
