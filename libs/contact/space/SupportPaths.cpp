// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Whether polyhedra touch.
#include "contact/SupportPaths.h"

#include "geometry/space/FacePolygon.h"

#include <algorithm>

namespace drystone
{

namespace
{

/// Distance of two segments [m]. The parameters of the nearest points are clamped in turn (Ericson, Real-Time
/// Collision Detection, 2004, 5.1.9).
double distanceOfSegments(const Vector<3>& p, const Vector<3>& pEnd, const Vector<3>& q,
                          const Vector<3>& qEnd)
{
    const Vector<3> u = pEnd - p;
    const Vector<3> v = qEnd - q;
    const Vector<3> w = p - q;
    const double a = u.squaredNorm();
    const double e = v.squaredNorm();
    const double b = u.dot(v);
    const double c = u.dot(w);
    const double f = v.dot(w);
    const double determinant = a * e - b * b;
    double s = determinant > 0 ? std::clamp((b * f - c * e) / determinant, 0.0, 1.0) : 0;
    double t = (b * s + f) / e;
    if (t < 0 || t > 1)
    {
        t = std::clamp(t, 0.0, 1.0);
        s = std::clamp((b * t - c) / a, 0.0, 1.0);
    }
    return (w + s * u - t * v).norm();
}

std::vector<std::pair<int, int>> edgesOf(const Polyhedron& shape)
{
    std::vector<std::pair<int, int>> edges;
    for (const std::vector<int>& face : shape.faces)
    {
        for (std::size_t i = 0; i < face.size(); ++i)
        {
            const int next = face[(i + 1) % face.size()];
            if (face[i] < next)
            {
                edges.emplace_back(face[i], next);
            }
        }
    }
    return edges;
}

} // namespace

bool touch(const Block<3>& one, const Block<3>& other, double tolerance)
{
    const auto isOn = [tolerance](const Polyhedron& shape)
    { return [&shape, tolerance](const Vector<3>& corner) { return distance(shape, corner) <= tolerance; }; };
    if (std::any_of(one.shape.vertices.begin(), one.shape.vertices.end(), isOn(other.shape))
        || std::any_of(other.shape.vertices.begin(), other.shape.vertices.end(), isOn(one.shape)))
    {
        return true;
    }
    const std::vector<std::pair<int, int>> edgesOfOther = edgesOf(other.shape);
    for (const auto& [from, to] : edgesOf(one.shape))
    {
        for (const auto& [start, end] : edgesOfOther)
        {
            if (distanceOfSegments(one.shape.vertices[from], one.shape.vertices[to],
                                   other.shape.vertices[start], other.shape.vertices[end])
                <= tolerance)
            {
                return true;
            }
        }
    }
    return false;
}

} // namespace drystone
