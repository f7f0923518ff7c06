// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Shape of polygons: self-intersection, triangulation, overlaps, distances, without reference to blocks or
/// materials.
#include "geometry/PolygonShape.h"

#include "geometry/Turn.h"

#include "geometry/BroadPhase.h"
#include "geometry/PolygonIntersection.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

namespace drystone
{

namespace
{

bool isInTriangle(const Vector<2>& point, const Vector<2>& a, const Vector<2>& b, const Vector<2>& c)
{
    return turn(a, b, point) >= 0 && turn(b, c, point) >= 0 && turn(c, a, point) >= 0;
}

double convexOverlapArea(const Polygon& a, const Polygon& b)
{
    return std::max(0.0, areaProperties(convexIntersection(a, b)).area);
}

bool foldBack(const Vector<2>& before, const Vector<2>& corner, const Vector<2>& after, double tolerance)
{
    if ((corner - before).dot(after - corner) >= 0)
    {
        return false;
    }
    // The shorter of the two edges lies within the tolerance of the other.
    const bool firstIsShorter = (corner - before).squaredNorm() < (after - corner).squaredNorm();
    return firstIsShorter ? distance(before, corner, after) <= tolerance
                          : distance(after, before, corner) <= tolerance;
}

} // namespace

double distance(const Vector<2>& point, const Vector<2>& from, const Vector<2>& to)
{
    const Vector<2> edge = to - from;
    const double squared = edge.squaredNorm();
    const double s = squared > 0 ? std::clamp(edge.dot(point - from) / squared, 0.0, 1.0) : 0;
    return (from + s * edge - point).norm();
}

double distance(const Vector<2>& from1, const Vector<2>& to1, const Vector<2>& from2, const Vector<2>& to2)
{
    const bool cross1 = (turn(from1, to1, from2) > 0) != (turn(from1, to1, to2) > 0);
    const bool cross2 = (turn(from2, to2, from1) > 0) != (turn(from2, to2, to1) > 0);
    const bool parallel = cross(to1 - from1, to2 - from2) == 0;
    if (cross1 && cross2 && !parallel)
    {
        return 0;
    }
    return std::min({distance(from1, from2, to2), distance(to1, from2, to2), distance(from2, from1, to1),
                     distance(to2, from1, to1)});
}

std::optional<std::pair<int, int>> findSelfIntersection(const Polygon& polygon, double tolerance)
{
    const int size = static_cast<int>(polygon.size());
    const auto at = [&](int i) -> const Vector<2>& { return polygon[i % size]; };
    const auto meetBadly = [&](int i, int j) // i < j
    {
        if (j == i + 1)
        {
            return foldBack(at(i), at(j), at(j + 1), tolerance);
        }
        if (i == 0 && j == size - 1)
        {
            return foldBack(at(j), at(0), at(1), tolerance);
        }
        return distance(at(i), at(i + 1), at(j), at(j + 1)) <= tolerance;
    };
    if (size <= 16)
    {
        for (int i = 0; i < size; ++i)
        {
            for (int j = i + 1; j < size; ++j)
            {
                if (meetBadly(i, j))
                {
                    return std::pair(i, j);
                }
            }
        }
        return std::nullopt;
    }
    std::vector<BoundingBox> boxes;
    boxes.reserve(polygon.size());
    for (int i = 0; i < size; ++i)
    {
        boxes.push_back(enlarged<2>(boxAround<2>(at(i), at(i + 1)), tolerance));
    }
    for (const auto& [i, j] : findMeetingPairs(boxes))
    {
        if (meetBadly(i, j))
        {
            return std::pair(i, j);
        }
    }
    return std::nullopt;
}

std::string outlineFault(const Polygon& polygon)
{
    const std::size_t size = polygon.size();
    if (size < 3)
    {
        return "has " + std::to_string(size) + " corners, and needs at least 3";
    }
    for (std::size_t i = 0; i < size; ++i)
    {
        if (!polygon[i].allFinite())
        {
            return "has a coordinate that is not finite, at corner " + std::to_string(i);
        }
    }
    const BoundingBox box = boundingBox(polygon);
    const double extent = (box.upper - box.lower).norm();
    const double tolerance = 1e-10 * extent;
    for (std::size_t i = 0; i < size; ++i)
    {
        if ((polygon[(i + 1) % size] - polygon[i]).norm() <= tolerance)
        {
            return "has corners " + std::to_string(i) + " and " + std::to_string((i + 1) % size)
                   + " in the same place";
        }
    }
    // Flat means of area 0; a bow tie has none either, and needs another message.
    const Vector<2> origin = polygon.front();
    const Vector<2> farthest = *std::max_element(polygon.begin(), polygon.end(),
                                                 [&](const Vector<2>& a, const Vector<2>& b)
                                                 { return (a - origin).norm() < (b - origin).norm(); });
    const auto isOnTheLine = [&](const Vector<2>& vertex)
    { return std::abs(turn(origin, farthest, vertex)) <= tolerance * (farthest - origin).norm(); };
    if (std::all_of(polygon.begin(), polygon.end(), isOnTheLine))
    {
        return "has no area";
    }
    if (const auto edges = findSelfIntersection(polygon, tolerance))
    {
        const auto name = [size](int edge)
        { return "from corner " + std::to_string(edge) + " to " + std::to_string((edge + 1) % int(size)); };
        return "crosses or touches itself: the edge " + name(edges->first) + " meets the one "
               + name(edges->second);
    }
    return {};
}

bool isConvex(const Polygon& polygon)
{
    const std::size_t size = polygon.size();
    for (std::size_t i = 0; i < size; ++i)
    {
        if (turn(polygon[i], polygon[(i + 1) % size], polygon[(i + 2) % size]) < 0)
        {
            return false;
        }
    }
    return true;
}

std::vector<std::array<int, 3>> triangleCorners(const Polygon& polygon)
{
    std::vector<std::array<int, 3>> triangles;
    std::vector<int> left(polygon.size());
    std::iota(left.begin(), left.end(), 0);
    const auto cornerAt = [&](std::size_t i) -> const Vector<2>& { return polygon[left[i % left.size()]]; };
    std::size_t start = 0;
    while (left.size() > 3)
    {
        const std::size_t size = left.size();
        std::size_t ear = size;
        std::size_t bluntest = 0; // used when rounding hides every ear
        double largestTurn = -std::numeric_limits<double>::infinity();
        for (std::size_t step = 0; step < size && ear == size; ++step)
        {
            const std::size_t i = (start + step) % size;
            const Vector<2>& a = cornerAt(i + size - 1);
            const Vector<2>& b = cornerAt(i);
            const Vector<2>& c = cornerAt(i + 1);
            const double area = turn(a, b, c);
            if (area > largestTurn)
            {
                largestTurn = area;
                bluntest = i;
            }
            // An ear turns left and holds no other corner. Corners that coincide with one of its own do not
            // count: outlines may touch themselves once ears are gone.
            const auto isInside = [&](int corner)
            {
                const Vector<2>& p = polygon[corner];
                return p != a && p != b && p != c && isInTriangle(p, a, b, c);
            };
            if (area > 0 && std::none_of(left.begin(), left.end(), isInside))
            {
                ear = i;
            }
        }
        if (ear == size)
        {
            ear = bluntest;
        }
        triangles.push_back({left[(ear + size - 1) % size], left[ear], left[(ear + 1) % size]});
        left.erase(left.begin() + static_cast<std::ptrdiff_t>(ear));
        start = ear % left.size();
    }
    if (left.size() == 3)
    {
        triangles.push_back({left[0], left[1], left[2]});
    }
    return triangles;
}

std::vector<std::array<Vector<2>, 3>> triangulate(const Polygon& polygon)
{
    std::vector<std::array<Vector<2>, 3>> triangles;
    for (const auto& [a, b, c] : triangleCorners(polygon))
    {
        triangles.push_back({polygon[a], polygon[b], polygon[c]});
    }
    return triangles;
}

std::vector<Polygon> convexParts(const Polygon& polygon)
{
    if (isConvex(polygon))
    {
        return {polygon};
    }
    std::vector<Polygon> parts;
    for (const auto& [a, b, c] : triangulate(polygon))
    {
        parts.push_back({a, b, c});
    }
    return parts;
}

double overlapArea(const Polygon& a, const Polygon& b)
{
    if (!meet(boundingBox(a), boundingBox(b)))
    {
        return 0;
    }
    double area = 0;
    const std::vector<Polygon> partsOfB = convexParts(b);
    for (const Polygon& partOfA : convexParts(a))
    {
        for (const Polygon& partOfB : partsOfB)
        {
            if (meet(boundingBox(partOfA), boundingBox(partOfB)))
            {
                area += convexOverlapArea(partOfA, partOfB);
            }
        }
    }
    return area;
}

double signedDistance(const Polygon& polygon, const Vector<2>& point)
{
    double nearest = std::numeric_limits<double>::infinity();
    bool inside = false;
    const std::size_t size = polygon.size();
    for (std::size_t i = 0; i < size; ++i)
    {
        const Vector<2>& a = polygon[i];
        const Vector<2>& b = polygon[(i + 1) % size];
        nearest = std::min(nearest, distance(point, a, b));
        // A ray along +x crosses the edges that span the point's height and lie on its right.
        if ((a.y() > point.y()) != (b.y() > point.y()) && (turn(a, b, point) > 0) == (b.y() > a.y()))
        {
            inside = !inside;
        }
    }
    return inside ? -nearest : nearest;
}

ShapeQuality shapeQuality(const Polygon& polygon)
{
    ShapeQuality quality;
    double perimeter = 0;
    double shortest = std::numeric_limits<double>::infinity();
    quality.smallestAngle = std::numbers::pi;
    const std::size_t size = polygon.size();
    for (std::size_t i = 0; i < size; ++i)
    {
        const Vector<2> back = polygon[(i + size - 1) % size] - polygon[i];
        const Vector<2> forth = polygon[(i + 1) % size] - polygon[i];
        perimeter += forth.norm();
        shortest = std::min(shortest, forth.norm());
        quality.smallestAngle =
            std::min(quality.smallestAngle, std::atan2(std::abs(cross(back, forth)), back.dot(forth)));
    }
    if (perimeter > 0)
    {
        quality.compactness =
            4 * std::numbers::pi * std::abs(areaProperties(polygon).area) / (perimeter * perimeter);
        quality.shortestEdge = shortest / perimeter;
    }
    return quality;
}

} // namespace drystone
