// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Welding, parting and turning of the faces of a mesh.
#include "import/space/Mesh.h"

#include "core/DisjointSets.h"
#include "geometry/space/Frame.h"
#include "import/space/Edges.h"
#include "import/space/Weld.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <optional>
#include <set>

namespace drystone
{

namespace
{

/// Coordinates of the formats of surfaces are mostly of single precision.
constexpr double singleDigit = 6e-8;

/// A vertex of the face that is farthest from an edge of it: its side of the edge.
Vector<3> sideOf(const Polyhedron& mesh, const FaceEdge& edge, const Vector<3>& along)
{
    Vector<3> side = Vector<3>::Zero();
    for (const int vertex : mesh.faces[edge.face])
    {
        const Vector<3> arm = mesh.vertices[vertex] - mesh.vertices[edge.from];
        const Vector<3> across = arm - along.dot(arm) * along;
        if (across.squaredNorm() > side.squaredNorm())
        {
            side = across;
        }
    }
    return side;
}

/// Six times the volume that some faces enclose, negative where they are turned inside.
double volumeWithin(const Polyhedron& mesh, const std::vector<int>& faces)
{
    const Vector<3> origin = mesh.vertices[mesh.faces[faces.front()].front()];
    double volume = 0;
    for (const int face : faces)
    {
        const std::vector<int>& corners = mesh.faces[face];
        for (std::size_t i = 1; i + 1 < corners.size(); ++i)
        {
            const Vector<3> a = mesh.vertices[corners[0]] - origin;
            const Vector<3> b = mesh.vertices[corners[i]] - origin;
            const Vector<3> c = mesh.vertices[corners[i + 1]] - origin;
            volume += a.dot(momentOf(b, c));
        }
    }
    return volume;
}

enum class FacesTurned
{
    outwards,
    inwards
};

/// A face as seen along one of its edges.
struct Sheet
{
    int face;
    double angle;
    double blur; ///< of the angle, by the rounding of its corner
    bool isForward;
};

/// The next sheet that runs forward, turned from another towards larger angles. \return its face; -1: none
int partnerOf(const Sheet& sheet, const std::vector<Sheet>& sheets)
{
    constexpr double turn = 2 * std::numbers::pi;
    constexpr double leastAngle = 1e-6; // faces that lie on each other bound different solids
    constexpr double mostAngle = 1e-3;
    double nearest = 2 * turn;
    int partner = -1;
    for (const Sheet& other : sheets)
    {
        if (!other.isForward)
        {
            continue;
        }
        const double sameAngle = std::clamp(2 * (sheet.blur + other.blur), leastAngle, mostAngle);
        double angle = other.angle - sheet.angle;
        angle += angle <= sameAngle ? turn : 0;
        angle += angle <= sameAngle ? turn : 0;
        if (angle < nearest)
        {
            nearest = angle;
            partner = other.face;
        }
    }
    return partner;
}

/// Of more than two faces at an edge those that bound a solid across it belong together. Seen along the edge,
/// a face that runs along it from low to high vertex has its solid on the side towards smaller angles (faces
/// are turned outwards, counter-clockwise), one that runs back towards larger ones; where all faces are
/// turned inwards it is the other way round. \param rounding of coordinates [m]
void joinAround(const Polyhedron& mesh, EdgeIterator first, EdgeIterator last, FacesTurned turned,
                double rounding, DisjointSets& pieces)
{
    const Vector<3> origin = mesh.vertices[first->low()];
    const Vector<3> whole = mesh.vertices[first->high()] - origin;
    const double length = whole.norm();
    if (!(length > 0))
    {
        return;
    }
    const Vector<3> along = whole / length;
    const Eigen::Matrix3d frame = frameOf(along);
    std::vector<Sheet> sheets;
    for (auto edge = first; edge != last; ++edge)
    {
        const Vector<3> side = sideOf(mesh, *edge, along);
        sheets.push_back({edge->face, std::atan2(frame.col(2).dot(side), frame.col(1).dot(side)),
                          rounding / side.norm(),
                          (edge->from == edge->low()) == (turned == FacesTurned::outwards)});
    }
    for (const Sheet& sheet : sheets)
    {
        const int partner = sheet.isForward ? -1 : partnerOf(sheet, sheets);
        if (partner >= 0)
        {
            pieces.join(sheet.face, partner);
        }
    }
}

/// The faces of each piece, pieces in the order of their first faces.
std::vector<std::vector<int>> facesOfPieces(DisjointSets& pieces, std::size_t faces)
{
    std::vector<std::vector<int>> facesOf;
    std::vector<int> pieceOf(faces, -1);
    for (int face = 0; face < static_cast<int>(faces); ++face)
    {
        const int root = pieces.firstOf(face);
        if (pieceOf[root] < 0)
        {
            pieceOf[root] = static_cast<int>(facesOf.size());
            facesOf.emplace_back();
        }
        facesOf[pieceOf[root]].push_back(face);
    }
    return facesOf;
}

/// Whether a face is one of a heap of solids, touching each other, that enclose a negative volume, as in a
/// model that was mirrored.
std::vector<bool> turnedInside(const Polyhedron& mesh, const std::vector<FaceEdge>& edges)
{
    DisjointSets heaps(mesh.faces.size());
    visitEdges(edges,
               [&](EdgeIterator first, EdgeIterator last)
               {
                   for (auto edge = first; edge != last; ++edge)
                   {
                       heaps.join(first->face, edge->face);
                   }
               });
    std::vector<bool> isTurned(mesh.faces.size());
    for (const std::vector<int>& faces : facesOfPieces(heaps, mesh.faces.size()))
    {
        const bool isNegative = volumeWithin(mesh, faces) < 0;
        for (const int face : faces)
        {
            isTurned[face] = isNegative;
        }
    }
    return isTurned;
}

Polyhedron withFaces(const Polyhedron& mesh, const std::vector<int>& faces, std::vector<int>& newIndex)
{
    Polyhedron piece;
    std::vector<int> used;
    for (const int face : faces)
    {
        used.insert(used.end(), mesh.faces[face].begin(), mesh.faces[face].end());
    }
    std::sort(used.begin(), used.end());
    used.erase(std::unique(used.begin(), used.end()), used.end());
    for (const int vertex : used)
    {
        newIndex[vertex] = static_cast<int>(piece.vertices.size());
        piece.vertices.push_back(mesh.vertices[vertex]);
    }
    for (const int face : faces)
    {
        std::vector<int> corners;
        for (const int vertex : mesh.faces[face])
        {
            corners.push_back(newIndex[vertex]);
        }
        piece.faces.push_back(std::move(corners));
    }
    return piece;
}

} // namespace

Polyhedron welded(const Polyhedron& mesh, double tolerance)
{
    const std::vector<int> nodeOf = weld(mesh.vertices, tolerance);
    Polyhedron result;
    std::vector<int> count;
    std::vector<bool> differs;
    for (std::size_t i = 0; i < nodeOf.size(); ++i)
    {
        const auto node = static_cast<std::size_t>(nodeOf[i]);
        if (node == result.vertices.size())
        {
            result.vertices.push_back(mesh.vertices[i]);
            count.push_back(1);
            differs.push_back(false);
            continue;
        }
        differs[node] = differs[node] || result.vertices[node] / count[node] != mesh.vertices[i];
        result.vertices[node] += mesh.vertices[i];
        ++count[node];
    }
    // Equal ones keep their bits.
    for (std::size_t i = 0; i < nodeOf.size(); ++i)
    {
        const auto node = static_cast<std::size_t>(nodeOf[i]);
        if (count[node] > 0)
        {
            result.vertices[node] =
                differs[node] ? Vector<3>(result.vertices[node] / count[node]) : mesh.vertices[i];
            count[node] = 0;
        }
    }
    for (const std::vector<int>& face : mesh.faces)
    {
        std::vector<int> corners;
        for (const int vertex : face)
        {
            if (corners.empty() || corners.back() != nodeOf[vertex])
            {
                corners.push_back(nodeOf[vertex]);
            }
        }
        while (corners.size() > 1 && corners.front() == corners.back())
        {
            corners.pop_back();
        }
        if (corners.size() >= 3)
        {
            result.faces.push_back(std::move(corners));
        }
    }
    return result;
}

int dropRepeatedFaces(Polyhedron& mesh)
{
    std::set<std::vector<int>> known;
    const std::size_t removed =
        std::erase_if(mesh.faces,
                      [&known](const std::vector<int>& face)
                      {
                          std::vector<int> fromLeast = face;
                          std::rotate(fromLeast.begin(), std::min_element(fromLeast.begin(), fromLeast.end()),
                                      fromLeast.end());
                          return !known.insert(std::move(fromLeast)).second;
                      });
    return static_cast<int>(removed);
}

std::vector<Polyhedron> parted(const Polyhedron& mesh)
{
    DisjointSets joined(mesh.faces.size());
    double largest = 0;
    for (const Vector<3>& vertex : mesh.vertices)
    {
        largest = std::max(largest, vertex.lpNorm<Eigen::Infinity>());
    }
    const std::vector<FaceEdge> edges = sortedEdges(mesh);
    const std::vector<bool> isTurnedInside = turnedInside(mesh, edges);
    visitEdges(edges,
               [&](EdgeIterator first, EdgeIterator last)
               {
                   constexpr int most = 64; // more faces at an edge are of no solids that one builds with
                   if (last - first == 2)
                   {
                       joined.join(first->face, std::next(first)->face);
                   }
                   else if (last - first <= most)
                   {
                       joinAround(mesh, first, last,
                                  isTurnedInside[first->face] ? FacesTurned::inwards : FacesTurned::outwards,
                                  singleDigit * largest, joined);
                   }
               });
    std::vector<Polyhedron> pieces;
    std::vector<int> newIndex(mesh.vertices.size());
    for (const std::vector<int>& faces : facesOfPieces(joined, mesh.faces.size()))
    {
        pieces.push_back(withFaces(mesh, faces, newIndex));
    }
    return pieces;
}

namespace
{

/// Faces of a mesh that have an edge in common, and whether they run along it in the same sense: then one of
/// them is turned.
struct FaceNeighbours
{
    std::vector<std::vector<std::pair<int, bool>>> of; ///< each face: its neighbours, and whether it is so
    bool doAgree = true;                               ///< all of them
};

FaceNeighbours faceNeighbours(const Polyhedron& mesh)
{
    FaceNeighbours neighbours;
    neighbours.of.resize(mesh.faces.size());
    const std::vector<FaceEdge> edges = sortedEdges(mesh);
    visitEdges(edges,
               [&](EdgeIterator first, EdgeIterator last)
               {
                   if (last - first == 2)
                   {
                       const EdgeIterator second = std::next(first);
                       const bool isTurned = first->from == second->from;
                       neighbours.doAgree = neighbours.doAgree && !isTurned;
                       neighbours.of[first->face].emplace_back(second->face, isTurned);
                       neighbours.of[second->face].emplace_back(first->face, isTurned);
                   }
               });
    return neighbours;
}

/// The faces that are connected with one. \param disagrees of each face, whether it is turned against that
/// one; nothing for those that are in no shell yet
std::vector<int> shellFrom(int start, const FaceNeighbours& neighbours,
                           std::vector<std::optional<bool>>& disagrees)
{
    std::vector<int> shell{start};
    disagrees[start] = false;
    for (std::size_t next = 0; next < shell.size(); ++next)
    {
        const int face = shell[next];
        for (const auto& [neighbour, isTurned] : neighbours.of[face])
        {
            if (!disagrees[neighbour])
            {
                disagrees[neighbour] = *disagrees[face] != isTurned;
                shell.push_back(neighbour);
            }
        }
    }
    return shell;
}

void turnFaces(Polyhedron& mesh, const std::vector<int>& faces)
{
    for (const int face : faces)
    {
        std::reverse(mesh.faces[face].begin(), mesh.faces[face].end());
    }
}

/// Turns the faces of a shell, those that disagree with the others or else these, until it holds a volume.
/// \return how many
int turnShell(Polyhedron& mesh, const std::vector<int>& shell,
              const std::vector<std::optional<bool>>& disagrees)
{
    std::vector<int> turned;
    std::vector<int> others;
    for (const int face : shell)
    {
        (*disagrees[face] ? turned : others).push_back(face);
    }
    turnFaces(mesh, turned);
    if (volumeWithin(mesh, shell) < 0)
    {
        turnFaces(mesh, shell);
        turned.swap(others);
    }
    return static_cast<int>(turned.size());
}

} // namespace

int turnOutwards(Polyhedron& mesh)
{
    const FaceNeighbours neighbours = faceNeighbours(mesh);
    if (neighbours.doAgree)
    {
        std::vector<int> all(mesh.faces.size());
        std::iota(all.begin(), all.end(), 0);
        if (all.empty() || !(volumeWithin(mesh, all) < 0))
        {
            return 0;
        }
        turnFaces(mesh, all);
        return static_cast<int>(all.size());
    }
    int turned = 0;
    std::vector<std::optional<bool>> disagrees(mesh.faces.size());
    for (int start = 0; start < static_cast<int>(mesh.faces.size()); ++start)
    {
        if (!disagrees[start])
        {
            turned += turnShell(mesh, shellFrom(start, neighbours, disagrees), disagrees);
        }
    }
    return turned;
}

} // namespace drystone
