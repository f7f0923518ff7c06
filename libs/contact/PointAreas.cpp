// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Areas of contact points in the plane, and at the corners of patches in space.
#include "contact/PointAreas.h"

#include "contact/PointsOfJoints.h"
#include "geometry/PolygonShape.h"

#include <algorithm>
#include <cmath>

namespace drystone
{

std::vector<double> pointAreas(const Assembly<2>& assembly, const std::vector<ContactPoint<2>>& points)
{
    std::vector<double> areas(points.size(), 0);
    const auto thicknessOf = [&](const ContactPoint<2>& point)
    {
        const Block<2>& block = assembly.blocks[point.block];
        const Block<2>& neighbour = assembly.blocks[point.neighbour];
        if (block.support >= 0)
        {
            return neighbour.thickness;
        }
        return neighbour.support >= 0 ? block.thickness : std::min(block.thickness, neighbour.thickness);
    };
    for (const PointRange& joint : pointsOfJoints(points))
    {
        for (std::size_t i = joint.begin; i + 1 < joint.end; ++i)
        {
            const double half =
                thicknessOf(points[i]) * (points[i + 1].position - points[i].position).norm() / 2;
            areas[i] += half;
            areas[i + 1] += half;
        }
    }
    return areas;
}

namespace
{

/// Adds the areas of the corners of one patch.
void addPatchAreas(const std::vector<ContactPoint<3>>& points, const PointRange& patch,
                   std::vector<double>& areas)
{
    const Eigen::Matrix3d frame = contactFrame(points[patch.begin]);
    std::vector<std::size_t> corners;
    Polygon outline;
    for (std::size_t i = patch.begin; i < patch.end; ++i)
    {
        const Vector<3> arm = points[i].position - points[patch.begin].position;
        outline.emplace_back(frame.col(1).dot(arm), frame.col(2).dot(arm));
        corners.push_back(i);
    }
    if (areaProperties(outline).area < 0)
    {
        std::reverse(outline.begin(), outline.end());
        std::reverse(corners.begin(), corners.end());
    }
    if (isConvex(outline))
    {
        const Vector<2> centroid = areaProperties(outline).centroid;
        for (std::size_t i = 0; i < outline.size(); ++i)
        {
            const std::size_t next = (i + 1) % outline.size();
            const double part = cross(outline[i] - centroid, outline[next] - centroid) / 2;
            areas[corners[i]] += part / 2;
            areas[corners[next]] += part / 2;
        }
        return;
    }
    for (const auto& triangle : triangulate(outline))
    {
        const double part = cross(triangle[1] - triangle[0], triangle[2] - triangle[0]) / 2;
        for (const Vector<2>& corner : triangle)
        {
            const auto at = std::find(outline.begin(), outline.end(), corner) - outline.begin();
            areas[corners[static_cast<std::size_t>(at)]] += part / 3;
        }
    }
}

} // namespace

std::vector<double> pointAreas(const Assembly<3>&, const std::vector<ContactPoint<3>>& points)
{
    std::vector<double> areas(points.size(), 0);
    for (const PointRange& patch : pointsOfJoints(points))
    {
        addPatchAreas(points, patch, areas);
    }
    return areas;
}

} // namespace drystone
