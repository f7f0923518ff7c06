// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Contact points at the corners of the patches where faces lie on each other, or in a grid over these.
#include "contact/ContactPoint.h"

#include "contact/space/FacingPatches.h"
#include "geometry/Box.h"
#include "geometry/PolygonShape.h"

#include <algorithm>

namespace drystone
{

template<>
std::vector<ContactPoint<3>> findContactPoints(const Assembly<3>& assembly, double relativeTolerance)
{
    const double distance = relativeTolerance * meanBlockSize(assembly);
    const std::vector<FacingPatch> joints = findFacingPatches(assembly, facingTolerance(distance, distance));

    std::vector<ContactPoint<3>> points;
    points.reserve(4 * joints.size());
    for (std::size_t i = 0; i < joints.size(); ++i)
    {
        const FacingPatch& joint = joints[i];
        for (const Vector<3>& corner : joint.corners)
        {
            // A joint is closed as built: what the tolerance let through is not a gap.
            points.push_back({joint.block, joint.neighbour, static_cast<int>(i), corner, joint.normal, 0,
                              ContactFeature{}});
        }
    }
    return points;
}

namespace
{

/// The grid points of a patch that are not corners of it.
std::vector<Vector<2>> gridWithin(const Polygon& patch, int perSide)
{
    // The rectangle along the longest edge.
    Vector<2> along(1, 0);
    double longest = 0;
    for (std::size_t i = 0; i < patch.size(); ++i)
    {
        const Vector<2> edge = patch[(i + 1) % patch.size()] - patch[i];
        // Of edges that are equally long the first counts, whatever rounding says.
        if (edge.norm() > longest * (1 + 1e-9))
        {
            longest = edge.norm();
            along = edge / longest;
        }
    }
    const Vector<2> across = perpendicular(along);
    BoundingBox box;
    for (const Vector<2>& corner : patch)
    {
        extend<2>(box, {along.dot(corner), across.dot(corner)});
    }
    const Vector<2> size = box.upper - box.lower;
    const double rounding = 1e-9 * size.maxCoeff();
    std::vector<Vector<2>> points;
    for (int i = 0; i < perSide; ++i)
    {
        for (int j = 0; j < perSide; ++j)
        {
            const double u = box.lower.x() + size.x() * i / (perSide - 1);
            const double v = box.lower.y() + size.y() * j / (perSide - 1);
            const Vector<2> point = u * along + v * across;
            const bool isCorner =
                std::any_of(patch.begin(), patch.end(),
                            [&](const Vector<2>& corner) { return (corner - point).norm() <= rounding; });
            if (!isCorner && signedDistance(patch, point) <= rounding)
            {
                points.push_back(point);
            }
        }
    }
    return points;
}

} // namespace

std::vector<ContactPoint<3>> divideJoints(const std::vector<ContactPoint<3>>& corners, int perSide)
{
    std::vector<ContactPoint<3>> points;
    for (auto first = corners.begin(); first != corners.end();)
    {
        const auto last = std::find_if(
            first, corners.end(), [&](const ContactPoint<3>& point) { return point.joint != first->joint; });
        points.insert(points.end(), first, last);
        const Eigen::Matrix3d frame = contactFrame(*first);
        Polygon patch;
        for (auto corner = first; corner != last; ++corner)
        {
            const Vector<3> arm = corner->position - first->position;
            patch.emplace_back(frame.col(1).dot(arm), frame.col(2).dot(arm));
        }
        if (areaProperties(patch).area < 0)
        {
            std::reverse(patch.begin(), patch.end());
        }
        for (const Vector<2>& place : gridWithin(patch, perSide))
        {
            ContactPoint<3> point = *first;
            point.position += place.x() * frame.col(1) + place.y() * frame.col(2);
            points.push_back(point);
        }
        first = last;
    }
    return points;
}

} // namespace drystone
