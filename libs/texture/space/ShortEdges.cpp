// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Corners of all solids are numbered together, those at the ends of short edges united, and the faces built
/// anew.
#include "texture/space/ShortEdges.h"

#include "core/DisjointSets.h"
#include "geometry/BroadPhase.h"
#include "geometry/space/PolyhedronFault.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <map>
#include <optional>
#include <set>

namespace drystone
{

namespace
{

/// Solids with common corners.
struct Complex
{
    std::vector<Vector<3>> corners;
    std::vector<std::vector<std::vector<int>>> solids; ///< faces of each, by corner
};

/// Corners that are this near are the same but for rounding [m].
double sameIn(const Vector<3>& size)
{
    return 1e-9 * size.maxCoeff();
}

/// A face by the numbers that its corners have now: neighbours with one number are one corner. Of fewer than
/// three there is no face left.
std::vector<int> renumbered(const std::vector<int>& face, const std::vector<int>& numbers, int first = 0)
{
    std::vector<int> corners;
    for (const int corner : face)
    {
        const int number = numbers[first + corner];
        if (corners.empty() || corners.back() != number)
        {
            corners.push_back(number);
        }
    }
    while (corners.size() > 1 && corners.back() == corners.front())
    {
        corners.pop_back();
    }
    return corners;
}

/// Corners of different cells that are the same but for rounding get one number.
Complex complexOf(const std::vector<Polyhedron>& cells, double same)
{
    std::vector<Vector<3>> all;
    std::vector<Box<3>> boxes;
    for (const Polyhedron& cell : cells)
    {
        for (const Vector<3>& vertex : cell.vertices)
        {
            all.push_back(vertex);
            boxes.push_back(enlarged<3>({vertex, vertex}, same / 2));
        }
    }
    DisjointSets clusters(all.size());
    for (const auto& [one, other] : findMeetingPairs<3>(boxes))
    {
        clusters.join(one, other);
    }
    Complex complex;
    std::vector<int> numbers(all.size(), -1);
    for (std::size_t i = 0; i < all.size(); ++i)
    {
        const int root = clusters.firstOf(static_cast<int>(i)); // not above i
        if (numbers[root] < 0)
        {
            numbers[root] = static_cast<int>(complex.corners.size());
            complex.corners.push_back(all[root]);
        }
        numbers[i] = numbers[root];
    }
    int first = 0;
    for (const Polyhedron& cell : cells)
    {
        std::vector<std::vector<int>> faces;
        for (const std::vector<int>& face : cell.faces)
        {
            std::vector<int> numbered = renumbered(face, numbers, first);
            if (numbered.size() >= 3)
            {
                faces.push_back(std::move(numbered));
            }
        }
        complex.solids.push_back(std::move(faces));
        first += static_cast<int>(cell.vertices.size());
    }
    return complex;
}

/// Where the clusters are: the mean of their corners, but on the sides of the box that they touch.
std::vector<Vector<3>> clusterPlaces(const Complex& complex, DisjointSets& clusters, const Vector<3>& size,
                                     double same)
{
    std::vector<Vector<3>> places(complex.corners.size(), Vector<3>::Zero());
    std::vector<int> counts(complex.corners.size(), 0);
    std::vector<Box<3>> extents(complex.corners.size());
    for (std::size_t i = 0; i < complex.corners.size(); ++i)
    {
        const int root = clusters.firstOf(static_cast<int>(i));
        places[root] += complex.corners[i];
        ++counts[root];
        extend<3>(extents[root], complex.corners[i]);
    }
    for (std::size_t i = 0; i < places.size(); ++i)
    {
        if (counts[i] < 2)
        {
            continue; // a corner alone keeps its digits
        }
        places[i] /= counts[i];
        for (int axis = 0; axis < 3; ++axis)
        {
            if (extents[i].lower[axis] < same)
            {
                places[i][axis] = 0;
            }
            else if (extents[i].upper[axis] > size[axis] - same)
            {
                places[i][axis] = size[axis];
            }
        }
    }
    return places;
}

Vector<3> areaOf(const std::vector<int>& face, const std::vector<Vector<3>>& places)
{
    Vector<3> twice = Vector<3>::Zero();
    for (std::size_t i = 1; i + 1 < face.size(); ++i)
    {
        twice += (places[face[i]] - places[face[0]]).cross(places[face[i + 1]] - places[face[0]]);
    }
    return twice / 2;
}

/// A face as it is, or in triangles where it is not plane; nothing where it folds over. The triangles are a
/// fan from the corner with the lowest number for which all are turned as the whole is: the same seen from
/// both sides.
std::optional<std::vector<std::vector<int>>> planeParts(const std::vector<int>& face,
                                                        const std::vector<Vector<3>>& places, double flat)
{
    const Vector<3> normal = areaOf(face, places).normalized();
    Vector<3> centre = Vector<3>::Zero();
    for (const int corner : face)
    {
        centre += places[corner] / static_cast<double>(face.size());
    }
    if (std::all_of(face.begin(), face.end(),
                    [&](int corner) { return std::abs(normal.dot(places[corner] - centre)) <= flat; }))
    {
        return {{face}};
    }
    std::vector<int> apexes = face;
    std::sort(apexes.begin(), apexes.end());
    for (const int apex : apexes)
    {
        std::vector<int> turned = face;
        std::rotate(turned.begin(), std::find(turned.begin(), turned.end(), apex), turned.end());
        std::vector<std::vector<int>> triangles;
        bool isFolded = false;
        for (std::size_t i = 1; i + 1 < turned.size(); ++i)
        {
            triangles.push_back({turned[0], turned[i], turned[i + 1]});
            const Vector<3> area = areaOf(triangles.back(), places);
            isFolded = isFolded || area.dot(normal) <= 0.3 * area.norm() || area.norm() <= flat * flat;
        }
        if (!isFolded)
        {
            return triangles;
        }
    }
    return std::nullopt;
}

std::vector<int> cornersOf(const std::vector<std::vector<int>>& faces)
{
    std::vector<int> corners;
    for (const std::vector<int>& face : faces)
    {
        corners.insert(corners.end(), face.begin(), face.end());
    }
    return corners;
}

using Edges = std::set<std::pair<int, int>>; ///< from one corner to the next of a face

/// The edges of faces; nothing where two faces have one in the same direction.
std::optional<Edges> edgesOf(const std::vector<std::vector<int>>& faces)
{
    Edges edges;
    for (const std::vector<int>& face : faces)
    {
        for (std::size_t i = 0; i < face.size(); ++i)
        {
            if (!edges.emplace(face[i], face[(i + 1) % face.size()]).second)
            {
                return std::nullopt;
            }
        }
    }
    return edges;
}

/// A solid of some of the corners, numbered in the order in which its faces have them.
Polyhedron solidOf(std::vector<std::vector<int>> faces, const std::vector<Vector<3>>& places)
{
    Polyhedron solid;
    std::map<int, int> numbers;
    for (std::vector<int>& face : faces)
    {
        for (int& corner : face)
        {
            const auto [number, isNew] = numbers.emplace(corner, static_cast<int>(numbers.size()));
            if (isNew)
            {
                solid.vertices.push_back(places[corner]);
            }
            corner = number->second;
        }
    }
    solid.faces = std::move(faces);
    return solid;
}

/// One solid after the corners have been united; nothing when it is none any more. \param culprits the
/// corners of the face at fault, before they were united, or of all where no single face is
std::optional<Polyhedron> rebuilt(const std::vector<std::vector<int>>& faces,
                                  const std::vector<Vector<3>>& places, const std::vector<int>& roots,
                                  double flat, std::vector<int>& culprits)
{
    std::vector<std::vector<int>> parts;
    for (const std::vector<int>& face : faces)
    {
        const std::vector<int> corners = renumbered(face, roots);
        if (corners.size() < 3)
        {
            continue;
        }
        const bool isPinched = std::set<int>(corners.begin(), corners.end()).size() != corners.size();
        const auto split = isPinched ? std::nullopt : planeParts(corners, places, flat);
        if (!split)
        {
            culprits = face;
            return std::nullopt;
        }
        parts.insert(parts.end(), split->begin(), split->end());
    }
    culprits = cornersOf(faces);
    const std::optional<Edges> edges = edgesOf(parts);
    if (!edges)
    {
        return std::nullopt;
    }
    const bool isClosed = std::all_of(edges->begin(), edges->end(),
                                      [&](const auto& edge) {
                                          return edges->contains({edge.second, edge.first});
                                      });
    Polyhedron solid = solidOf(std::move(parts), places);
    // Euler's formula for a solid without holes: two surfaces that hang together at a corner are none.
    const bool isOne = solid.vertices.size() + solid.faces.size() == edges->size() / 2 + 2;
    // Faces may pass through each other where corners have moved past them.
    if (!isClosed || !isOne || findFault(solid))
    {
        return std::nullopt;
    }
    return solid;
}

/// Where the corners have gone.
struct Shrunk
{
    std::vector<int> roots;        ///< cluster of each corner, by its lowest corner
    std::vector<Vector<3>> places; ///< of clusters, at their roots

    bool isSameAt(int corner, const Shrunk& other) const
    {
        return roots[corner] == other.roots[corner]
               && places[roots[corner]] == other.places[other.roots[corner]];
    }
};

/// The ends of short edges together, but for corners that stay.
Shrunk shrink(const Complex& complex, const std::vector<char>& isFixed, const Vector<3>& size, double least)
{
    DisjointSets clusters(complex.corners.size());
    for (const std::vector<std::vector<int>>& faces : complex.solids)
    {
        for (const std::vector<int>& face : faces)
        {
            for (std::size_t k = 0; k < face.size(); ++k)
            {
                const int from = face[k];
                const int to = face[(k + 1) % face.size()];
                if (isFixed[from] == 0 && isFixed[to] == 0
                    && (complex.corners[to] - complex.corners[from]).norm() < least)
                {
                    clusters.join(from, to);
                }
            }
        }
    }
    Shrunk shrunk{{}, clusterPlaces(complex, clusters, size, sameIn(size))};
    for (std::size_t i = 0; i < complex.corners.size(); ++i)
    {
        shrunk.roots.push_back(clusters.firstOf(static_cast<int>(i)));
    }
    return shrunk;
}

/// Lets the corners of a solid that is none stay: those of the face at fault or, where they do already, all.
/// \return whether any did not yet
bool keepCorners(std::vector<char>& isFixed, const std::vector<int>& culprits, const std::vector<int>& all)
{
    for (const std::vector<int>& corners : {culprits, all})
    {
        if (std::any_of(corners.begin(), corners.end(), [&](int corner) { return isFixed[corner] == 0; }))
        {
            for (const int corner : corners)
            {
                isFixed[corner] = 1;
            }
            return true;
        }
    }
    return false;
}

} // namespace

std::vector<Polyhedron> withoutShortEdges(const std::vector<Polyhedron>& cells, const Vector<3>& size,
                                          double least)
{
    if (least <= 0)
    {
        return cells;
    }
    const Complex complex = complexOf(cells, sameIn(size));
    std::vector<char> isFixed(complex.corners.size(), 0); // corners that are not united with others
    std::vector<std::optional<Polyhedron>> solids(cells.size());
    Shrunk last;
    for (bool isSound = false; !isSound;)
    {
        const Shrunk shrunk = shrink(complex, isFixed, size, least);
        isSound = true;
        for (std::size_t i = 0; i < cells.size(); ++i)
        {
            const std::vector<int> corners = cornersOf(complex.solids[i]);
            if (solids[i]
                && std::all_of(corners.begin(), corners.end(),
                               [&](int corner) { return shrunk.isSameAt(corner, last); }))
            {
                continue;
            }
            std::vector<int> culprits;
            solids[i] = rebuilt(complex.solids[i], shrunk.places, shrunk.roots, sameIn(size), culprits);
            if (!solids[i] && keepCorners(isFixed, culprits, corners))
            {
                isSound = false;
            }
        }
        last = shrunk;
    }
    std::vector<Polyhedron> all;
    for (std::size_t i = 0; i < cells.size(); ++i)
    {
        all.push_back(solids[i] ? std::move(*solids[i]) : cells[i]); // as it was, when all its corners are
    }
    return all;
}

} // namespace drystone
