// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Area, moments and the straight edges of a simple polygon: properties of the outline alone, whatever block
/// it belongs to.
#include "geometry/Polygon.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace drystone
{

AreaProperties areaProperties(const Polygon& polygon)
{
    AreaProperties properties;
    if (polygon.size() < 3)
    {
        return properties;
    }
    // A fan of triangles (0, a, b) seen from the first vertex. Each has twice the area a x b, its centroid at
    // (a+b)/3 and the polar moment (a.a + a.b + b.b)/12 * (a x b) about the first vertex; Steiner's rule then
    // moves the sum to the centroid.
    const Vector<2> origin = polygon.front();
    Vector<2> firstMoment = Vector<2>::Zero();
    double polarMoment = 0;
    for (std::size_t i = 1; i + 1 < polygon.size(); ++i)
    {
        const Vector<2> a = polygon[i] - origin;
        const Vector<2> b = polygon[i + 1] - origin;
        const double twice = cross(a, b);
        properties.area += twice / 2;
        firstMoment += twice / 6 * (a + b);
        polarMoment += twice / 12 * (a.dot(a) + a.dot(b) + b.dot(b));
    }
    if (properties.area != 0)
    {
        const Vector<2> arm = firstMoment / properties.area;
        properties.centroid = origin + arm;
        properties.polarMoment = polarMoment - properties.area * arm.squaredNorm();
    }
    return properties;
}

Polygon withoutStraightVertices(const Polygon& polygon, double tolerance)
{
    const std::size_t size = polygon.size();
    if (size < 4)
    {
        return polygon;
    }
    // Start at the sharpest corner, which no straight run can pass through.
    std::size_t start = 0;
    double smallestCosine = 2;
    for (std::size_t i = 0; i < size; ++i)
    {
        const Vector<2> before = polygon[i] - polygon[(i + size - 1) % size];
        const Vector<2> after = polygon[(i + 1) % size] - polygon[i];
        const double lengths = before.norm() * after.norm();
        const double cosine = lengths > 0 ? before.dot(after) / lengths : 1;
        if (cosine < smallestCosine)
        {
            smallestCosine = cosine;
            start = i;
        }
    }
    // A run from `anchor` may be extended to a vertex as long as one chord passes within the tolerance of
    // every vertex between: seen from the anchor, a vertex at distance d admits directions within
    // asin(tolerance/d) of its own. The interval [low, high] is their intersection (angles from the first
    // edge of the run), so each vertex is visited once.
    Polygon kept{polygon[start]};
    Vector<2> anchor = polygon[start];
    Vector<2> reference = Vector<2>::Zero();
    double low = 0;
    double high = 0;
    double reached = 0;
    for (std::size_t step = 1; step <= size; ++step)
    {
        const Vector<2>& vertex = polygon[(start + step) % size];
        const Vector<2>& previous = polygon[(start + step - 1) % size];
        const Vector<2> arm = vertex - anchor;
        const double distance = arm.norm();
        if (step > 1)
        {
            const Vector<2> previousArm = previous - anchor;
            const double previousDistance = previousArm.norm();
            if (reference.isZero())
            {
                reference = previousArm;
                low = -std::numbers::pi / 2;
                high = std::numbers::pi / 2;
            }
            const auto angleOf = [&](const Vector<2>& a)
            { return std::atan2(cross(reference, a), reference.dot(a)); };
            const double halfWidth = std::asin(std::min(1.0, tolerance / previousDistance));
            low = std::max(low, angleOf(previousArm) - halfWidth);
            high = std::min(high, angleOf(previousArm) + halfWidth);
            reached = std::max(reached, previousDistance);
            const double angle = angleOf(arm);
            if (angle < low || angle > high || distance < reached)
            {
                kept.push_back(previous);
                anchor = previous;
                reference.setZero();
                reached = 0;
            }
        }
    }
    return kept.size() >= 3 ? kept : polygon;
}

} // namespace drystone
