// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// What the checks ask of polyhedra: sizes, inertia, and where they touch without a joint.
#include "contact/ShapeChecks.h"

#include "contact/SupportPaths.h"
#include "geometry/space/EdgeLine.h"
#include "geometry/space/FacePolygon.h"
#include "geometry/space/PolyhedronOverlap.h"

#include <Eigen/Geometry>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>

namespace drystone
{

double extentOf(const Block<3>& block)
{
    return volumeProperties(block.shape).volume;
}

double commonExtent(const Block<3>& one, const Block<3>& other, double tolerance)
{
    // Blocks that touch are most of the pairs, and the axis that parts them is found at once.
    const bool isConvexPair = isConvex(one.shape) && isConvex(other.shape);
    return isConvexPair && overlapDepth(one.shape, other.shape) <= tolerance
               ? 0
               : overlapVolume(one.shape, other.shape);
}

double commonDepth(const Block<3>& one, const Block<3>& other)
{
    return overlapDepth(one.shape, other.shape);
}

bool isConvexBlock(const Block<3>& block)
{
    return isConvex(block.shape);
}

std::string inertiaFault(const Block<3>& block, const CheckLimits& limits, CheckedRange& range)
{
    const VolumeProperties volume = volumeProperties(block.shape);
    const double gyration = volume.inertia.trace() / std::pow(volume.volume, 5.0 / 3);
    range.add(gyration);
    // No shape has less than the ball's 6/5 r^2 V / V^(5/3).
    const double ofBall = 1.2 / std::pow(4 * std::numbers::pi / 3, 2.0 / 3);
    const bool isSound = gyration >= ofBall * (1 - 1e-6) && gyration <= limits.gyration;
    return isSound ? std::string()
                   : fmt::format("has the sum of moments of inertia {:.6g} m5 in a volume of {:.6g} m3",
                                 volume.inertia.trace(), volume.volume);
}

template<>
std::string inertiaMessage<3>(const CheckedRange& range)
{
    return range.isEmpty()
               ? "Inertia: no free blocks"
               : fmt::format("Sum of moments of inertia relative to volume^(5/3): min = {:.6g} max = {:.6g}",
                             range.least, range.largest);
}

std::string sliverFault(const Block<3>& block, const CheckLimits& limits, SliverRanges& ranges)
{
    const SolidQuality quality = solidQuality(block.shape);
    ranges.compactness.add(quality.compactness);
    if (quality.compactness < limits.compactness)
    {
        return fmt::format("is a sliver: 36 pi volume2/surface3 = {:.3g}", quality.compactness);
    }
    if (quality.shortestEdge < limits.edge * std::cbrt(extentOf(block)))
    {
        return fmt::format("has an edge of {:.3g} m", quality.shortestEdge);
    }
    return {};
}

template<>
std::string sliverMessage<3>(const SliverRanges& ranges)
{
    return ranges.compactness.isEmpty() ? "Slivers: no free blocks"
                                        : fmt::format("Min compactness = {:.3g}", ranges.compactness.least);
}

double jointSize(std::span<const ContactPoint<3>> points)
{
    Vector<3> twice = Vector<3>::Zero();
    for (std::size_t i = 1; i + 1 < points.size(); ++i)
    {
        twice += momentOf(Vector<3>(points[i].position - points[0].position),
                          Vector<3>(points[i + 1].position - points[0].position));
    }
    return twice.norm() / 2;
}

namespace
{

/// Where edges of two blocks that touch cross: the middle between the nearest of them; nothing where none do.
std::optional<Vector<3>> crossingOfEdges(const Polyhedron& one, const Polyhedron& other)
{
    std::optional<Vector<3>> place;
    double least = std::numeric_limits<double>::infinity();
    const std::vector<EdgeLine> edges = edgesOf(other);
    for (const EdgeLine& edge : edgesOf(one))
    {
        for (const EdgeLine& crossing : edges)
        {
            const std::optional<double> part = nearestToLine(edge, crossing);
            if (!part)
            {
                continue;
            }
            const double ofCrossing = crossing.nearest(edge.at(*part));
            const Vector<3> apart = crossing.at(ofCrossing) - edge.at(*part);
            if (*part >= 0 && *part <= 1 && ofCrossing >= 0 && ofCrossing <= 1 && apart.norm() < least)
            {
                least = apart.norm();
                place = edge.at(*part) + apart / 2;
            }
        }
    }
    return place;
}

} // namespace

std::vector<Vector<3>> loneTouches(const Block<3>& one, const Block<3>& other, double tolerance)
{
    const auto isOn = [tolerance](const Block<3>& block)
    {
        return [&block, tolerance](const Vector<3>& corner)
        { return distance(block.shape, corner) <= tolerance; };
    };
    const auto corner = std::find_if(one.shape.vertices.begin(), one.shape.vertices.end(), isOn(other));
    if (corner != one.shape.vertices.end())
    {
        return {*corner};
    }
    const bool isByCorner = std::any_of(other.shape.vertices.begin(), other.shape.vertices.end(), isOn(one));
    if (isByCorner || !touch(one, other, tolerance))
    {
        return {};
    }
    return {
        crossingOfEdges(one.shape, other.shape)
            .value_or((volumeProperties(one.shape).centroid + volumeProperties(other.shape).centroid) / 2)};
}

namespace
{

bool isOnEdge(const std::vector<EdgeLine>& edges, const Vector<3>& point, double tolerance)
{
    return std::any_of(
        edges.begin(), edges.end(),
        [&](const EdgeLine& edge)
        { return (edge.at(std::clamp(edge.nearest(point), 0.0, 1.0)) - point).norm() <= tolerance; });
}

/// Where along an edge of one block it meets edges and corners of another, from 0 to 1, its ends included.
std::vector<double> meetingsAlong(const EdgeLine& edge, const Polyhedron& other,
                                  const std::vector<EdgeLine>& edges, double tolerance)
{
    std::vector<double> parts{0, 1};
    for (const Vector<3>& corner : other.vertices)
    {
        parts.push_back(edge.nearest(corner));
    }
    for (const EdgeLine& crossing : edges)
    {
        if (const std::optional<double> part = nearestToLine(edge, crossing))
        {
            parts.push_back(*part);
        }
    }
    std::erase_if(parts, [&](double part)
                  { return part < 0 || part > 1 || distance(other, edge.at(part)) > tolerance; });
    std::sort(parts.begin(), parts.end());
    return parts;
}

/// Whether a corner or a part of an edge of one block lies within a face of another.
bool liesInFace(const Polyhedron& one, const Polyhedron& other, double tolerance)
{
    const std::vector<EdgeLine> edges = edgesOf(other);
    const auto isInFace = [&](const Vector<3>& point)
    { return distance(other, point) <= tolerance && !isOnEdge(edges, point, tolerance); };
    if (std::any_of(one.vertices.begin(), one.vertices.end(), isInFace))
    {
        return true;
    }
    for (const EdgeLine& edge : edgesOf(one))
    {
        // Between two meetings an edge is in one face, on one edge or off the block.
        const std::vector<double> parts = meetingsAlong(edge, other, edges, tolerance);
        for (std::size_t i = 1; i < parts.size(); ++i)
        {
            if (isInFace(edge.at((parts[i - 1] + parts[i]) / 2)))
            {
                return true;
            }
        }
    }
    return false;
}

} // namespace

std::vector<Vector<3>> commonCorners(const Block<3>&, const Block<3>&, double)
{
    return {};
}

bool meetAtEdges(const Block<3>& one, const Block<3>& other, double tolerance)
{
    // Edges that lie along each other have an end of one on the other; without one they cross, as in no bond.
    const auto touches = [tolerance](const Polyhedron& shape, const Polyhedron& neighbour)
    {
        return std::any_of(shape.vertices.begin(), shape.vertices.end(),
                           [&](const Vector<3>& corner) { return distance(neighbour, corner) <= tolerance; });
    };
    return (touches(one.shape, other.shape) || touches(other.shape, one.shape))
           && !liesInFace(one.shape, other.shape, tolerance)
           && !liesInFace(other.shape, one.shape, tolerance);
}

} // namespace drystone
