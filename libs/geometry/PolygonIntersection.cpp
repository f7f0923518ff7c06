// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Clipping of polygons: by half planes where both are convex, else by Clipper (A. Johnson, after Vatti
/// 1992).
#include "geometry/PolygonIntersection.h"

#include "geometry/BroadPhase.h"
#include "geometry/PolygonShape.h"
#include "geometry/Turn.h"

#include <polyclipping/clipper.hpp>

#include <algorithm>
#include <cmath>

namespace drystone
{

namespace
{

/// The part of a convex polygon on the left of the line through `from` and `to`.
void clip(Polygon& polygon, const Vector<2>& from, const Vector<2>& to, Polygon& scratch)
{
    scratch.clear();
    const std::size_t size = polygon.size();
    for (std::size_t i = 0; i < size; ++i)
    {
        const Vector<2>& a = polygon[i];
        const Vector<2>& b = polygon[(i + 1) % size];
        const double sideA = turn(from, to, a);
        const double sideB = turn(from, to, b);
        if (sideA >= 0)
        {
            scratch.push_back(a);
        }
        if ((sideA > 0 && sideB < 0) || (sideA < 0 && sideB > 0))
        {
            scratch.push_back(a + sideA / (sideA - sideB) * (b - a));
        }
    }
    std::swap(polygon, scratch);
}

/// Clipper computes in integers: the polygons' common frame, with 2^40 steps across it.
struct Grid
{
    Vector<2> origin = Vector<2>::Zero();
    double steps = 1; ///< [1/m]
};

Grid gridOver(const Polygon& a, const Polygon& b)
{
    BoundingBox box = boundingBox(a);
    extend<2>(box, boundingBox(b));
    // A power of two keeps the digits of the coordinates.
    const double extent = (box.upper - box.lower).maxCoeff();
    return {box.lower, extent > 0 ? std::exp2(40 - std::ceil(std::log2(extent))) : 1};
}

ClipperLib::Path pathOf(const Polygon& polygon, const Grid& grid)
{
    ClipperLib::Path path;
    path.reserve(polygon.size());
    for (const Vector<2>& corner : polygon)
    {
        const Vector<2> scaled = grid.steps * (corner - grid.origin);
        path.emplace_back(std::llround(scaled.x()), std::llround(scaled.y()));
    }
    return path;
}

/// `polygon` with the corners of `other` that lie within the tolerance of its outline: corners that nearly
/// coincide are moved there, edges are led through the others. Edges that nearly lie on each other then have
/// the same ends, and leave no slivers between them.
Polygon snapped(const Polygon& polygon, const Polygon& other, double tolerance)
{
    Polygon corners;
    for (const Vector<2>& corner : polygon)
    {
        const auto same = std::find_if(other.begin(), other.end(),
                                       [&](const Vector<2>& candidate)
                                       { return (candidate - corner).norm() <= tolerance; });
        corners.push_back(same != other.end() ? *same : corner);
    }
    Polygon result;
    for (std::size_t i = 0; i < corners.size(); ++i)
    {
        const Vector<2>& from = corners[i];
        const Vector<2>& to = corners[(i + 1) % corners.size()];
        result.push_back(from);
        Polygon between;
        for (const Vector<2>& candidate : other)
        {
            if (candidate != from && candidate != to && distance(candidate, from, to) <= tolerance)
            {
                between.push_back(candidate);
            }
        }
        std::sort(between.begin(), between.end(),
                  [&](const Vector<2>& one, const Vector<2>& two)
                  { return (one - from).dot(to - from) < (two - from).dot(to - from); });
        result.insert(result.end(), between.begin(), between.end());
    }
    return result;
}

std::vector<Polygon> generalIntersection(const Polygon& a, const Polygon& b)
{
    const Grid grid = gridOver(a, b);
    ClipperLib::Clipper clipper;
    clipper.StrictlySimple(true);
    clipper.AddPath(pathOf(a, grid), ClipperLib::ptSubject, true);
    clipper.AddPath(pathOf(b, grid), ClipperLib::ptClip, true);
    ClipperLib::Paths paths;
    clipper.Execute(ClipperLib::ctIntersection, paths, ClipperLib::pftNonZero, ClipperLib::pftNonZero);
    std::vector<Polygon> parts;
    for (const ClipperLib::Path& path : paths)
    {
        Polygon part;
        part.reserve(path.size());
        for (const ClipperLib::IntPoint& point : path)
        {
            const Vector<2> scaled(static_cast<double>(point.X), static_cast<double>(point.Y));
            part.emplace_back(grid.origin + scaled / grid.steps);
        }
        parts.push_back(std::move(part));
    }
    return parts;
}

void removeRepeatedCorners(Polygon& polygon, double tolerance)
{
    Polygon kept;
    for (const Vector<2>& corner : polygon)
    {
        if (kept.empty() || (corner - kept.back()).norm() > tolerance)
        {
            kept.push_back(corner);
        }
    }
    while (kept.size() > 1 && (kept.front() - kept.back()).norm() <= tolerance)
    {
        kept.pop_back();
    }
    polygon = std::move(kept);
}

/// The pieces of a polygon on either side of its necks, where a corner comes within the tolerance of an edge
/// that is not its own: what is joined by less than the tolerance is not joined, and a tongue this thin is a
/// piece without area.
void splitAtNecks(Polygon polygon, double tolerance, std::vector<Polygon>& pieces)
{
    removeRepeatedCorners(polygon, tolerance);
    const std::size_t size = polygon.size();
    if (size < 3)
    {
        return;
    }
    for (std::size_t i = 0; i < size; ++i)
    {
        for (std::size_t step = 1; step + 1 < size; ++step)
        {
            const std::size_t j = (i + step) % size;
            if (distance(polygon[i], polygon[j], polygon[(j + 1) % size]) > tolerance)
            {
                continue;
            }
            Polygon first;  // from the corner on to the edge
            Polygon second; // from the edge on to the corner
            for (std::size_t k = 0; k <= size; ++k)
            {
                (k <= step ? first : second).push_back(polygon[(i + k) % size]);
            }
            splitAtNecks(std::move(first), tolerance, pieces);
            splitAtNecks(std::move(second), tolerance, pieces);
            return;
        }
    }
    pieces.push_back(std::move(polygon));
}

} // namespace

Polygon convexIntersection(Polygon a, const Polygon& b)
{
    Polygon scratch;
    for (std::size_t i = 0; i < b.size() && a.size() >= 3; ++i)
    {
        clip(a, b[i], b[(i + 1) % b.size()], scratch);
    }
    return a;
}

std::vector<Polygon> intersection(const Polygon& a, const Polygon& b, double tolerance)
{
    // A corner that only splits a straight edge may be concave by rounding.
    const Polygon cleanA = withoutStraightVertices(a, tolerance / 4);
    const Polygon cleanB = withoutStraightVertices(b, tolerance / 4);
    std::vector<Polygon> parts;
    if (isConvex(cleanA) && isConvex(cleanB))
    {
        splitAtNecks(convexIntersection(cleanA, cleanB), tolerance, parts);
    }
    else
    {
        const Polygon snappedB = snapped(cleanB, cleanA, tolerance);
        for (Polygon& part : generalIntersection(snapped(cleanA, snappedB, tolerance), snappedB))
        {
            splitAtNecks(std::move(part), tolerance, parts);
        }
    }
    std::vector<Polygon> wide;
    for (Polygon& part : parts)
    {
        part = withoutStraightVertices(part, tolerance / 2);
        double perimeter = 0;
        for (std::size_t i = 0; i < part.size(); ++i)
        {
            perimeter += (part[(i + 1) % part.size()] - part[i]).norm();
        }
        // Twice the area over the perimeter: the width of a strip, half that of a square.
        if (2 * areaProperties(part).area > tolerance * perimeter)
        {
            wide.push_back(std::move(part));
        }
    }
    return wide;
}

} // namespace drystone
