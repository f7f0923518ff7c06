// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Checks the openings of the texture `walls` and finds what they cut out of other walls.
#include "texture/space/WallOpenings.h"

#include "texture/OpeningsCheck.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace drystone
{

namespace
{

/// All that the walls are in plan.
struct Plan
{
    std::vector<WallInPlan> walls;
    std::vector<std::vector<WallCrossing>> crossings;
};

int indexOf(const Walls& settings, const std::string& name)
{
    const auto wall = std::find_if(settings.walls.begin(), settings.walls.end(),
                                   [&](const auto& named) { return named.first == name; });
    return wall == settings.walls.end() ? -1 : static_cast<int>(wall - settings.walls.begin());
}

Interval jambsOf(const Walls& settings, const WallOpening& opening, double bearing = 0)
{
    return {(opening.from.x() - bearing) * settings.unit.x(), (opening.to.x() + bearing) * settings.unit.x()};
}

/// A length for messages, without what rounding leaves of zero.
double inBricks(double length, const Walls& settings)
{
    constexpr double rounding = 1e-9;
    return std::round(length / settings.unit.x() / rounding) * rounding + 0.0; // which turns -0 into 0
}

bool covers(const Interval& whole, const Interval& part, double tolerance)
{
    return whole.from <= part.from + tolerance && whole.to >= part.to - tolerance;
}

bool isThroughIn(const WallCrossing& crossing, double course)
{
    return crossing.onEven == (std::fmod(course, 2) == 0);
}

/// Of an opening by itself in its wall.
std::string placeFault(const Walls& settings, const WallOpening& opening, double length)
{
    const Vector<2>& from = opening.from;
    const Vector<2>& to = opening.to;
    const std::string corners = cornersOf(opening);
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
    if (opening.lintel && to.y() >= settings.courses)
    {
        return corners + " reaches up to the top of the wall: there is no course above it for a lintel.";
    }
    if (opening.lintel
        && (from.x() - *opening.lintel < -1e-9 || to.x() + *opening.lintel > length * (1 + 1e-9)))
    {
        return fmt::format("{} has a lintel that reaches past the end of wall {}, which is {:g} bricks long.",
                           corners, opening.wall, length);
    }
    return {};
}

/// Of an opening that leaves a part of a junction standing, in which the other wall's blocks could not be cut
/// at their heads.
std::string junctionFault(const Walls& settings, const Plan& plan, int wall, const WallOpening& opening)
{
    const double tolerance = planTolerance(settings);
    const Interval jambs = jambsOf(settings, opening);
    for (const WallCrossing& crossing : plan.crossings[wall])
    {
        double through = opening.from.y(); // the first course in which the other wall runs through
        through += isThroughIn(crossing, through) ? 0 : 1;
        if (through < opening.to.y() && overlap(jambs, crossing.along, tolerance)
            && !covers(jambs, crossing.along, tolerance))
        {
            return fmt::format("{} reaches into the junction with wall {}, which takes {:g} to {:g} bricks "
                               "of wall {} and runs through in course {:g}. End the opening before the "
                               "junction, or let it go over the whole of it.",
                               cornersOf(opening), settings.walls[crossing.other].first,
                               inBricks(crossing.along.from, settings), inBricks(crossing.along.to, settings),
                               opening.wall, through);
        }
    }
    return {};
}

/// Of a lintel in the course above an opening, where another wall or its opening takes a part of it.
std::string lintelJunctionFault(const Walls& settings, const Plan& plan, int wall, const WallOpening& opening)
{
    if (!opening.lintel)
    {
        return {};
    }
    const double tolerance = planTolerance(settings);
    const double course = opening.to.y();
    const Interval lintel = jambsOf(settings, opening, *opening.lintel);
    for (const WallCrossing& crossing : plan.crossings[wall])
    {
        if (isThroughIn(crossing, course) && overlap(lintel, crossing.along, tolerance))
        {
            return lintelText(opening, "bricks")
                   + fmt::format(", and there wall {} runs through from {:g} to {:g}. Let the opening end a "
                                 "course higher or lower, where wall {} does, or keep the lintel out of the "
                                 "junction.",
                                 settings.walls[crossing.other].first,
                                 inBricks(crossing.along.from, settings),
                                 inBricks(crossing.along.to, settings), opening.wall);
        }
    }
    const auto holes = junctionHoles(settings, plan.walls, plan.crossings);
    for (const JunctionHole& hole : holes[wall])
    {
        if (hole.bottom <= course && course < hole.top && overlap(lintel, hole.along, tolerance))
        {
            return lintelText(opening, "bricks")
                   + fmt::format(", and there an opening of the wall that it meets is cut from {:g} to {:g}. "
                                 "Move one of the openings, or keep the lintel out of the junction.",
                                 inBricks(hole.along.from, settings), inBricks(hole.along.to, settings));
        }
    }
    return {};
}

} // namespace

std::vector<std::vector<JunctionHole>> junctionHoles(const Walls& settings,
                                                     const std::vector<WallInPlan>& walls,
                                                     const std::vector<std::vector<WallCrossing>>& crossings)
{
    std::vector<std::vector<JunctionHole>> holes(walls.size());
    for (const WallOpening& opening : settings.openings)
    {
        const int own = indexOf(settings, opening.wall);
        for (std::size_t i = 0; own >= 0 && i < walls.size(); ++i)
        {
            const auto meets = [](const std::vector<WallCrossing>& all, std::size_t other)
            {
                return std::find_if(all.begin(), all.end(),
                                    [other](const WallCrossing& crossing)
                                    { return crossing.other == static_cast<int>(other); });
            };
            const auto ofOwn = meets(crossings[own], i);
            const auto ofOther = meets(crossings[i], static_cast<std::size_t>(own));
            if (ofOwn != crossings[own].end() && ofOther != crossings[i].end()
                && covers(jambsOf(settings, opening), ofOwn->along, planTolerance(settings)))
            {
                holes[i].push_back({ofOther->along, opening.from.y(), opening.to.y()});
            }
        }
    }
    return holes;
}

std::string wallOpeningFault(const Walls& settings, const WallOpening& opening)
{
    const int wall = indexOf(settings, opening.wall);
    if (wall < 0)
    {
        std::string names;
        for (const auto& [name, other] : settings.walls)
        {
            names += " " + name;
        }
        return fmt::format("is in wall {}, and there is no wall of this name. There are:{}.", opening.wall,
                           names);
    }
    const double length = wallLength(settings, settings.walls[wall].second.length) / settings.unit.x();
    if (std::string fault = placeFault(settings, opening, length); !fault.empty())
    {
        return fault;
    }
    const auto isInSameWall = [](const WallOpening& a, const WallOpening& b) { return a.wall == b.wall; };
    if (std::string fault = lintelFault(settings.openings, opening, "bricks", isInSameWall); !fault.empty())
    {
        return fault;
    }
    Plan plan;
    plan.walls = wallsInPlan(settings);
    std::string faultOfWalls; // reported before those of openings
    plan.crossings = findCrossings(settings, plan.walls, faultOfWalls);
    if (std::string fault = junctionFault(settings, plan, wall, opening); !fault.empty())
    {
        return fault;
    }
    return lintelJunctionFault(settings, plan, wall, opening);
}

} // namespace drystone
