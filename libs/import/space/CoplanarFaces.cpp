// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Triangles of one plane, merged into the face that they were cut from.
#include "import/space/Edges.h"
#include "import/space/Mesh.h"

#include <cmath>
#include <map>
#include <numeric>

namespace drystone
{

namespace
{

/// Coplanar regions of more faces than this are merged as a whole or not at all: piece by piece takes time of
/// the order of their square.
constexpr std::size_t mostPieces = 500;

/// Neighbours whose normals differ by more than some 8 degrees are faces of their own, however small they
/// are.
constexpr double leastCosine = 0.99;

/// The one closed line round some faces, which passes no vertex twice; empty where there is no such line.
std::vector<int> outlineOf(const Polyhedron& mesh, const std::vector<int>& faces)
{
    std::map<std::pair<int, int>, int> edges; // how often an edge is there, less the reverse one
    for (const int f : faces)
    {
        const std::vector<int>& face = mesh.faces[f];
        for (std::size_t i = 0; i < face.size(); ++i)
        {
            const int from = face[i];
            const int to = face[(i + 1) % face.size()];
            edges[{std::min(from, to), std::max(from, to)}] += from < to ? 1 : -1;
        }
    }
    std::map<int, int> next;
    for (const auto& [edge, count] : edges)
    {
        if (count == 0)
        {
            continue;
        }
        const auto [from, to] = count > 0 ? edge : std::pair(edge.second, edge.first);
        if (std::abs(count) > 1 || !next.emplace(from, to).second)
        {
            return {};
        }
    }
    std::vector<int> outline;
    if (next.empty())
    {
        return outline;
    }
    const int start = next.begin()->first;
    int vertex = start;
    do
    {
        outline.push_back(vertex);
        const auto following = next.find(vertex);
        if (following == next.end() || outline.size() > next.size())
        {
            return {};
        }
        vertex = following->second;
    } while (vertex != start);
    return outline.size() == next.size() ? outline : std::vector<int>();
}

class Merge
{
public:
    Merge(Polyhedron& whole, double distance) : mesh(whole), tolerance(distance)
    {
        const std::vector<FaceEdge> edges = sortedEdges(mesh);
        neighbours.resize(mesh.faces.size());
        for (const std::vector<int>& face : mesh.faces)
        {
            const Vector<3> area = areaVector(mesh, face);
            areas.push_back(area.norm());
            normals.push_back(areas.back() > 0 ? Vector<3>(area / areas.back()) : Vector<3>::Zero());
        }
        visitEdges(edges,
                   [&](EdgeIterator first, EdgeIterator last)
                   {
                       if (last - first != 2)
                       {
                           return;
                       }
                       const int a = first->face;
                       const int b = std::next(first)->face;
                       // A face without area, a sliver of a triangulation, has no direction of its own.
                       if (a != b
                           && (areas[a] <= tolerance * tolerance || areas[b] <= tolerance * tolerance
                               || normals[a].dot(normals[b]) > leastCosine))
                       {
                           neighbours[a].push_back(b);
                           neighbours[b].push_back(a);
                           hasCandidates = true;
                       }
                   });
    }

    int mergeAll()
    {
        if (!hasCandidates)
        {
            return 0;
        }
        const std::size_t before = mesh.faces.size();
        regionOf.assign(before, -1);
        std::vector<int> order(before);
        std::iota(order.begin(), order.end(), 0);
        std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return areas[a] > areas[b]; });
        for (const int seed : order)
        {
            if (regionOf[seed] < 0)
            {
                merge(regionFrom(seed));
            }
        }
        Polyhedron merged;
        merged.vertices = std::move(mesh.vertices);
        // In the order of the first face of each.
        for (std::size_t f = 0; f < before; ++f)
        {
            if (const auto found = outlines.find(static_cast<int>(f)); found != outlines.end())
            {
                merged.faces.push_back(found->second);
            }
        }
        mesh = std::move(merged);
        return static_cast<int>(before - mesh.faces.size());
    }

private:
    /// The faces that are reached from a seed in its plane.
    std::vector<int> regionFrom(int seed)
    {
        const Vector<3>& normal = normals[seed];
        const Vector<3>& origin = mesh.vertices[mesh.faces[seed].front()];
        const auto isInPlane = [&](int face)
        {
            return std::all_of(mesh.faces[face].begin(), mesh.faces[face].end(),
                               [&](int vertex)
                               { return std::abs(normal.dot(mesh.vertices[vertex] - origin)) <= tolerance; });
        };
        std::vector<int> region{seed};
        regionOf[seed] = seed;
        for (std::size_t next = 0; next < region.size(); ++next)
        {
            for (const int neighbour : neighbours[region[next]])
            {
                if (regionOf[neighbour] < 0 && isInPlane(neighbour))
                {
                    regionOf[neighbour] = seed;
                    region.push_back(neighbour);
                }
            }
        }
        return region;
    }

    /// As a whole, or else in parts that have one outline each.
    void merge(std::vector<int> region)
    {
        if (region.size() == 1)
        {
            outlines[region.front()] = mesh.faces[region.front()];
            return;
        }
        if (const std::vector<int> outline = outlineOf(mesh, region); !outline.empty())
        {
            outlines[*std::min_element(region.begin(), region.end())] = outline;
            return;
        }
        const bool areFew = region.size() <= mostPieces;
        while (!region.empty())
        {
            std::vector<int> part{region.front()};
            std::vector<int> outline = mesh.faces[region.front()];
            std::vector<int> rest;
            bool isGrown = areFew;
            region.erase(region.begin());
            while (isGrown)
            {
                isGrown = false;
                rest.clear();
                for (const int face : region)
                {
                    const bool isNear = std::any_of(
                        neighbours[face].begin(), neighbours[face].end(),
                        [&](int other) { return std::find(part.begin(), part.end(), other) != part.end(); });
                    part.push_back(face);
                    std::vector<int> larger = isNear ? outlineOf(mesh, part) : std::vector<int>();
                    if (larger.empty())
                    {
                        part.pop_back();
                        rest.push_back(face);
                        continue;
                    }
                    outline = std::move(larger);
                    isGrown = true;
                }
                region = rest;
            }
            outlines[*std::min_element(part.begin(), part.end())] = std::move(outline);
        }
    }

    Polyhedron& mesh;
    double tolerance;
    std::vector<Vector<3>> normals;
    std::vector<double> areas;
    std::vector<std::vector<int>> neighbours; ///< that may lie in one plane
    std::vector<int> regionOf;
    std::map<int, std::vector<int>> outlines; ///< of the faces that result, by their first old face
    bool hasCandidates = false;
};

/// Vertices of two faces only, on the line between the next ones.
void removeStraightVertices(Polyhedron& mesh, double tolerance)
{
    std::vector<int> faceCount(mesh.vertices.size(), 0);
    for (const std::vector<int>& face : mesh.faces)
    {
        for (const int vertex : face)
        {
            ++faceCount[vertex];
        }
    }
    std::vector<bool> isStraight(mesh.vertices.size(), false);
    for (const std::vector<int>& face : mesh.faces)
    {
        for (std::size_t i = 0; i < face.size(); ++i)
        {
            const Vector<3>& before = mesh.vertices[face[(i + face.size() - 1) % face.size()]];
            const Vector<3>& here = mesh.vertices[face[i]];
            const Vector<3>& after = mesh.vertices[face[(i + 1) % face.size()]];
            const Vector<3> whole = after - before;
            const double length = whole.norm();
            if (faceCount[face[i]] == 2 && length > tolerance)
            {
                const double along = whole.dot(here - before) / length;
                isStraight[face[i]] = along > 0 && along < length
                                      && (here - before - along / length * whole).norm() <= tolerance;
            }
        }
    }
    for (std::vector<int>& face : mesh.faces)
    {
        const auto straight =
            std::count_if(face.begin(), face.end(), [&](int vertex) { return isStraight[vertex]; });
        if (face.size() - static_cast<std::size_t>(straight) < 3)
        {
            return; // not closed, or folded: left as it is, for findFault to name
        }
    }
    for (std::vector<int>& face : mesh.faces)
    {
        std::erase_if(face, [&](int vertex) { return isStraight[vertex]; });
    }
}

void removeUnusedVertices(Polyhedron& mesh)
{
    std::vector<int> newIndex(mesh.vertices.size(), -1);
    for (const std::vector<int>& face : mesh.faces)
    {
        for (const int vertex : face)
        {
            newIndex[vertex] = 0;
        }
    }
    std::vector<Vector<3>> used;
    for (std::size_t i = 0; i < newIndex.size(); ++i)
    {
        if (newIndex[i] == 0)
        {
            newIndex[i] = static_cast<int>(used.size());
            used.push_back(mesh.vertices[i]);
        }
    }
    for (std::vector<int>& face : mesh.faces)
    {
        for (int& vertex : face)
        {
            vertex = newIndex[vertex];
        }
    }
    mesh.vertices = std::move(used);
}

} // namespace

int mergeCoplanar(Polyhedron& mesh, double tolerance)
{
    const int merged = Merge(mesh, tolerance).mergeAll();
    removeStraightVertices(mesh, tolerance);
    removeUnusedVertices(mesh);
    return merged;
}

} // namespace drystone
