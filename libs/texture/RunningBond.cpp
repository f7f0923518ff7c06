// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Generator of running bonds.
#include "texture/RunningBond.h"

#include <algorithm>

namespace drystone
{

namespace
{

struct Interval
{
    double from;
    double to;
};

/// What is left of `piece` beside the interval `hole`.
void subtract(std::vector<Interval>& pieces, const Interval& hole)
{
    std::vector<Interval> left;
    for (const Interval& piece : pieces)
    {
        if (hole.to <= piece.from || hole.from >= piece.to)
        {
            left.push_back(piece);
            continue;
        }
        if (hole.from > piece.from)
        {
            left.push_back({piece.from, hole.from});
        }
        if (hole.to < piece.to)
        {
            left.push_back({hole.to, piece.to});
        }
    }
    pieces = std::move(left);
}

} // namespace

Assembly<2> makeAssembly(const RunningBond& bond)
{
    Assembly<2> assembly;
    assembly.blocks.reserve(static_cast<std::size_t>((bond.length + 1) * bond.courses));
    for (int course = 0; course < bond.courses; ++course)
    {
        const bool startsHalf = (course % 2 == 0) == (bond.firstCourse == FirstCourse::half);
        const double bottom = course * bond.unit.y();
        const double top = (course + 1) * bond.unit.y();
        std::vector<Interval> holes;
        for (const Opening& opening : bond.openings)
        {
            if (course >= opening.from.y() && course < opening.to.y())
            {
                holes.push_back({opening.from.x(), opening.to.x()});
            }
        }
        // Joints stand at k + 1/2 or k units: exact in binary, so courses two apart have the very same
        // corners.
        double from = 0;
        for (int k = 0; from < bond.length; ++k)
        {
            const double to = std::min(bond.length, startsHalf ? k + 0.5 : k + 1.0);
            std::vector<Interval> pieces{{from, to}};
            for (const Interval& hole : holes)
            {
                subtract(pieces, hole);
            }
            for (const Interval& piece : pieces)
            {
                const double left = piece.from * bond.unit.x();
                const double right = piece.to * bond.unit.x();
                assembly.blocks.push_back(
                    {{{left, bottom}, {right, bottom}, {right, top}, {left, top}}, bond.thickness});
            }
            from = to;
        }
    }
    return assembly;
}

} // namespace drystone
