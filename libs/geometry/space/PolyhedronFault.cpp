// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The faults of a polyhedron, a function each.
#include "geometry/space/PolyhedronFault.h"

#include "geometry/PolygonShape.h"
#include "geometry/space/FacePolygon.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace drystone
{

namespace
{

using Fault = std::optional<PolyhedronFault>;

/// Relative to the extent of the block: coordinates written to six digits are within it.
constexpr double planeTolerance = 1e-5;
constexpr double sameTolerance = 1e-10;

double extentOf(const Polyhedron& polyhedron)
{
    Vector<3> lower = polyhedron.vertices.front();
    Vector<3> upper = lower;
    for (const Vector<3>& vertex : polyhedron.vertices)
    {
        lower = lower.cwiseMin(vertex);
        upper = upper.cwiseMax(vertex);
    }
    return (upper - lower).norm();
}

Fault faultOfVertices(const Polyhedron& polyhedron)
{
    const std::vector<Vector<3>>& vertices = polyhedron.vertices;
    if (vertices.size() < 4)
    {
        return PolyhedronFault{PolyhedronFault::vertices,
                               fmt::format("it has {} vertices, at least 4 are needed", vertices.size())};
    }
    for (std::size_t i = 0; i < vertices.size(); ++i)
    {
        if (!vertices[i].allFinite())
        {
            return PolyhedronFault{PolyhedronFault::vertices, fmt::format("vertex {} is not finite", i)};
        }
    }
    const double near = sameTolerance * extentOf(polyhedron);
    for (std::size_t i = 0; i < vertices.size(); ++i)
    {
        for (std::size_t j = 0; j < i; ++j)
        {
            if ((vertices[i] - vertices[j]).norm() <= near)
            {
                return PolyhedronFault{PolyhedronFault::vertices,
                                       fmt::format("vertices {} and {} coincide", j, i)};
            }
        }
    }
    return {};
}

/// Of the indices of the faces.
Fault faultOfIndices(const Polyhedron& polyhedron)
{
    if (polyhedron.faces.size() < 4)
    {
        return PolyhedronFault{
            PolyhedronFault::allFaces,
            fmt::format("it has {} faces, at least 4 are needed", polyhedron.faces.size())};
    }
    const int count = static_cast<int>(polyhedron.vertices.size());
    std::vector<char> isUsed(polyhedron.vertices.size(), false);
    for (std::size_t f = 0; f < polyhedron.faces.size(); ++f)
    {
        const std::vector<int>& face = polyhedron.faces[f];
        const int index = static_cast<int>(f);
        if (face.size() < 3)
        {
            return PolyhedronFault{
                index, fmt::format("face {} has {} vertices, at least 3 are needed", f, face.size())};
        }
        for (std::size_t i = 0; i < face.size(); ++i)
        {
            if (face[i] < 0 || face[i] >= count)
            {
                return PolyhedronFault{
                    index, fmt::format("face {} has the vertex {}, but vertices are numbered from 0 to {}", f,
                                       face[i], count - 1)};
            }
            if (std::count(face.begin(), face.end(), face[i]) > 1)
            {
                return PolyhedronFault{index,
                                       fmt::format("face {} has the vertex {} more than once", f, face[i])};
            }
            isUsed[static_cast<std::size_t>(face[i])] = true;
        }
    }
    const auto unused = std::find(isUsed.begin(), isUsed.end(), false);
    if (unused != isUsed.end())
    {
        return PolyhedronFault{PolyhedronFault::vertices,
                               fmt::format("vertex {} belongs to no face", unused - isUsed.begin())};
    }
    return {};
}

/// Every edge is passed twice, once in each direction.
Fault faultOfEdges(const Polyhedron& polyhedron)
{
    std::map<std::pair<int, int>, int> faceOfEdge;
    for (std::size_t f = 0; f < polyhedron.faces.size(); ++f)
    {
        const std::vector<int>& face = polyhedron.faces[f];
        for (std::size_t i = 0; i < face.size(); ++i)
        {
            const std::pair edge(face[i], face[(i + 1) % face.size()]);
            const auto [before, isNew] = faceOfEdge.emplace(edge, static_cast<int>(f));
            if (!isNew)
            {
                return PolyhedronFault{
                    static_cast<int>(f),
                    fmt::format(
                        "faces {} and {} both run from vertex {} to vertex {}, so one of them is turned "
                        "inside, or its vertices are not in their order round it",
                        before->second, f, edge.first, edge.second)};
            }
        }
    }
    for (const auto& [edge, face] : faceOfEdge)
    {
        if (!faceOfEdge.contains({edge.second, edge.first}))
        {
            return PolyhedronFault{
                face, fmt::format("it is not closed: the edge of face {} from vertex {} to vertex "
                                  "{} belongs to no other face",
                                  face, edge.first, edge.second)};
        }
    }
    return {};
}

Fault faultOfPlanes(const Polyhedron& polyhedron)
{
    const double tolerance = planeTolerance * extentOf(polyhedron);
    for (std::size_t f = 0; f < polyhedron.faces.size(); ++f)
    {
        const int index = static_cast<int>(f);
        const Vector<3> area = areaVector(polyhedron, polyhedron.faces[f]);
        if (area.norm() <= sameTolerance * extentOf(polyhedron) * extentOf(polyhedron))
        {
            return PolyhedronFault{index, fmt::format("face {} has no area", f)};
        }
        const FacePolygon face = facePolygon(polyhedron, polyhedron.faces[f]);
        double worst = 0;
        for (const int vertex : polyhedron.faces[f])
        {
            worst =
                std::max(worst, std::abs(face.frame.col(0).dot(polyhedron.vertices[vertex] - face.origin)));
        }
        if (worst > tolerance)
        {
            return PolyhedronFault{
                index,
                fmt::format("face {} is not plane: its vertices are up to {:.3g} m from a plane. Give more "
                            "digits, or split it into triangles",
                            f, worst)};
        }
        if (const std::string fault = outlineFault(face.outline); !fault.empty())
        {
            return PolyhedronFault{index, fmt::format("face {} {}", f, fault)};
        }
    }
    return {};
}

/// An edge that passes through a face which it has no vertex in common with.
Fault faultOfCrossings(const Polyhedron& polyhedron)
{
    const double near = 1e-9 * extentOf(polyhedron);
    for (std::size_t f = 0; f < polyhedron.faces.size(); ++f)
    {
        const std::vector<int>& corners = polyhedron.faces[f];
        const FacePolygon face = facePolygon(polyhedron, corners);
        for (std::size_t g = 0; g < polyhedron.faces.size(); ++g)
        {
            const std::vector<int>& other = polyhedron.faces[g];
            for (std::size_t i = 0; g != f && i < other.size(); ++i)
            {
                const int a = other[i];
                const int b = other[(i + 1) % other.size()];
                if (a > b || std::find(corners.begin(), corners.end(), a) != corners.end()
                    || std::find(corners.begin(), corners.end(), b) != corners.end())
                {
                    continue;
                }
                const double heightA = face.frame.col(0).dot(polyhedron.vertices[a] - face.origin);
                const double heightB = face.frame.col(0).dot(polyhedron.vertices[b] - face.origin);
                if (!((heightA > near && heightB < -near) || (heightA < -near && heightB > near)))
                {
                    continue;
                }
                const Vector<3> crossing =
                    polyhedron.vertices[a]
                    + heightA / (heightA - heightB) * (polyhedron.vertices[b] - polyhedron.vertices[a]);
                if (signedDistance(face.outline, inPlane(face, crossing)) < -near)
                {
                    return PolyhedronFault{
                        static_cast<int>(g),
                        fmt::format("face {} passes through face {}, at ({:.6g} {:.6g} {:.6g})", g, f,
                                    crossing.x(), crossing.y(), crossing.z())};
                }
            }
        }
    }
    return {};
}

Fault faultOfVolume(const Polyhedron& polyhedron)
{
    const double volume = volumeProperties(polyhedron).volume;
    const double extent = extentOf(polyhedron);
    if (std::abs(volume) <= sameTolerance * extent * extent * extent)
    {
        return PolyhedronFault{PolyhedronFault::allFaces, "it has no volume"};
    }
    if (volume < 0)
    {
        return PolyhedronFault{PolyhedronFault::allFaces,
                               "all its faces are turned inside: reverse the order of the vertices of each"};
    }
    return {};
}

} // namespace

std::optional<PolyhedronFault> findFault(const Polyhedron& polyhedron)
{
    for (const auto& faultOf :
         {faultOfVertices, faultOfIndices, faultOfEdges, faultOfPlanes, faultOfVolume, faultOfCrossings})
    {
        if (Fault fault = faultOf(polyhedron))
        {
            return fault;
        }
    }
    return {};
}

} // namespace drystone
