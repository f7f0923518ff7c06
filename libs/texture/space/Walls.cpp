// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Makes the blocks of the texture `walls` from its settings.
#include "texture/space/Walls.h"

#include "texture/Limits.h"
#include "texture/OpeningsCheck.h"
#include "texture/space/WallBond.h"
#include "texture/space/WallOpenings.h"
#include "texture/space/WallPlan.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace drystone
{

namespace
{

/// The bricks of one course of a wall, openings and lintels included, without regard to other walls.
std::vector<Brick> courseOf(const Walls& settings, const std::string& name, const WallInPlan& wall,
                            int course)
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

Block<3> blockOf(const WallInPlan& wall, const Brick& brick, double lower, double upper)
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

/// About how many bricks the bond has, openings and junctions included.
double brickCount(const Walls& walls)
{
    const double inLength = walls.bond == Bond::flemish                                 ? 3
                            : walls.bond == Bond::header || walls.bond == Bond::english ? 2
                                                                                        : walls.leaves;
    double length = 0;
    for (const auto& [name, line] : walls.walls)
    {
        length += line.length;
    }
    return inLength * length * walls.courses;
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
                  "absent: the course above goes on")
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
    options.optional("openings", walls.openings,
                     "doors and windows; blocks are cut at the jambs, and those of another wall where an "
                     "opening goes over the whole of the junction with it");
    options.check("bond", [&walls] { return bondFault(walls); });
    options.check("walls",
                  [&walls]() -> std::string
                  {
                      if (std::string fault = countFault(brickCount(walls), "This plan of walls");
                          !fault.empty())
                      {
                          return fault;
                      }
                      std::string fault;
                      findCrossings(walls, wallsInPlan(walls), fault);
                      return fault;
                  });
    checkOpenings(options, walls.openings,
                  [&walls](const auto& opening) { return wallOpeningFault(walls, opening); });
}

Assembly<3> makeAssembly(const Walls& settings)
{
    std::vector<WallInPlan> walls = wallsInPlan(settings);
    std::string fault;
    const std::vector<std::vector<WallCrossing>> crossings = findCrossings(settings, walls, fault);
    for (std::size_t i = 0; i < walls.size(); ++i)
    {
        walls[i].firstCourse = !crossings[i].empty() && crossings[i].front().onEven ? 1 : 0;
    }
    const std::vector<std::vector<JunctionHole>> holes = junctionHoles(settings, walls, crossings);
    Assembly<3> assembly;
    for (int course = 0; course < settings.courses; ++course)
    {
        const double lower = course * settings.unit.z();
        const double upper = (course + 1) * settings.unit.z();
        for (std::size_t i = 0; i < walls.size(); ++i)
        {
            std::vector<Brick> bricks = courseOf(settings, settings.walls[i].first, walls[i], course);
            for (const WallCrossing& crossing : crossings[i])
            {
                if (crossing.onEven == (course % 2 == 0))
                {
                    subtract(bricks, crossing.along);
                }
            }
            for (const JunctionHole& hole : holes[i])
            {
                if (course >= hole.bottom && course < hole.top)
                {
                    subtract(bricks, hole.along);
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
