// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Separating axes, and clipping of tetrahedra by half spaces.
#include "geometry/space/PolyhedronOverlap.h"

#include "geometry/space/ConvexParts.h"
#include "geometry/space/EdgeLine.h"
#include "geometry/space/FacePolygon.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

namespace drystone
{

namespace
{

double reachOf(const Polyhedron& polyhedron)
{
    double extent = 0;
    for (const Vector<3>& vertex : polyhedron.vertices)
    {
        extent = std::max(extent, (vertex - polyhedron.vertices.front()).norm());
    }
    return extent;
}

std::vector<Vector<3>> faceNormals(const Polyhedron& polyhedron)
{
    std::vector<Vector<3>> normals;
    for (const std::vector<int>& face : polyhedron.faces)
    {
        normals.push_back(areaVector(polyhedron, face).normalized());
    }
    return normals;
}

/// Directions of the edges, those that are parallel once.
std::vector<Vector<3>> edgeDirections(const Polyhedron& polyhedron)
{
    std::vector<Vector<3>> directions;
    for (const EdgeLine& edge : edgesOf(polyhedron))
    {
        const Vector<3> direction = edge.along.normalized();
        if (std::none_of(directions.begin(), directions.end(),
                         [&](const Vector<3>& known) { return std::abs(known.dot(direction)) > 1 - 1e-12; }))
        {
            directions.push_back(direction);
        }
    }
    return directions;
}

/// How far the two reach into each other along an axis, either way the lesser; negative when it parts them.
double overlapAlong(const Polyhedron& a, const Polyhedron& b, const Vector<3>& axis)
{
    const auto range = [&](const Polyhedron& polyhedron)
    {
        std::pair result(std::numeric_limits<double>::max(), std::numeric_limits<double>::lowest());
        for (const Vector<3>& vertex : polyhedron.vertices)
        {
            const double place = axis.dot(vertex - a.vertices.front());
            result = {std::min(result.first, place), std::max(result.second, place)};
        }
        return result;
    };
    const auto [lowerA, upperA] = range(a);
    const auto [lowerB, upperB] = range(b);
    return std::min(upperA - lowerB, upperB - lowerA);
}

double depthOfConvex(const Polyhedron& a, const Polyhedron& b)
{
    double least = std::numeric_limits<double>::max();
    for (const Polyhedron* polyhedron : {&a, &b})
    {
        for (const Vector<3>& normal : faceNormals(*polyhedron))
        {
            least = std::min(least, overlapAlong(a, b, normal));
            if (least <= 0)
            {
                return 0;
            }
        }
    }
    const std::vector<Vector<3>> edgesOfB = edgeDirections(b);
    for (const Vector<3>& edge : edgeDirections(a))
    {
        for (const Vector<3>& other : edgesOfB)
        {
            const Vector<3> across = edge.cross(other);
            if (across.norm() > 1e-6)
            {
                least = std::min(least, overlapAlong(a, b, across.normalized()));
                if (least <= 0)
                {
                    return 0;
                }
            }
        }
    }
    return least;
}

/// How deep a point lies in a polyhedron; 0 outside.
double depthOf(const Polyhedron& polyhedron, const Vector<3>& point)
{
    return distance(polyhedron, point) > 0 ? 0 : distanceFromSurface(polyhedron, point);
}

using Tetrahedron = std::array<Vector<3>, 4>;

double signedVolume(const Tetrahedron& t)
{
    return (t[1] - t[0]).dot((t[2] - t[0]).cross(t[3] - t[0])) / 6;
}

/// The part of a tetrahedron behind a plane as tetrahedra, added to a list. \param height of each corner
/// above it
void clip(const Tetrahedron& t, const std::array<double, 4>& height, std::vector<Tetrahedron>& parts)
{
    std::array<int, 4> order{0, 1, 2, 3};
    std::sort(order.begin(), order.end(), [&](int i, int j) { return height[i] < height[j]; });
    const auto at = [&](int i) -> const Vector<3>& { return t[order[i]]; };
    const auto cut = [&](int i, int j) -> Vector<3>
    {
        const double low = height[order[i]];
        const double high = height[order[j]];
        return at(i) + low / (low - high) * (at(j) - at(i));
    };
    const auto behind = std::count_if(height.begin(), height.end(), [](double h) { return h < 0; });
    // A prism with the triangles abc and def.
    const auto prism = [&](const Vector<3>& a, const Vector<3>& b, const Vector<3>& c, const Vector<3>& d,
                           const Vector<3>& e, const Vector<3>& f)
    {
        parts.push_back({a, b, c, d});
        parts.push_back({b, c, d, e});
        parts.push_back({c, d, e, f});
    };
    switch (behind)
    {
    case 4:
        parts.push_back(t);
        break;
    case 3:
        prism(at(0), at(1), at(2), cut(0, 3), cut(1, 3), cut(2, 3));
        break;
    case 2:
        prism(at(0), cut(0, 2), cut(0, 3), at(1), cut(1, 2), cut(1, 3));
        break;
    case 1:
        parts.push_back({at(0), cut(0, 1), cut(0, 2), cut(0, 3)});
        break;
    default:
        break;
    }
}

/// Volume common to two tetrahedra.
double commonVolume(const Tetrahedron& a, const Tetrahedron& b)
{
    std::vector<Tetrahedron> parts{a};
    for (int i = 0; i < 4 && !parts.empty(); ++i)
    {
        // The face of b opposite to corner i, its normal away from that corner.
        const Vector<3>& origin = b[(i + 1) % 4];
        Vector<3> normal = (b[(i + 2) % 4] - origin).cross(b[(i + 3) % 4] - origin);
        if (normal.dot(b[i] - origin) > 0)
        {
            normal = -normal;
        }
        std::vector<Tetrahedron> next;
        for (const Tetrahedron& part : parts)
        {
            std::array<double, 4> height{};
            for (int corner = 0; corner < 4; ++corner)
            {
                height[corner] = normal.dot(part[corner] - origin);
            }
            clip(part, height, next);
        }
        parts = std::move(next);
    }
    double volume = 0;
    for (const Tetrahedron& part : parts)
    {
        volume += std::abs(signedVolume(part));
    }
    return volume;
}

/// Tetrahedra from a point to the triangles of the faces. Those that are flat but for rounding, as of three
/// corners in a line, have no volume, and rounding would decide on which side of their faces they lie.
std::vector<Tetrahedron> tetrahedra(const Polyhedron& polyhedron, const Vector<3>& apex)
{
    const double flat = 1e-12 * std::pow(reachOf(polyhedron), 3);
    std::vector<Tetrahedron> result;
    for (const std::vector<int>& face : polyhedron.faces)
    {
        for (std::size_t i = 1; i + 1 < face.size(); ++i)
        {
            const Tetrahedron one{apex, polyhedron.vertices[face[0]], polyhedron.vertices[face[i]],
                                  polyhedron.vertices[face[i + 1]]};
            if (std::abs(signedVolume(one)) > flat)
            {
                result.push_back(one);
            }
        }
    }
    return result;
}

/// A convex solid as it is, another in convex parts; none where they are too many.
std::vector<Polyhedron> partsOf(const Polyhedron& polyhedron)
{
    constexpr std::size_t most = 200;
    return isConvex(polyhedron) ? std::vector<Polyhedron>{polyhedron}
                                : convexParts(polyhedron, 1e-9 * reachOf(polyhedron), most);
}

} // namespace

bool isConvex(const Polyhedron& polyhedron)
{
    return isConvex(polyhedron, 1e-9 * reachOf(polyhedron));
}

bool isConvex(const Polyhedron& polyhedron, double within)
{
    for (const std::vector<int>& face : polyhedron.faces)
    {
        const Vector<3> normal = areaVector(polyhedron, face).normalized();
        for (const Vector<3>& vertex : polyhedron.vertices)
        {
            if (normal.dot(vertex - polyhedron.vertices[face.front()]) > within)
            {
                return false;
            }
        }
    }
    return true;
}

double overlapDepth(const Polyhedron& a, const Polyhedron& b)
{
    if (isConvex(a) && isConvex(b))
    {
        return depthOfConvex(a, b);
    }
    double deepest = 0;
    for (const auto& [one, other] : {std::pair(&a, &b), std::pair(&b, &a)})
    {
        for (const Vector<3>& vertex : one->vertices)
        {
            deepest = std::max(deepest, depthOf(*other, vertex));
        }
    }
    const std::vector<Polyhedron> partsOfB = partsOf(b);
    for (const Polyhedron& part : partsOf(a))
    {
        for (const Polyhedron& other : partsOfB)
        {
            deepest = std::max(deepest, depthOfConvex(part, other));
        }
    }
    return deepest;
}

double overlapVolume(const Polyhedron& a, const Polyhedron& b)
{
    const std::vector<Tetrahedron> ofB = tetrahedra(b, volumeProperties(b).centroid);
    double volume = 0;
    for (const Tetrahedron& one : tetrahedra(a, volumeProperties(a).centroid))
    {
        for (const Tetrahedron& other : ofB)
        {
            const double sign = signedVolume(one) * signedVolume(other);
            volume += sign == 0 ? 0 : std::copysign(commonVolume(one, other), sign);
        }
    }
    return std::max(0.0, volume);
}

SolidQuality solidQuality(const Polyhedron& polyhedron)
{
    SolidQuality quality;
    double surface = 0;
    quality.shortestEdge = std::numeric_limits<double>::infinity();
    for (const std::vector<int>& face : polyhedron.faces)
    {
        surface += areaVector(polyhedron, face).norm();
        for (std::size_t i = 0; i < face.size(); ++i)
        {
            quality.shortestEdge = std::min(
                quality.shortestEdge,
                (polyhedron.vertices[face[(i + 1) % face.size()]] - polyhedron.vertices[face[i]]).norm());
        }
    }
    const double volume = volumeProperties(polyhedron).volume;
    quality.compactness = 36 * std::numbers::pi * volume * volume / (surface * surface * surface);
    return quality;
}

} // namespace drystone
