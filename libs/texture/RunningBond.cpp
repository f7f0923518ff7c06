// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Makes the blocks of the texture `runningBond` from its settings.
#include "texture/RunningBond.h"

#include "texture/Interval.h"
#include "texture/Limits.h"
#include "texture/OpeningsCheck.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace drystone
{

namespace
{

/// Keeps the parts of the pieces outside the interval `hole`, but those that are rounding.
constexpr double rounding = 1e-9; // of a unit: 1.1 - 0.6 is not quite 0.5

void subtract(std::vector<Interval>& pieces, const Interval& hole)
{
    std::vector<Interval> left;
    for (const Interval& piece : pieces)
    {
        if (hole.to <= piece.from + rounding || hole.from >= piece.to - rounding)
        {
            left.push_back(piece);
            continue;
        }
        if (hole.from > piece.from + rounding)
        {
            left.push_back({piece.from, hole.from});
        }
        if (hole.to < piece.to - rounding)
        {
            left.push_back({hole.to, piece.to});
        }
    }
    pieces = std::move(left);
}

std::string openingFault(const RunningBond& bond, const Opening& opening)
{
    const Vector<2>& from = opening.from;
    const Vector<2>& to = opening.to;
    const std::string corners = cornersOf(opening);
    if (!(from.x() < to.x()) || !(from.y() < to.y()))
    {
        return corners + " has no area: \"from\" is its lower left corner, \"to\" its upper right one.";
    }
    if (from.x() < 0 || from.y() < 0 || to.x() > bond.length || from.y() >= bond.courses)
    {
        return corners
               + fmt::format(" reaches outside the wall, which is {:g} units long and {} courses high.",
                             bond.length, bond.courses);
    }
    if (from.y() != std::round(from.y()) || to.y() != std::round(to.y()))
    {
        return corners + " ends within a course: blocks are cut at the jambs only. Give whole courses.";
    }
    if (opening.lintel && to.y() >= bond.courses)
    {
        return corners + " reaches up to the top of the wall: there is no course above it for a lintel.";
    }
    if (opening.lintel && (from.x() - *opening.lintel < 0 || to.x() + *opening.lintel > bond.length))
    {
        return corners
               + fmt::format(" has a lintel that reaches past an end of the wall, which is {:g} units long.",
                             bond.length);
    }
    return lintelFault(bond.openings, opening, "units", [](const Opening&, const Opening&) { return true; });
}

/// An opening may go on above the wall, as one that was drawn for a higher wall: what is there is cut out.
std::string openingDoubt(const RunningBond& bond)
{
    for (std::size_t i = 0; i < bond.openings.size(); ++i)
    {
        const double top = bond.openings[i].to.y();
        if (top > bond.courses)
        {
            return fmt::format("Opening {} reaches up to course {:g}, and the wall is {} courses high: it is "
                               "open at the top.",
                               i, top, bond.courses);
        }
    }
    return {};
}

} // namespace

void declare(Options& options, Opening& opening)
{
    options.required("from", opening.from, "lower left corner, in (units, courses)")
        .atLeast(0)
        .example("(1.5 3)");
    options.required("to", opening.to, "upper right corner, in (units, courses)").above(0).example("(2.5 5)");
    options
        .optional(
            "lintel", opening.lintel,
            "bearing, in units, at both ends of one block over the opening, in the course above; absent: the "
            "course above goes on")
        .atLeast(0)
        .example("0.5");
}

void declare(Options& options, RunningBond& bond)
{
    options.required("unit", bond.unit, "length of a full block, height of a course")
        .unit("m")
        .above(0)
        .example("(0.4 0.175)");
    options.optional("thickness", bond.thickness, "out of plane").unit("m").above(0);
    options.required("length", bond.length, "of the wall, in units")
        .above(0)
        .atMost(maximumBlocks)
        .example("5");
    options.required("courses", bond.courses, "number of courses")
        .atLeast(1)
        .atMost(maximumBlocks)
        .example("6");
    options.optional("firstCourse", bond.firstCourse,
                     "half: the bottom course starts and ends with half a block; full: it does not");
    options.optional("openings", bond.openings, "doors and windows; blocks are cut at the jambs");
    options.check("courses",
                  [&bond]
                  {
                      return countFault(
                          bond.length * bond.courses,
                          fmt::format("A wall of {:g} units by {} courses", bond.length, bond.courses));
                  });
    checkOpenings(options, bond.openings,
                  [&bond](const auto& opening) { return openingFault(bond, opening); });
    options.question("openings", [&bond] { return openingDoubt(bond); });
}

Assembly<2> makeAssembly(const RunningBond& bond)
{
    Assembly<2> assembly;
    assembly.blocks.reserve(static_cast<std::size_t>((bond.length + 1) * bond.courses));
    for (int course = 0; course < bond.courses; ++course)
    {
        const bool startsHalf = (course % 2 == 0) == (bond.firstCourse == FirstCourse::half);
        const double bottom = course * bond.unit.y();
        const double top = (course + 1) * bond.unit.y();
        // Joints lie at k + 1/2 or k units, which binary numbers represent exactly, so that courses two apart
        // have identical corners.
        std::vector<Interval> pieces;
        double from = 0;
        for (int k = 0; from < bond.length - rounding; ++k)
        {
            const double to = std::min(bond.length, startsHalf ? k + 0.5 : k + 1.0);
            pieces.push_back({from, to});
            from = to;
        }
        for (const Opening& opening : bond.openings)
        {
            if (opening.lintel && course == opening.to.y())
            {
                const Interval lintel{opening.from.x() - *opening.lintel, opening.to.x() + *opening.lintel};
                subtract(pieces, lintel);
                pieces.push_back(lintel);
            }
        }
        for (const Opening& opening : bond.openings)
        {
            if (course >= opening.from.y() && course < opening.to.y())
            {
                subtract(pieces, {opening.from.x(), opening.to.x()});
            }
        }
        std::sort(pieces.begin(), pieces.end(),
                  [](const Interval& a, const Interval& b) { return a.from < b.from; });
        for (const Interval& piece : pieces)
        {
            const double left = piece.from * bond.unit.x();
            const double right = piece.to * bond.unit.x();
            assembly.blocks.push_back(
                {{{left, bottom}, {right, bottom}, {right, top}, {left, top}}, bond.thickness});
        }
    }
    return assembly;
}

} // namespace drystone
