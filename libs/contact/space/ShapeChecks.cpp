// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Figures of polyhedra.
#include "contact/ShapeChecks.h"

#include "contact/SupportPaths.h"
#include "geometry/space/FacePolygon.h"
#include "geometry/space/PolyhedronOverlap.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
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
    const double ofBall = 1.2 / std::pow(4 * EIGEN_PI / 3, 2.0 / 3);
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
    return {(volumeProperties(one.shape).centroid + volumeProperties(other.shape).centroid) / 2};
}

namespace
{

/// Distance of a point to the nearest edge [m].
double distanceToEdges(const Polyhedron& shape, const Vector<3>& point)
{
    double least = std::numeric_limits<double>::infinity();
    for (const std::vector<int>& face : shape.faces)
    {
        for (std::size_t i = 0; i < face.size(); ++i)
        {
            const Vector<3>& start = shape.vertices[face[i]];
            const Vector<3> edge = shape.vertices[face[(i + 1) % face.size()]] - start;
            const double along = std::clamp((point - start).dot(edge) / edge.squaredNorm(), 0.0, 1.0);
            least = std::min(least, (start + along * edge - point).norm());
        }
    }
    return least;
}

} // namespace

bool meetAtEdges(const Block<3>& one, const Block<3>& other, double tolerance)
{
    bool touches = false;
    for (const auto& [block, neighbour] : {std::pair(&one, &other), std::pair(&other, &one)})
    {
        for (const Vector<3>& corner : block->shape.vertices)
        {
            if (distance(neighbour->shape, corner) <= tolerance)
            {
                touches = true;
                if (distanceToEdges(neighbour->shape, corner) > tolerance)
                {
                    return false;
                }
            }
        }
    }
    // Edges that lie along each other have an end of one on the other; without one they cross, as in no bond.
    return touches;
}

} // namespace drystone
