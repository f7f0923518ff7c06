// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Faces of joints are put on common lines; in space they are counted.
#include "contact/JointClosure.h"

#include "assembly/WrittenDigits.h"
#include "contact/AlmostJoints.h"
#include "contact/Facing.h"
#include "core/Log.h"
#include "geometry/BroadPhase.h"
#include "geometry/PolygonShape.h"

#include <Eigen/Dense>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace drystone
{

namespace
{

/// Relative to the mean block size.
constexpr double usualTolerance = 1e-6;
constexpr double coarsestRounding = 1e-3;

/// Units of the last digit by which faces that were meant to meet may be apart: 1.41, in space 1.73, and a
/// little.
template<int Dim>
constexpr double roundingUnits = Dim == 2 ? 1.5 : 1.8;

/// No corner moves farther than this many tolerances.
constexpr double farthestMove = 5;

/// Where three lines and more meet at a corner, lines and corners are fitted to each other in turn.
constexpr int mostRounds = 100;

/// Groups of things that belong together.
class Groups
{
public:
    explicit Groups(std::size_t count) : parent(count) { std::iota(parent.begin(), parent.end(), 0); }

    int of(int thing)
    {
        while (parent[thing] != thing)
        {
            parent[thing] = parent[parent[thing]];
            thing = parent[thing];
        }
        return thing;
    }
    void unite(int one, int other) { parent[of(one)] = of(other); }

private:
    std::vector<int> parent;
};

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

/// All corners of an assembly in one row, those that coincide as one node.
struct Nodes
{
    std::vector<std::size_t> first; ///< block b has the corners first[b] to first[b + 1]
    std::vector<int> ofCorner;      ///< node of each corner
    std::vector<Vector<2>> place;   ///< of each node [m]
};

/// \param reach distance up to which corners of different blocks coincide [m]
Nodes findNodes(const Assembly<2>& assembly, double reach)
{
    Nodes nodes;
    nodes.first.push_back(0);
    std::vector<Vector<2>> corners;
    std::vector<int> owner;
    std::vector<BoundingBox> boxes;
    for (std::size_t block = 0; block < assembly.blocks.size(); ++block)
    {
        for (const Vector<2>& corner : assembly.blocks[block].outline)
        {
            corners.push_back(corner);
            owner.push_back(static_cast<int>(block));
            boxes.push_back(enlarged({corner, corner}, reach / 2));
        }
        nodes.first.push_back(corners.size());
    }
    Groups groups(corners.size());
    for (const auto& [one, other] : findMeetingPairs(boxes))
    {
        if (owner[one] != owner[other] && (corners[one] - corners[other]).norm() <= reach)
        {
            groups.unite(one, other);
        }
    }
    std::vector<std::vector<int>> members(corners.size());
    for (std::size_t corner = 0; corner < corners.size(); ++corner)
    {
        members[groups.of(static_cast<int>(corner))].push_back(static_cast<int>(corner));
    }
    nodes.ofCorner.resize(corners.size());
    for (const std::vector<int>& group : members)
    {
        // Corners of one block never become one, not even by way of a third.
        std::vector<int> owners;
        for (const int corner : group)
        {
            owners.push_back(owner[corner]);
        }
        std::sort(owners.begin(), owners.end());
        const bool isOne = std::adjacent_find(owners.begin(), owners.end()) == owners.end();
        Vector<2> sum = Vector<2>::Zero();
        for (const int corner : group)
        {
            sum += corners[corner] - corners[group.front()];
            nodes.ofCorner[corner] = static_cast<int>(nodes.place.size());
            if (!isOne)
            {
                nodes.place.push_back(corners[corner]);
            }
        }
        if (isOne && !group.empty())
        {
            nodes.place.push_back(corners[group.front()] + sum / static_cast<double>(group.size()));
        }
    }
    return nodes;
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

/// Lines through the faces of joints, and the nodes on them.
struct Faces
{
    std::vector<std::vector<int>> nodesOf; ///< of each line; empty: no line
    std::vector<std::vector<int>> linesAt; ///< of each node
};

/// Visits the corners of an edge, those between its ends too, as indices into Nodes::ofCorner.
template<class Visit>
void visitCorners(const Assembly<2>& assembly, const Nodes& nodes, const OutlineEdge& edge,
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

/// One line for all edges that face each other, and for those of them that go on straight at a node.
Faces findFaces(const Assembly<2>& assembly, const Nodes& nodes, const std::vector<OutlineEdge>& edges,
                const std::vector<FacingPiece>& pieces, double straight)
{
    Groups groups(edges.size());
    std::vector<char> isFace(edges.size(), false);
    for (const FacingPiece& piece : pieces)
    {
        groups.unite(piece.edge, piece.neighbourEdge);
        isFace[piece.edge] = isFace[piece.neighbourEdge] = true;
    }
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
    for (const std::vector<int>& faces : facesAt)
    {
        for (std::size_t i = 0; i < faces.size(); ++i)
        {
            for (std::size_t j = 0; j < i; ++j)
            {
                const Vector<2> a = edges[faces[i]].to - edges[faces[i]].from;
                const Vector<2> b = edges[faces[j]].to - edges[faces[j]].from;
                if (std::abs(cross(a, b)) <= straight * std::max(a.norm(), b.norm()))
                {
                    groups.unite(faces[i], faces[j]);
                }
            }
        }
    }
    Faces result;
    result.nodesOf.resize(edges.size());
    for (std::size_t edge = 0; edge < edges.size(); ++edge)
    {
        if (isFace[edge])
        {
            visitCorners(assembly, nodes, edges[edge],
                         [&](int node)
                         { result.nodesOf[groups.of(static_cast<int>(edge))].push_back(node); });
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

/// Takes away lines that their corners are not on, as where faces follow a curve.
void removeCurves(Faces& faces, const std::vector<Vector<2>>& place, double tolerance)
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

/// Moves nodes onto their lines, and lines onto their nodes, until all are where they belong.
void fit(const Faces& faces, std::vector<Vector<2>>& place, double exact)
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

/// The corners of a block [m].
const Polygon& cornersOf(const Block<2>& block)
{
    return block.outline;
}
const std::vector<Vector<3>>& cornersOf(const Block<3>& block)
{
    return block.shape.vertices;
}

/// What rounding in double precision leaves between faces that meet [m].
template<int Dim>
double exactness(const Assembly<Dim>& assembly, double size)
{
    double extent = 0;
    for (const Block<Dim>& block : assembly.blocks)
    {
        for (const Vector<Dim>& corner : cornersOf(block))
        {
            extent = std::max(extent, corner.template lpNorm<Eigen::Infinity>());
        }
    }
    return std::max(1e-12 * size, 64 * std::numeric_limits<double>::epsilon() * extent);
}

} // namespace

template<int Dim>
JointTolerance jointTolerance(const Assembly<Dim>& assembly)
{
    const double size = meanBlockSize(assembly);
    JointTolerance tolerance;
    tolerance.rounding = writtenRounding(assembly);
    tolerance.distance = assembly.jointTolerance.value_or(usualTolerance * size);
    tolerance.oblique = assembly.jointTolerance.value_or(
        std::clamp(roundingUnits<Dim> * tolerance.rounding, usualTolerance * size, coarsestRounding * size));
    return tolerance;
}

void closeJoints(Assembly<2>& assembly)
{
    const JointTolerance tolerance = jointTolerance(assembly);
    assembly.closure = {0, 0, tolerance.oblique, tolerance.distance, tolerance.rounding};
    const double size = meanBlockSize(assembly);
    if (!(size > 0) || !std::isfinite(size))
    {
        return;
    }
    FacingTolerance facing;
    facing.distance = tolerance.distance;
    facing.oblique = tolerance.oblique;
    // As findContactPoints has it, or what the tolerance takes for straight and for a point.
    const bool isUsual = tolerance.oblique <= usualTolerance * size;
    facing.straight = isUsual ? usualTolerance * size / 2 : tolerance.oblique;
    facing.leastLength = isUsual ? usualTolerance * size : 2 * tolerance.oblique;
    const std::vector<FacingPiece> pieces = findFacingPieces(assembly, facing);
    const double exact = exactness(assembly, size);
    const auto isOpen = [exact](const FacingPiece& piece) { return openness(piece) > exact; };
    const auto open = std::count_if(pieces.begin(), pieces.end(), isOpen);
    if (open == 0)
    {
        return;
    }
    const double reach = std::max(tolerance.distance, tolerance.oblique);
    Nodes nodes = findNodes(assembly, reach);
    Faces faces = findFaces(assembly, nodes, outlineEdges(assembly, facing), pieces, 2 * reach);
    removeCurves(faces, nodes.place, reach);
    fit(faces, nodes.place, exact);

    Assembly<2> closed = assembly;
    for (std::size_t block = 0; block < closed.blocks.size(); ++block)
    {
        Polygon& outline = closed.blocks[block].outline;
        bool isMoved = false;
        for (std::size_t i = 0; i < outline.size(); ++i)
        {
            const int node = nodes.ofCorner[nodes.first[block] + i];
            const double move = (nodes.place[node] - outline[i]).norm();
            if (!faces.linesAt[node].empty() && move > exact)
            {
                if (!(move <= farthestMove * reach))
                {
                    return;
                }
                outline[i] = nodes.place[node];
                isMoved = true;
            }
        }
        if (isMoved && !outlineFault(outline).empty())
        {
            return;
        }
    }
    closed.closure.joints = static_cast<int>(open);
    for (const FacingPiece& piece : pieces)
    {
        closed.closure.largest = std::max(closed.closure.largest, openness(piece));
    }
    assembly = std::move(closed);
}

void closeJoints(Assembly<3>& assembly)
{
    const JointTolerance tolerance = jointTolerance(assembly);
    assembly.closure = {0, 0, tolerance.oblique, tolerance.distance, tolerance.rounding};
    const double size = meanBlockSize(assembly);
    if (!(size > 0) || !std::isfinite(size) || !assembly.statedJoints.empty())
    {
        return;
    }
    const double exact = exactness(assembly, size);
    for (const FacingPatch& patch : findFacingPatches(assembly, closedFacing(assembly)))
    {
        if (openness(patch) > exact)
        {
            ++assembly.closure.joints;
            assembly.closure.largest = std::max(assembly.closure.largest, openness(patch));
        }
    }
}

FacingTolerance closedFacing(const Assembly<2>& assembly)
{
    const double distance = usualTolerance * meanBlockSize(assembly);
    return facingTolerance(distance, distance);
}

FacingTolerance closedFacing(const Assembly<3>& assembly)
{
    const double distance = usualJointTolerance(assembly, false);
    const double oblique = usualJointTolerance(assembly, true);
    const double larger = std::max(distance, oblique);
    FacingTolerance tolerance = facingTolerance(larger, larger);
    tolerance.distance = distance;
    tolerance.oblique = oblique;
    return tolerance;
}

template<int Dim>
double usualJointTolerance(const Assembly<Dim>& assembly, bool isOblique)
{
    return std::max(usualTolerance * meanBlockSize(assembly),
                    isOblique ? assembly.closure.tolerance : assembly.closure.alongAxes);
}

template<int Dim>
void printClosure(const Assembly<Dim>& assembly)
{
    const JointClosure& closure = assembly.closure;
    if (closure.joints > 0)
    {
        const std::string reason =
            assembly.jointTolerance ? "the jointTolerance that is stated"
            : closure.rounding > 0
                ? fmt::format("as coordinates written to {:.3g} m explain", closure.rounding)
                : "1e-6 of the mean block size";
        info("Joints: {} {} up to {:.3g} m from meeting; {} those within {:.3g} m, {}", closure.joints,
             Dim == 2 ? "closed whose faces were" : "taken as they are whose faces are", closure.largest,
             Dim == 2 ? "closed are" : "joints are", closure.tolerance, reason);
    }
    if (const int apart = facesApartOnPurpose(assembly); apart > 0)
    {
        info("Joints: {} pairs of faces almost meet and are none, farther apart than the jointTolerance of "
             "{:g} m",
             apart, *assembly.jointTolerance);
    }
}

template JointTolerance jointTolerance(const Assembly<2>& assembly);
template JointTolerance jointTolerance(const Assembly<3>& assembly);
template double usualJointTolerance(const Assembly<2>& assembly, bool isOblique);
template double usualJointTolerance(const Assembly<3>& assembly, bool isOblique);
template void printClosure(const Assembly<2>& assembly);
template void printClosure(const Assembly<3>& assembly);

} // namespace drystone
