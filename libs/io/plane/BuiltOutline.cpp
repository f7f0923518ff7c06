// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Sorts edges by their left ends, so that each is compared with few; what none covers is left.
#include "io/plane/BuiltOutline.h"

#include "geometry/PolygonShape.h"

#include <algorithm>

namespace drystone
{
namespace
{

/// An edge, counter-clockwise round its block, with the corners of its box.
struct Edge
{
    Vector<2> from;
    Vector<2> to;
    Vector<2> lower;
    Vector<2> upper;
};

/// In the order of the free blocks.
std::vector<Edge> edgesOf(const Assembly<2>& assembly)
{
    std::vector<Edge> edges;
    for (const Block<2>& block : assembly.blocks)
    {
        for (std::size_t i = 0; block.support < 0 && i < block.outline.size(); ++i)
        {
            const Vector<2>& from = block.outline[i];
            const Vector<2>& to = block.outline[(i + 1) % block.outline.size()];
            edges.push_back({from, to, from.cwiseMin(to), from.cwiseMax(to)});
        }
    }
    return edges;
}

/// In ascending order of their left ends, with the widest extent of any.
struct SortedEdges
{
    std::vector<Edge> edges;
    double widest = 0;
};

SortedEdges byLeftEnds(std::vector<Edge> edges)
{
    std::sort(edges.begin(), edges.end(),
              [](const Edge& a, const Edge& b) { return a.lower.x() < b.lower.x(); });
    double widest = 0;
    for (const Edge& edge : edges)
    {
        widest = std::max(widest, edge.upper.x() - edge.lower.x());
    }
    return {std::move(edges), widest};
}

/// The parts of an edge that lie on edges of other blocks, as shares of it from its beginning, in order.
std::vector<std::pair<double, double>> coveredParts(const SortedEdges& all, const Edge& edge,
                                                    double tolerance)
{
    const Vector<2> along = edge.to - edge.from;
    const double length = along.norm();
    const auto first =
        std::lower_bound(all.edges.begin(), all.edges.end(), edge.lower.x() - all.widest - tolerance,
                         [](const Edge& other, double x) { return other.lower.x() < x; });
    std::vector<std::pair<double, double>> covered;
    for (auto other = first; other != all.edges.end() && other->lower.x() <= edge.upper.x() + tolerance;
         ++other)
    {
        if (other->lower.y() > edge.upper.y() + tolerance || other->upper.y() < edge.lower.y() - tolerance
            || along.dot(other->to - other->from) >= 0) // neighbours run in the opposite direction
        {
            continue;
        }
        const auto distance = [&](const Vector<2>& p)
        { return std::abs(cross(along, p - edge.from)) / length; };
        if (distance(other->from) <= tolerance && distance(other->to) <= tolerance)
        {
            covered.emplace_back(along.dot(other->to - edge.from) / (length * length),
                                 along.dot(other->from - edge.from) / (length * length));
        }
    }
    std::sort(covered.begin(), covered.end());
    return covered;
}

} // namespace

std::vector<OutlinePiece> builtOutline(const Assembly<2>& assembly, double tolerance)
{
    const std::vector<Edge> edges = edgesOf(assembly);
    const SortedEdges sorted = byLeftEnds(edges);
    std::vector<OutlinePiece> pieces;
    for (const Edge& edge : edges)
    {
        const Vector<2> along = edge.to - edge.from;
        const double length = along.norm();
        if (length <= tolerance)
        {
            continue;
        }
        double position = 0;
        const auto addUntil = [&](double end)
        {
            if ((end - position) * length > tolerance)
            {
                pieces.push_back({edge.from + position * along, edge.from + end * along});
            }
        };
        for (const auto& [begin, end] : coveredParts(sorted, edge, tolerance))
        {
            addUntil(std::min(begin, 1.0));
            position = std::max(position, end);
        }
        addUntil(1);
    }
    return pieces;
}

} // namespace drystone
