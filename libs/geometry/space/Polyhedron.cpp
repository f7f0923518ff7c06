// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Volume, moments and faces of a polyhedron: properties of the solid alone, whatever block it belongs to.
#include "geometry/space/Polyhedron.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace drystone
{

VolumeProperties volumeProperties(const Polyhedron& polyhedron)
{
    VolumeProperties properties;
    if (polyhedron.vertices.empty())
    {
        return properties;
    }
    // The divergence theorem turns the integrals over the solid into a sum over tetrahedra (0, a, b, c) from
    // the origin to the triangles of a fan in each face; signs take care of concave faces and solids. A
    // tetrahedron has the volume V = a . (b x c)/6, the first moment V/4 s with s = a + b + c, and the second
    // moments
    //     int x x' dV = V/20 (a a' + b b' + c c' + s s');
    // the inertia is tr(int x x') I - int x x', moved to the centroid by Steiner's rule.
    const Vector<3> origin = polyhedron.vertices.front();
    Vector<3> firstMoment = Vector<3>::Zero();
    Eigen::Matrix3d secondMoment = Eigen::Matrix3d::Zero();
    for (const std::vector<int>& face : polyhedron.faces)
    {
        for (std::size_t i = 1; i + 1 < face.size(); ++i)
        {
            const Vector<3> a = polyhedron.vertices[face[0]] - origin;
            const Vector<3> b = polyhedron.vertices[face[i]] - origin;
            const Vector<3> c = polyhedron.vertices[face[i + 1]] - origin;
            const Vector<3> sum = a + b + c;
            const double volume = a.dot(b.cross(c)) / 6;
            properties.volume += volume;
            firstMoment += volume / 4 * sum;
            secondMoment +=
                volume / 20
                * (a * a.transpose() + b * b.transpose() + c * c.transpose() + sum * sum.transpose());
        }
    }
    if (properties.volume != 0)
    {
        const Vector<3> arm = firstMoment / properties.volume;
        properties.centroid = origin + arm;
        const Eigen::Matrix3d central = secondMoment - properties.volume * (arm * arm.transpose());
        properties.inertia = central.trace() * Eigen::Matrix3d::Identity() - central;
    }
    return properties;
}

Vector<3> areaVector(const Polyhedron& polyhedron, const std::vector<int>& face)
{
    Vector<3> twice = Vector<3>::Zero();
    if (face.empty())
    {
        return twice;
    }
    const Vector<3>& origin = polyhedron.vertices[face[0]];
    for (std::size_t i = 1; i + 1 < face.size(); ++i)
    {
        const Vector<3> a = polyhedron.vertices[face[i]] - origin;
        const Vector<3> b = polyhedron.vertices[face[i + 1]] - origin;
        twice += a.cross(b);
    }
    return twice / 2;
}

double unevenness(const Polyhedron& polyhedron)
{
    double farthest = 0;
    for (const std::vector<int>& face : polyhedron.faces)
    {
        const Vector<3> normal = areaVector(polyhedron, face).normalized();
        Vector<3> middle = Vector<3>::Zero();
        for (const int vertex : face)
        {
            middle +=
                polyhedron.vertices[static_cast<std::size_t>(vertex)] / static_cast<double>(face.size());
        }
        for (const int vertex : face)
        {
            const Vector<3>& corner = polyhedron.vertices[static_cast<std::size_t>(vertex)];
            farthest = std::max(farthest, std::abs(normal.dot(corner - middle)));
        }
    }
    return farthest;
}

Polyhedron makeBox(const Vector<3>& lower, const Vector<3>& upper)
{
    const auto rectangle = [&](double z)
    {
        return std::vector<Vector<3>>{{lower.x(), lower.y(), z},
                                      {upper.x(), lower.y(), z},
                                      {upper.x(), upper.y(), z},
                                      {lower.x(), upper.y(), z}};
    };
    return makePrism(rectangle(lower.z()), rectangle(upper.z()));
}

Polyhedron makePrism(const std::vector<Vector<3>>& bottom, const std::vector<Vector<3>>& top)
{
    const int corners = static_cast<int>(bottom.size());
    Polyhedron prism;
    prism.vertices = bottom;
    prism.vertices.insert(prism.vertices.end(), top.begin(), top.end());
    std::vector<int> below;
    std::vector<int> above;
    for (int i = 0; i < corners; ++i)
    {
        below.push_back(corners - 1 - i);
        above.push_back(corners + i);
    }
    prism.faces = {below, above};
    for (int i = 0; i < corners; ++i)
    {
        const int next = (i + 1) % corners;
        prism.faces.push_back({i, next, corners + next, corners + i});
    }
    return prism;
}

} // namespace drystone
