// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The edges of a mesh with the faces at each: what parting, turning and merging need.
#pragma once

#include "geometry/space/Polyhedron.h"

#include <algorithm>
#include <tuple>
#include <vector>

namespace drystone
{

/// An edge of a face, from the vertex `from` to the vertex `to` in the order of the face.
struct FaceEdge
{
    int from = -1;
    int to = -1;
    int face = -1;

    int low() const { return std::min(from, to); }
    int high() const { return std::max(from, to); }
};

/// Into a list of edges.
using EdgeIterator = std::vector<FaceEdge>::const_iterator;

inline bool areSameEdge(const FaceEdge& a, const FaceEdge& b)
{
    return a.low() == b.low() && a.high() == b.high();
}

/// All edges of all faces, those between the same vertices one after the other, by their faces.
inline std::vector<FaceEdge> sortedEdges(const Polyhedron& mesh)
{
    std::vector<FaceEdge> edges;
    edges.reserve(4 * mesh.faces.size());
    for (std::size_t f = 0; f < mesh.faces.size(); ++f)
    {
        const std::vector<int>& face = mesh.faces[f];
        for (std::size_t i = 0; i < face.size(); ++i)
        {
            edges.push_back({face[i], face[(i + 1) % face.size()], static_cast<int>(f)});
        }
    }
    std::sort(edges.begin(), edges.end(),
              [](const FaceEdge& a, const FaceEdge& b) {
                  return std::tuple(a.low(), a.high(), a.face, a.from)
                         < std::tuple(b.low(), b.high(), b.face, b.from);
              });
    return edges;
}

/// Calls visit(first, last) for the edges between each pair of vertices. \param edges as sortedEdges gives
/// them
template<class Visit>
void visitEdges(const std::vector<FaceEdge>& edges, const Visit& visit)
{
    for (auto first = edges.begin(); first != edges.end();)
    {
        auto last = first;
        while (last != edges.end() && areSameEdge(*first, *last))
        {
            ++last;
        }
        visit(first, last);
        first = last;
    }
}

} // namespace drystone
