// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// In lists of contact points those of one joint follow each other: finds where each joint begins and ends.
#pragma once

#include "contact/ContactPoint.h"

#include <cstddef>
#include <vector>

namespace drystone
{

/// A part of a list of contact points, and of lists of what belongs to each point.
struct PointRange
{
    std::size_t begin = 0; ///< index of the first point
    std::size_t end = 0;   ///< one more than that of the last

    std::size_t size() const { return end - begin; }
};

/// The points of each joint, in the order of the list: together these are all points, and no range is empty.
/// \param points those of one joint follow each other, as findContactPoints and divideJoints give them
template<int Dim>
std::vector<PointRange> pointsOfJoints(const std::vector<ContactPoint<Dim>>& points)
{
    std::vector<PointRange> joints;
    for (std::size_t i = 0; i < points.size(); ++i)
    {
        if (i == 0 || points[i].joint != points[i - 1].joint)
        {
            joints.push_back({i, i});
        }
        joints.back().end = i + 1;
    }
    return joints;
}

} // namespace drystone
