// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Unites edges that face each other into lines; lines and corners are fitted in turn by least squares.
#include "contact/plane/FaceLines.h"

#include "core/DisjointSets.h"
#include "geometry/BroadPhase.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>

namespace drystone
{
namespace
{

/// Where three lines and more meet at a corner, lines and corners are fitted to each other in turn.
constexpr int mostRounds = 100;

/// A straight line: the places x with normal (x - point) = 0.
struct Line
{
    Vector<2> point = Vector<2>::Zero();
    Vector<2> normal = Vector<2>::Zero();
};

double distanceFrom(const Line& line, const Vector<2>& place)
{
    return (place - line.point).dot(line.normal);
}

/// The line with the least squares of distances from places.
Line fittedLine(const std::vector<Vector<2>>& places)
{
    Line line;
    for (const Vector<2>& place : places)
    {
        line.point += (place - places.front()) / static_cast<double>(places.size());
    }
    line.point += places.front();
    double xx = 0;
    double xy = 0;
    double yy = 0;
    for (const Vector<2>& place : places)
    {
        const Vector<2> arm = place - line.point;
        xx += arm.x() * arm.x();
        xy += arm.x() * arm.y();
        yy += arm.y() * arm.y();
    }
    const double angle = 0.5 * std::atan2(2 * xy, xx - yy);
    line.normal = {-std::sin(angle), std::cos(angle)};
    return line;
}

/// The place nearest to `from` that is on all the lines; with more than two, or nearly parallel ones, the
/// least squares of the distances.
Vector<2> placeOn(const std::vector<Line>& lines, const Vector<2>& from)
{
    Eigen::Matrix2d normals = Eigen::Matrix2d::Zero();
    Vector<2> right = Vector<2>::Zero();
    for (const Line& line : lines)
    {
        normals += line.normal * line.normal.transpose();
        right -= distanceFrom(line, from) * line.normal;
    }
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> eigen(normals);
    Vector<2> move = Vector<2>::Zero();
    for (int i = 0; i < 2; ++i)
    {
        // Lines within some 0.01 rad of each other are taken for parallel.
        if (eigen.eigenvalues()[i] > 1e-4)
        {
            const Vector<2> direction = eigen.eigenvectors().col(i);
            move += direction.dot(right) / eigen.eigenvalues()[i] * direction;
        }
    }
    return from + move;
}

/// Visits the corners of an edge, those between its ends too, as indices into CornerNodes::ofCorner.
template<class Visit>
void visitCorners(const Assembly<2>& assembly, const CornerNodes& nodes, const OutlineEdge& edge,
                  const Visit& visit)
{
    const std::size_t size = assembly.blocks[edge.block].outline.size();
    const std::size_t begin = nodes.first[edge.block];
    for (std::size_t i = static_cast<std::size_t>(edge.first);; i = (i + 1) % size)
    {
        visit(nodes.ofCorner[begin + i]);
        if (i == static_cast<std::size_t>(edge.last))
        {
            break;
        }
    }
}

Line lineThrough(const std::vector<int>& onLine, const std::vector<Vector<2>>& place)
{
    std::vector<Vector<2>> places;
    places.reserve(onLine.size());
    for (const int node : onLine)
    {
        places.push_back(place[node]);
    }
    return fittedLine(places);
}

/// The corners of all blocks in one row.
struct AllCorners
{
    std::vector<Vector<2>> place;
    std::vector<int> owner; ///< block of each
};

/// Corners of different blocks that are within reach of each other.
DisjointSets groupsOf(const AllCorners& corners, double reach)
{
    std::vector<BoundingBox> boxes;
    for (const Vector<2>& corner : corners.place)
    {
        boxes.push_back(enlarged({corner, corner}, reach / 2));
    }
    DisjointSets groups(corners.place.size());
    for (const auto& [one, other] : findMeetingPairs(boxes))
    {
        if (corners.owner[one] != corners.owner[other]
            && (corners.place[one] - corners.place[other]).norm() <= reach)
        {
            groups.join(one, other);
        }
    }
    return groups;
}

/// Makes a group of corners one node, or a node each where two of them are of one block: these never become
/// one, not even by way of a third.
void addNodes(const std::vector<int>& group, const AllCorners& corners, CornerNodes& nodes)
{
    std::vector<int> owners;
    for (const int corner : group)
    {
        owners.push_back(corners.owner[corner]);
    }
    std::sort(owners.begin(), owners.end());
    const bool isOne = std::adjacent_find(owners.begin(), owners.end()) == owners.end();
    Vector<2> sum = Vector<2>::Zero();
    for (const int corner : group)
    {
        sum += corners.place[corner] - corners.place[group.front()];
        nodes.ofCorner[corner] = static_cast<int>(nodes.place.size());
        if (!isOne)
        {
            nodes.place.push_back(corners.place[corner]);
        }
    }
    if (isOne && !group.empty())
    {
        nodes.place.push_back(corners.place[group.front()] + sum / static_cast<double>(group.size()));
    }
}

/// The faces, edges with a neighbour, that end at each node.
std::vector<std::vector<int>> facesAtNodes(const CornerNodes& nodes, const std::vector<OutlineEdge>& edges,
                                           const std::vector<char>& isFace)
{
    std::vector<std::vector<int>> facesAt(nodes.place.size());
    for (std::size_t edge = 0; edge < edges.size(); ++edge)
    {
        if (isFace[edge])
        {
            const std::size_t begin = nodes.first[edges[edge].block];
            for (const int end : {edges[edge].first, edges[edge].last})
            {
                facesAt[nodes.ofCorner[begin + static_cast<std::size_t>(end)]].push_back(
                    static_cast<int>(edge));
            }
        }
    }
    return facesAt;
}

/// Joins those of some faces at a node that go on straight.
void joinStraight(const std::vector<int>& faces, const std::vector<OutlineEdge>& edges, double straight,
                  DisjointSets& groups)
{
    for (std::size_t i = 0; i < faces.size(); ++i)
    {
        for (std::size_t j = 0; j < i; ++j)
        {
            const Vector<2> a = edges[faces[i]].to - edges[faces[i]].from;
            const Vector<2> b = edges[faces[j]].to - edges[faces[j]].from;
            if (std::abs(cross(a, b)) <= straight * std::max(a.norm(), b.norm()))
            {
                groups.join(faces[i], faces[j]);
            }
        }
    }
}

} // namespace

CornerNodes findCornerNodes(const Assembly<2>& assembly, double reach)
{
    CornerNodes nodes;
    nodes.first.push_back(0);
    AllCorners corners;
    for (std::size_t block = 0; block < assembly.blocks.size(); ++block)
    {
        for (const Vector<2>& corner : assembly.blocks[block].outline)
        {
            corners.place.push_back(corner);
            corners.owner.push_back(static_cast<int>(block));
        }
        nodes.first.push_back(corners.place.size());
    }
    DisjointSets groups = groupsOf(corners, reach);
    std::vector<std::vector<int>> members(corners.place.size());
    for (std::size_t corner = 0; corner < members.size(); ++corner)
    {
        members[groups.firstOf(static_cast<int>(corner))].push_back(static_cast<int>(corner));
    }
    nodes.ofCorner.resize(members.size());
    for (const std::vector<int>& group : members)
    {
        addNodes(group, corners, nodes);
    }
    return nodes;
}

FaceLines findFaceLines(const Assembly<2>& assembly, const CornerNodes& nodes,
                        const std::vector<OutlineEdge>& edges, const std::vector<FacingPiece>& pieces,
                        double straight)
{
    DisjointSets groups(edges.size());
    std::vector<char> isFace(edges.size(), false);
    for (const FacingPiece& piece : pieces)
    {
        groups.join(piece.edge, piece.neighbourEdge);
        isFace[piece.edge] = isFace[piece.neighbourEdge] = true;
    }
    for (const std::vector<int>& faces : facesAtNodes(nodes, edges, isFace))
    {
        joinStraight(faces, edges, straight, groups);
    }
    FaceLines result;
    result.nodesOf.resize(edges.size());
    for (std::size_t edge = 0; edge < edges.size(); ++edge)
    {
        if (isFace[edge])
        {
            visitCorners(assembly, nodes, edges[edge],
                         [&](int node)
                         { result.nodesOf[groups.firstOf(static_cast<int>(edge))].push_back(node); });
        }
    }
    result.linesAt.resize(nodes.place.size());
    for (std::size_t line = 0; line < result.nodesOf.size(); ++line)
    {
        std::vector<int>& onLine = result.nodesOf[line];
        std::sort(onLine.begin(), onLine.end());
        onLine.erase(std::unique(onLine.begin(), onLine.end()), onLine.end());
        for (const int node : onLine)
        {
            result.linesAt[node].push_back(static_cast<int>(line));
        }
    }
    return result;
}

void removeCurves(FaceLines& faces, const std::vector<Vector<2>>& place, double tolerance)
{
    for (std::size_t line = 0; line < faces.nodesOf.size(); ++line)
    {
        std::vector<int>& onLine = faces.nodesOf[line];
        if (onLine.empty())
        {
            continue;
        }
        const Line fitted = lineThrough(onLine, place);
        if (std::any_of(onLine.begin(), onLine.end(),
                        [&](int node) { return std::abs(distanceFrom(fitted, place[node])) > tolerance; }))
        {
            for (const int node : onLine)
            {
                std::erase(faces.linesAt[node], static_cast<int>(line));
            }
            onLine.clear();
        }
    }
}

void fitLines(const FaceLines& faces, std::vector<Vector<2>>& place, double exact)
{
    std::vector<Line> lines(faces.nodesOf.size());
    std::vector<Line> here;
    double farthest = std::numeric_limits<double>::max();
    for (int round = 0; round < mostRounds && farthest > exact; ++round)
    {
        for (std::size_t line = 0; line < lines.size(); ++line)
        {
            if (!faces.nodesOf[line].empty())
            {
                lines[line] = lineThrough(faces.nodesOf[line], place);
            }
        }
        farthest = 0;
        for (std::size_t node = 0; node < place.size(); ++node)
        {
            here.clear();
            double off = 0;
            for (const int line : faces.linesAt[node])
            {
                here.push_back(lines[line]);
                off = std::max(off, std::abs(distanceFrom(lines[line], place[node])));
            }
            if (off > exact)
            {
                place[node] = placeOn(here, place[node]);
                for (const Line& line : here)
                {
                    farthest = std::max(farthest, std::abs(distanceFrom(line, place[node])));
                }
            }
        }
    }
}

} // namespace drystone
