// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// What the checks ask of outlines: sizes, inertia, and where they touch without a joint.
#include "contact/ShapeChecks.h"

#include "assembly/BlockShape.h"
#include "contact/Penetration.h"
#include "geometry/PolygonShape.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

namespace drystone
{

double extentOf(const Block<2>& block)
{
    return areaProperties(block.outline).area;
}

double commonExtent(const Block<2>& one, const Block<2>& other, double)
{
    return overlapArea(one.outline, other.outline);
}

double commonDepth(const Block<2>& one, const Block<2>& other)
{
    return overlapDepth(one.outline, other.outline);
}

bool isConvexBlock(const Block<2>& block)
{
    return isConvex(block.outline);
}

std::string inertiaFault(const Block<2>& block, const CheckLimits& limits, CheckedRange& range)
{
    const AreaProperties area = areaProperties(block.outline);
    const double gyration = area.polarMoment / (area.area * area.area);
    range.add(gyration);
    // No shape has less than the circle's 1/(2 pi).
    const bool isSound = gyration >= 0.5 / std::numbers::pi * (1 - 1e-6) && gyration <= limits.gyration;
    return isSound ? std::string()
                   : fmt::format("has the polar moment {:.6g} m4 on an area of {:.6g} m2", area.polarMoment,
                                 area.area);
}

template<>
std::string inertiaMessage<2>(const CheckedRange& range)
{
    return range.isEmpty() ? "Polar moment: no free blocks"
                           : fmt::format("Polar moment relative to area squared: min = {:.6g} max = {:.6g}",
                                         range.least, range.largest);
}

std::string sliverFault(const Block<2>& block, const CheckLimits& limits, SliverRanges& ranges)
{
    const Polygon& outline = block.outline;
    const ShapeQuality quality = shapeQuality(outline);
    ranges.compactness.add(quality.compactness);
    ranges.angle.add(quality.smallestAngle);
    double shortest = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < outline.size(); ++k)
    {
        shortest = std::min(shortest, (outline[(k + 1) % outline.size()] - outline[k]).norm());
    }
    if (quality.compactness < limits.compactness)
    {
        return fmt::format("is a sliver: 4 pi area/perimeter2 = {:.3g}", quality.compactness);
    }
    if (quality.smallestAngle < limits.angle)
    {
        return fmt::format("has a corner of {:.3g} rad", quality.smallestAngle);
    }
    if (shortest < limits.edge * std::sqrt(areaProperties(outline).area))
    {
        return fmt::format("has an edge of {:.3g} m", shortest);
    }
    return {};
}

template<>
std::string sliverMessage<2>(const SliverRanges& ranges)
{
    return ranges.angle.isEmpty()
               ? "Slivers: no free blocks"
               : fmt::format("Min compactness = {:.3g}. Sharpest corner = {:.4g} degrees",
                             ranges.compactness.least, ranges.angle.least * 180 / std::numbers::pi);
}

double jointSize(std::span<const ContactPoint<2>> points)
{
    return (points.back().position - points.front().position).norm();
}

std::vector<Vector<2>> loneTouches(const Block<2>& one, const Block<2>& other, double tolerance)
{
    std::vector<Vector<2>> places;
    const Box<2> reach = enlarged<2>(boundingBox(other), tolerance);
    const Polygon& outline = other.outline;
    for (const Vector<2>& corner : one.outline)
    {
        const auto isHere = [&](const Vector<2>& vertex) { return (vertex - corner).norm() <= tolerance; };
        if (contains<2>(reach, {corner, corner}) && std::none_of(outline.begin(), outline.end(), isHere)
            && std::abs(signedDistance(outline, corner)) <= tolerance)
        {
            places.push_back(corner);
        }
    }
    return places;
}

std::vector<Vector<2>> commonCorners(const Block<2>& one, const Block<2>& other, double tolerance)
{
    std::vector<Vector<2>> places;
    for (const Vector<2>& corner : one.outline)
    {
        if (std::any_of(other.outline.begin(), other.outline.end(),
                        [&](const Vector<2>& vertex) { return (vertex - corner).norm() <= tolerance; }))
        {
            places.push_back(corner);
        }
    }
    return places;
}

bool meetAtEdges(const Block<2>&, const Block<2>&, double)
{
    return false;
}

} // namespace drystone
