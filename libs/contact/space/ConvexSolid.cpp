// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Faces, edges and places of convex solids.
#include "contact/space/ConvexSolid.h"

#include "geometry/Rotation.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

namespace drystone
{
namespace
{

/// Cosine of the angle below which two normals are those of one plane, in sines of 1e-6.
constexpr double onePlane = 1 - 1e-12;

/// The vertices in the plane of a face, in order round it, without those along straight edges.
std::vector<int> verticesRound(const std::vector<Vector<3>>& vertices, const Vector<3>& point,
                               const Vector<3>& normal, double tolerance)
{
    std::vector<int> round;
    Vector<3> middle = Vector<3>::Zero();
    for (int vertex = 0; vertex < static_cast<int>(vertices.size()); ++vertex)
    {
        const Vector<3>& place = vertices[static_cast<std::size_t>(vertex)];
        const auto isThere = [&](int other)
        { return (vertices[static_cast<std::size_t>(other)] - place).norm() <= tolerance; };
        if (std::abs(normal.dot(place - point)) <= tolerance
            && std::none_of(round.begin(), round.end(), isThere))
        {
            round.push_back(vertex);
            middle += place;
        }
    }
    middle /= static_cast<double>(round.size());
    const Vector<3> along = normal.unitOrthogonal();
    const Vector<3> across = normal.cross(along);
    const auto angleOf = [&](int vertex)
    {
        const Vector<3> arm = vertices[static_cast<std::size_t>(vertex)] - middle;
        return std::atan2(arm.dot(across), arm.dot(along));
    };
    std::sort(round.begin(), round.end(), [&](int a, int b) { return angleOf(a) < angleOf(b); });
    std::vector<int> turning;
    for (std::size_t i = 0; i < round.size(); ++i)
    {
        const Vector<3>& before =
            vertices[static_cast<std::size_t>(round[(i + round.size() - 1) % round.size()])];
        const Vector<3>& here = vertices[static_cast<std::size_t>(round[i])];
        const Vector<3>& after = vertices[static_cast<std::size_t>(round[(i + 1) % round.size()])];
        const Vector<3> chord = (after - before).normalized();
        if ((here - before - chord.dot(here - before) * chord).norm() > tolerance)
        {
            turning.push_back(round[i]);
        }
    }
    return turning;
}

void findEdges(ConvexSolid& solid)
{
    std::map<std::pair<int, int>, int> faceOf; // of each directed edge
    for (int face = 0; face < static_cast<int>(solid.faces.size()); ++face)
    {
        const std::vector<int>& round = solid.faces[static_cast<std::size_t>(face)];
        for (std::size_t i = 0; i < round.size(); ++i)
        {
            faceOf[{round[i], round[(i + 1) % round.size()]}] = face;
        }
    }
    for (const auto& [edge, face] : faceOf)
    {
        const auto opposite = faceOf.find({edge.second, edge.first});
        if (edge.first < edge.second && opposite != faceOf.end())
        {
            solid.edges.push_back({edge.first, edge.second, face, opposite->second});
        }
    }
}

} // namespace

const Vector<3>& pointOf(const ConvexSolid& solid, int face)
{
    return solid.vertices[static_cast<std::size_t>(solid.faces[static_cast<std::size_t>(face)].front())];
}

double leastAlong(const ConvexSolid& solid, const Vector<3>& normal, const Vector<3>& point)
{
    double least = std::numeric_limits<double>::infinity();
    for (const Vector<3>& vertex : solid.vertices)
    {
        least = std::min(least, normal.dot(vertex - point));
    }
    return least;
}

ConvexSolid convexSolid(const Polyhedron& shape, double tolerance)
{
    ConvexSolid solid;
    solid.vertices = shape.vertices;
    for (const std::vector<int>& face : shape.faces)
    {
        const Vector<3> normal = areaVector(shape, face).normalized();
        const auto isThere = [&](const Vector<3>& other) { return other.dot(normal) > onePlane; };
        if (std::any_of(solid.normals.begin(), solid.normals.end(), isThere))
        {
            continue; // a piece of a face that is there
        }
        std::vector<int> round = verticesRound(
            solid.vertices, shape.vertices[static_cast<std::size_t>(face.front())], normal, tolerance);
        if (round.size() < 3)
        {
            continue;
        }
        solid.normals.push_back(normal);
        solid.faces.push_back(std::move(round));
    }
    findEdges(solid);
    solid.thickness = std::numeric_limits<double>::infinity();
    for (std::size_t face = 0; face < solid.faces.size(); ++face)
    {
        solid.thickness = std::min(
            solid.thickness, -leastAlong(solid, solid.normals[face], pointOf(solid, static_cast<int>(face))));
    }
    return solid;
}

int edgeBetween(const ConvexSolid& solid, int from, int to)
{
    const auto found =
        std::find_if(solid.edges.begin(), solid.edges.end(),
                     [&](const ConvexSolid::Edge& edge) {
                         return (edge.from == from && edge.to == to) || (edge.from == to && edge.to == from);
                     });
    return found == solid.edges.end() ? -1 : static_cast<int>(found - solid.edges.begin());
}

ConvexSolid placed(ConvexSolid solid, const Vector<3>& centroid, const Placement<3>& placement)
{
    const Swing<3> swing(placement.rotation);
    for (Vector<3>& vertex : solid.vertices)
    {
        vertex += placement.translation + swing(vertex - centroid);
    }
    for (Vector<3>& normal : solid.normals)
    {
        normal += swing(normal);
    }
    return solid;
}

PlacedSolids::PlacedSolids(const std::vector<std::vector<ConvexSolid>>& asBuilt,
                           const std::vector<Vector<3>>& centroidsOfBlocks,
                           const std::vector<Placement<3>>& placementsOfBlocks)
    : solids(&asBuilt), centroids(&centroidsOfBlocks), where(&placementsOfBlocks), there(asBuilt.size())
{
}

const std::vector<ConvexSolid>& PlacedSolids::of(int block)
{
    const auto index = static_cast<std::size_t>(block);
    if (there[index].empty())
    {
        for (const ConvexSolid& solid : (*solids)[index])
        {
            there[index].push_back(placed(solid, (*centroids)[index], (*where)[index]));
        }
    }
    return there[index];
}

} // namespace drystone
