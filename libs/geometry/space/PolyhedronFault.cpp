// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The faults of a polyhedron, a function each.
#include "geometry/space/PolyhedronFault.h"

#include "geometry/Box.h"
#include "geometry/PolygonShape.h"
#include "geometry/space/FacePolygon.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

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
    const Box<3> box = boxAround<3>(polyhedron.vertices);
    return (box.upper - box.lower).norm();
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

/// Faces that hang together by their edges, a list each, where every edge has its two.
std::vector<std::vector<int>> shellsOf(const Polyhedron& polyhedron)
{
    std::map<std::pair<int, int>, int> faceOfEdge;
    const auto forEdges = [&](int face, const auto& visit)
    {
        const std::vector<int>& corners = polyhedron.faces[static_cast<std::size_t>(face)];
        for (std::size_t i = 0; i < corners.size(); ++i)
        {
            visit(corners[i], corners[(i + 1) % corners.size()]);
        }
    };
    const auto count = static_cast<int>(polyhedron.faces.size());
    for (int face = 0; face < count; ++face)
    {
        forEdges(face, [&](int from, int to) { faceOfEdge[{from, to}] = face; });
    }
    std::vector<std::vector<int>> shells;
    std::vector<bool> isTaken(polyhedron.faces.size(), false);
    for (int start = 0; start < count; ++start)
    {
        if (isTaken[static_cast<std::size_t>(start)])
        {
            continue;
        }
        isTaken[static_cast<std::size_t>(start)] = true;
        std::vector<int> shell{start};
        for (std::size_t next = 0; next < shell.size(); ++next)
        {
            forEdges(shell[next],
                     [&](int from, int to)
                     {
                         const int face = faceOfEdge.at({to, from});
                         if (!isTaken[static_cast<std::size_t>(face)])
                         {
                             isTaken[static_cast<std::size_t>(face)] = true;
                             shell.push_back(face);
                         }
                     });
        }
        shells.push_back(std::move(shell));
    }
    return shells;
}

/// The same vertices with some of the faces.
Polyhedron withFaces(const Polyhedron& polyhedron, const std::vector<int>& faces)
{
    Polyhedron part{polyhedron.vertices, {}};
    for (const int face : faces)
    {
        part.faces.push_back(polyhedron.faces[static_cast<std::size_t>(face)]);
    }
    return part;
}

/// Whether a closed surface goes round a point that is not on it: the solid angles of its faces are then 4 pi
/// together, otherwise nothing (each of triangles from one corner: A. van Oosterom, J. Strackee, The solid
/// angle of a plane triangle, IEEE Trans. Biomed. Eng. 30 (1983), eq. 8).
bool isWithin(const Polyhedron& surface, const Vector<3>& point)
{
    double angle = 0;
    for (const std::vector<int>& face : surface.faces)
    {
        const auto from = [&](std::size_t corner) -> Vector<3>
        { return surface.vertices[static_cast<std::size_t>(face[corner])] - point; };
        const Vector<3> a = from(0);
        for (std::size_t corner = 1; corner + 1 < face.size(); ++corner)
        {
            const Vector<3> b = from(corner);
            const Vector<3> c = from(corner + 1);
            const double lengths = a.norm() * b.norm() * c.norm() + a.dot(b) * c.norm() + a.dot(c) * b.norm()
                                   + b.dot(c) * a.norm();
            angle += 2 * std::atan2(a.dot(b.cross(c)), lengths);
        }
    }
    return angle > 2 * std::numbers::pi;
}

/// A block is one solid: of its shells one goes round it, and others are cavities within that.
Fault faultOfShells(const Polyhedron& polyhedron)
{
    const std::vector<std::vector<int>> shells = shellsOf(polyhedron);
    const auto isOuter = [&](const std::vector<int>& shell)
    { return volumeProperties(withFaces(polyhedron, shell)).volume > 0; };
    const auto outer = std::find_if(shells.begin(), shells.end(), isOuter);
    for (auto shell = shells.begin(); shells.size() > 1 && shell != shells.end(); ++shell)
    {
        const int face = shell->front();
        if (shell != outer && isOuter(*shell))
        {
            return PolyhedronFault{
                face, fmt::format("it consists of solids apart from each other, with face {} and with face "
                                  "{}: give each as a block of its own",
                                  outer->front(), face)};
        }
        const auto corner =
            static_cast<std::size_t>(polyhedron.faces[static_cast<std::size_t>(face)].front());
        if (shell != outer && !isWithin(withFaces(polyhedron, *outer), polyhedron.vertices[corner]))
        {
            return PolyhedronFault{
                face, fmt::format("the faces joined with face {} are turned inside, and no cavity: they lie "
                                  "apart from the solid. Give them as a block of their own, the vertices of "
                                  "each in reverse order",
                                  face)};
        }
    }
    return {};
}

} // namespace

std::optional<PolyhedronFault> findFault(const Polyhedron& polyhedron)
{
    for (const auto& faultOf : {faultOfVertices, faultOfIndices, faultOfEdges, faultOfPlanes, faultOfVolume,
                                faultOfCrossings, faultOfShells})
    {
        if (Fault fault = faultOf(polyhedron))
        {
            return fault;
        }
    }
    return {};
}

} // namespace drystone
