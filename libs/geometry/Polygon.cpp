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

namespace
{

/// The sharpest corner, which no straight run can pass through.
std::size_t sharpestCorner(const Polygon& polygon)
{
    const std::size_t size = polygon.size();
    std::size_t sharpest = 0;
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
            sharpest = i;
        }
    }
    return sharpest;
}

/// A run of vertices that are on one chord from its first one, the anchor, within a tolerance.
///
/// It may be extended to a vertex as long as one chord passes within the tolerance of every vertex between:
/// seen from the anchor, a vertex at distance d admits directions within asin(tolerance/d) of its own. The
/// interval [low, high] is their intersection (angles from the first edge of the run), so each vertex is
/// visited once.
class StraightRun
{
public:
    StraightRun(const Vector<2>& from, double mostApart) : anchor(from), tolerance(mostApart) {}

    /// Lets the chord pass by the vertex that the run has reached; vertices come in their order.
    void passBy(const Vector<2>& vertex)
    {
        const Vector<2> arm = vertex - anchor;
        const double distance = arm.norm();
        if (reference.isZero())
        {
            reference = arm;
            low = -std::numbers::pi / 2;
            high = std::numbers::pi / 2;
        }
        const double halfWidth = std::asin(std::min(1.0, tolerance / distance));
        low = std::max(low, angleOf(arm) - halfWidth);
        high = std::min(high, angleOf(arm) + halfWidth);
        reached = std::max(reached, distance);
    }

    /// Whether the run may go on to a vertex; not back.
    bool reaches(const Vector<2>& vertex) const
    {
        const Vector<2> arm = vertex - anchor;
        const double angle = angleOf(arm);
        return !(angle < low || angle > high || arm.norm() < reached);
    }

private:
    double angleOf(const Vector<2>& arm) const
    {
        return std::atan2(cross(reference, arm), reference.dot(arm));
    }

    Vector<2> anchor;
    double tolerance;
    Vector<2> reference = Vector<2>::Zero(); ///< the first edge
    double low = 0;
    double high = 0;
    double reached = 0; ///< the largest distance from the anchor
};

} // namespace

Polygon withoutStraightVertices(const Polygon& polygon, double tolerance)
{
    const std::size_t size = polygon.size();
    if (size < 4)
    {
        return polygon;
    }
    const std::size_t start = sharpestCorner(polygon);
    Polygon kept{polygon[start]};
    StraightRun run(polygon[start], tolerance);
    for (std::size_t step = 2; step <= size; ++step)
    {
        const Vector<2>& previous = polygon[(start + step - 1) % size];
        run.passBy(previous);
        if (!run.reaches(polygon[(start + step) % size]))
        {
            kept.push_back(previous);
            run = StraightRun(previous, tolerance);
        }
    }
    return kept.size() >= 3 ? kept : polygon;
}

} // namespace drystone
