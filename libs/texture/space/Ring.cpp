// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Makes the blocks of a ring.
#include "texture/space/Ring.h"

#include <cmath>

namespace drystone
{

Vector<2> ringPoint(int sides, double parts, double radius)
{
    // The angle within its quarter, so that points a quarter apart are each other turned, and those on an
    // axis exact.
    const double quarters = 4 * parts / sides;
    const double quarter = std::floor(quarters + 0.5);
    const double angle = (quarters - quarter) * EIGEN_PI / 2;
    const Vector<2> point(radius * std::cos(angle), radius * std::sin(angle));
    switch (static_cast<int>(quarter - 4 * std::floor(quarter / 4)))
    {
    case 0:
        return point;
    case 1:
        return perpendicular(point);
    case 2:
        return -point;
    default:
        return -perpendicular(point);
    }
}

void addRing(std::vector<Block<3>>& blocks, const Ring& ring)
{
    for (int k = 0; k < ring.sides; ++k)
    {
        // The block in plan, counter-clockwise: outwards along its first joint and back along its last.
        Polygon plan;
        const double corner = ring.turn + k;
        if (ring.joints == RingJoints::atCorners)
        {
            plan = {ringPoint(ring.sides, corner, ring.innerRadius),
                    ringPoint(ring.sides, corner, ring.outerRadius),
                    ringPoint(ring.sides, corner + 1, ring.outerRadius),
                    ringPoint(ring.sides, corner + 1, ring.innerRadius)};
        }
        else
        {
            const double apothem = std::cos(EIGEN_PI / ring.sides);
            plan = {ringPoint(ring.sides, corner - 0.5, apothem * ring.innerRadius),
                    ringPoint(ring.sides, corner - 0.5, apothem * ring.outerRadius),
                    ringPoint(ring.sides, corner, ring.outerRadius),
                    ringPoint(ring.sides, corner + 0.5, apothem * ring.outerRadius),
                    ringPoint(ring.sides, corner + 0.5, apothem * ring.innerRadius),
                    ringPoint(ring.sides, corner, ring.innerRadius)};
        }
        std::vector<Vector<3>> bottom;
        std::vector<Vector<3>> top;
        for (const Vector<2>& point : plan)
        {
            bottom.emplace_back(point.x(), point.y(), ring.lower);
            top.emplace_back(point.x(), point.y(), ring.upper);
        }
        blocks.push_back({makePrism(bottom, top)});
    }
}

} // namespace drystone
