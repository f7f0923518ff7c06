// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The shape of a block of the plane: its outline.
#include "assembly/BlockShape.h"

#include "geometry/BroadPhase.h"
#include "geometry/PolygonShape.h"

#include <algorithm>
#include <cmath>

namespace drystone
{

template<>
Box<2> boundingBox(const Block<2>& block)
{
    return boundingBox(block.outline);
}

double distanceFrom(const Block<2>& block, const Vector<2>& point)
{
    return std::max(0.0, signedDistance(block.outline, point));
}

std::vector<double> placesToCut(const Block<2>& block, const Vector<2>& from, const Vector<2>& along)
{
    // At the edges, and near the corners.
    std::vector<double> places;
    const double length = along.norm();
    for (std::size_t i = 0; i < block.outline.size(); ++i)
    {
        const Vector<2> corner = block.outline[i] - from;
        const Vector<2> edge = block.outline[(i + 1) % block.outline.size()] - block.outline[i];
        places.push_back(corner.dot(along) / (length * length));
        if (const double sine = cross(along, edge); std::abs(sine) > 1e-12 * length * edge.norm())
        {
            places.push_back(cross(corner, edge) / sine);
        }
    }
    return places;
}

} // namespace drystone
