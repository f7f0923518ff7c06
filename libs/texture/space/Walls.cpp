// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Makes the blocks of the texture `walls` from its settings.
#include "texture/space/Walls.h"

#include "texture/Limits.h"
#include "texture/OpeningsCheck.h"
#include "texture/space/WallBond.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace drystone
{

namespace
{

/// A wall in plan, with all that its courses depend on.
struct Wall
{
    Vector<2> from;
    Vector<2> along;      ///< unit vector
    Vector<2> across;     ///< unit vector from the line into the wall
    double length = 0;    ///< [m]
    double thickness = 0; ///< [m]
    int firstCourse = 0;  ///< 0: course 0 is an even one of the bond, 1: an odd one
};

/// Where a wall crosses another, in the other's coordinates.
struct Crossing
{
    int other = -1;          ///< index of the wall that runs through
    Interval along = {0, 0}; ///< of it, along this wall [m]
    bool onEven = true;      ///< whether the other runs through on even courses
};

std::vector<Wall> wallsInPlan(const Walls& settings)
{
    std::vector<Wall> walls;
    for (const auto& [name, line] : settings.walls)
    {
        Wall wall;
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

/// The rectangle of a wall in the coordinates of another one, along and across.
std::array<Interval, 2> rectangleIn(const Wall& frame, const Wall& wall)
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

bool overlap(const Interval& a, const Interval& b, double tolerance)
{
    return std::min(a.to, b.to) - std::max(a.from, b.from) > tolerance;
}

/// For each wall the crossings at which it stops. \param fault what is wrong with walls that meet, if
/// anything
std::vector<std::vector<Crossing>> findCrossings(const Walls& settings, const std::vector<Wall>& walls,
                                                 std::string& fault)
{
    const double tolerance = 1e-6 * settings.unit.minCoeff();
    std::vector<std::vector<Crossing>> crossings(walls.size());
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
                        "Walls {} and {} overlap and are not at right angles: walls that meet must be.",
                        settings.walls[i].first, settings.walls[j].first);
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
                  [](const Crossing& a, const Crossing& b) { return a.along.from < b.along.from; });
    }
    return crossings;
}

std::string openingFault(const Walls& settings, const WallOpening& opening)
{
    const auto wall = std::find_if(settings.walls.begin(), settings.walls.end(),
                                   [&](const auto& named) { return named.first == opening.wall; });
    if (wall == settings.walls.end())
    {
        return fmt::format("is in wall {}, and there is no wall of this name.", opening.wall);
    }
    const Vector<2>& from = opening.from;
    const Vector<2>& to = opening.to;
    const std::string corners = fmt::format("({:g} {:g})-({:g} {:g})", from.x(), from.y(), to.x(), to.y());
    const double length = wallLength(settings, wall->second.length) / settings.unit.x();
    if (!(from.x() < to.x()) || !(from.y() < to.y()))
    {
        return corners + " has no area: \"from\" is its lower corner, \"to\" its upper one.";
    }
    if (to.x() > length * (1 + 1e-9) || to.y() > settings.courses)
    {
        return fmt::format("{} reaches outside wall {}, which is {:g} bricks long and {} courses high.",
                           corners, opening.wall, length, settings.courses);
    }
    if (from.y() != std::round(from.y()) || to.y() != std::round(to.y()))
    {
        return corners + " ends within a course: blocks are cut at the jambs only. Give whole courses.";
    }
    if (opening.lintel)
    {
        if (to.y() >= settings.courses)
        {
            return corners + " reaches up to the top of the wall: there is no course above it for a lintel.";
        }
        if (from.x() - *opening.lintel < -1e-9 || to.x() + *opening.lintel > length * (1 + 1e-9))
        {
            return fmt::format(
                "{} has a lintel that reaches past the end of wall {}, which is {:g} bricks long.", corners,
                opening.wall, length);
        }
    }
    return {};
}

/// The bricks of one course of a wall, openings and lintels included, without regard to other walls.
std::vector<Brick> courseOf(const Walls& settings, const std::string& name, const Wall& wall, int course)
{
    std::vector<Brick> bricks = bondCourse(settings, wall.length, course, wall.firstCourse);
    const double unit = settings.unit.x();
    for (const WallOpening& opening : settings.openings)
    {
        if (opening.wall == name && opening.lintel && course == opening.to.y())
        {
            const Interval lintel{std::max(0.0, (opening.from.x() - *opening.lintel) * unit),
                                  std::min(wall.length, (opening.to.x() + *opening.lintel) * unit)};
            subtract(bricks, lintel);
            bricks.push_back({lintel, {0, wall.thickness}});
        }
    }
    for (const WallOpening& opening : settings.openings)
    {
        if (opening.wall == name && course >= opening.from.y() && course < opening.to.y())
        {
            subtract(bricks, {opening.from.x() * unit, opening.to.x() * unit});
        }
    }
    std::sort(bricks.begin(), bricks.end(),
              [](const Brick& a, const Brick& b)
              { return std::pair(a.along.from, a.across.from) < std::pair(b.along.from, b.across.from); });
    return bricks;
}

Block<3> blockOf(const Wall& wall, const Brick& brick, double lower, double upper)
{
    Polygon plan;
    for (const auto& [s, d] : {std::pair(brick.along.from, brick.across.from),
                               {brick.along.to, brick.across.from},
                               {brick.along.to, brick.across.to},
                               {brick.along.from, brick.across.to}})
    {
        plan.emplace_back(wall.from + s * wall.along + d * wall.across);
    }
    if (areaProperties(plan).area < 0) // the wall is on the right of its line
    {
        std::reverse(plan.begin(), plan.end());
    }
    std::vector<Vector<3>> bottom;
    std::vector<Vector<3>> top;
    for (const Vector<2>& corner : plan)
    {
        bottom.emplace_back(corner.x(), corner.y(), lower);
        top.emplace_back(corner.x(), corner.y(), upper);
    }
    return {makePrism(bottom, top)};
}

} // namespace

void declare(Options& options, WallLine& wall)
{
    options.required("from", wall.from, "where the wall begins, on one of its faces")
        .unit("m")
        .example("(0 0)");
    options.optional("direction", wall.direction, "along the wall");
    options.required("length", wall.length, "in bricks; of a flemish bond, pairs of stretchers")
        .above(0)
        .atMost(maximumBlocks)
        .example("8");
    options.optional("thickness", wall.thickness,
                     "the side of this line on which the wall stands, seen along it");
    options.check("direction",
                  [&wall]() -> std::string {
                      return wall.direction.norm() > 0 ? ""
                                                       : "A direction of length 0 is none: (1 0) is along x.";
                  });
}

void declare(Options& options, WallOpening& opening)
{
    options.required("wall", opening.wall, "the name of the wall").example("front");
    options.required("from", opening.from, "lower corner, in (bricks, courses) from where the wall begins")
        .atLeast(0)
        .example("(2 4)");
    options.required("to", opening.to, "upper corner, likewise").above(0).example("(4 12)");
    options
        .optional("lintel", opening.lintel,
                  "bearing, in bricks, at both ends of one block over the opening, in the course above; "
                  "absent: the "
                  "course above goes on")
        .atLeast(0)
        .example("0.5");
}

void declare(Options& options, Walls& walls)
{
    options.required("unit", walls.unit, "length, width, height of a brick")
        .unit("m")
        .above(0)
        .example("(0.25 0.125 0.065)");
    options.optional("bond", walls.bond,
                     "how the bricks lie; header, english and flemish need length = 2 width");
    options.required("courses", walls.courses, "number of courses")
        .atLeast(1)
        .atMost(maximumBlocks)
        .example("20");
    options.optional("leaves", walls.leaves, "of a running bond, one behind the other").atLeast(1).atMost(2);
    options
        .optional("headersEvery", walls.headersEvery,
                  "of two leaves: each so many courses one of headers that reach through both; 0: none")
        .atLeast(0);
    options.required("walls", walls.walls, "the walls in plan, each with a name of yours").example("front");
    options.optional("openings", walls.openings, "doors and windows; blocks are cut at the jambs");
    options.check("bond", [&walls] { return bondFault(walls); });
    options.check("walls",
                  [&walls]() -> std::string
                  {
                      double blocks = 0;
                      for (const auto& [name, line] : walls.walls)
                      {
                          blocks += 4 * line.length * walls.courses;
                      }
                      if (blocks > 4.0 * maximumBlocks)
                      {
                          return fmt::format("These walls have more than {} bricks: make them smaller.",
                                             maximumBlocks);
                      }
                      std::string fault;
                      findCrossings(walls, wallsInPlan(walls), fault);
                      return fault;
                  });
    checkOpenings(options, walls.openings,
                  [&walls](const auto& opening) { return openingFault(walls, opening); });
}

Assembly<3> makeAssembly(const Walls& settings)
{
    std::vector<Wall> walls = wallsInPlan(settings);
    std::string fault;
    const std::vector<std::vector<Crossing>> crossings = findCrossings(settings, walls, fault);
    for (std::size_t i = 0; i < walls.size(); ++i)
    {
        walls[i].firstCourse = !crossings[i].empty() && crossings[i].front().onEven ? 1 : 0;
    }
    Assembly<3> assembly;
    for (int course = 0; course < settings.courses; ++course)
    {
        const double lower = course * settings.unit.z();
        const double upper = (course + 1) * settings.unit.z();
        for (std::size_t i = 0; i < walls.size(); ++i)
        {
            std::vector<Brick> bricks = courseOf(settings, settings.walls[i].first, walls[i], course);
            for (const Crossing& crossing : crossings[i])
            {
                if (crossing.onEven == (course % 2 == 0))
                {
                    subtract(bricks, crossing.along);
                }
            }
            for (const Brick& brick : bricks)
            {
                assembly.blocks.push_back(blockOf(walls[i], brick, lower, upper));
            }
        }
    }
    return assembly;
}

} // namespace drystone
