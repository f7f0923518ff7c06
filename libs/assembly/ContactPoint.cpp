// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The search for joints: straight pieces that the outlines of two blocks share.
#include "assembly/ContactPoint.h"

#include "geometry/BroadPhase.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace drystone
{

namespace
{

struct Edge
{
    int block;
    Vector<2> from;
    Vector<2> to;
};

/// A straight piece that an edge of each of two blocks shares.
struct Joint
{
    int block;
    int neighbour;
    Vector<2> from;
    Vector<2> to;
    Vector<2> normal;
};

/// Edges that face each other turn their backs by no more than this from exactly opposite [rad]: about 0.06
/// degrees.
constexpr double angularTolerance = 1e-3;

double meanBlockSize(const Assembly<2>& assembly)
{
    // Over free blocks alone: a ground slab of any extent leaves the tolerance as it is.
    double area = 0;
    int count = 0;
    for (const Block<2>& block : assembly.blocks)
    {
        if (block.support < 0)
        {
            area += std::abs(areaProperties(block.outline).area);
            ++count;
        }
    }
    return count > 0 ? std::sqrt(area / count) : 0;
}

/// The piece that two edges share, if any. Distances are measured on the line halfway between the two.
bool findJoint(const Edge& a, const Edge& b, double tolerance, Joint& joint)
{
    const Vector<2> alongA = (a.to - a.from).normalized();
    const Vector<2> alongB =
        (b.from - b.to).normalized(); // reversed: outlines pass a joint in opposite directions
    if (alongA.dot(alongB) <= 0 || std::abs(cross(alongA, alongB)) > angularTolerance)
    {
        return false;
    }
    const Vector<2> along = (alongA + alongB).normalized();
    const Vector<2> across = perpendicular(along);
    // Coordinates from a.from, so that a structure far from the origin keeps its digits.
    const Vector<2>& origin = a.from;
    const double toA = along.dot(a.to - origin);
    const double fromB = along.dot(b.to - origin);
    const double toB = along.dot(b.from - origin);
    const double begin = std::max(0.0, fromB);
    const double end = std::min(toA, toB);
    if (end - begin <= tolerance)
    {
        return false;
    }
    const auto heightOnA = [&](double s) { return s * across.dot(a.to - origin) / toA; };
    const auto heightOnB = [&](double s)
    {
        const double below = across.dot(b.to - origin);
        return below + (s - fromB) / (toB - fromB) * (across.dot(b.from - origin) - below);
    };
    for (const double s : {begin, end})
    {
        if (std::abs(heightOnA(s) - heightOnB(s)) > tolerance)
        {
            return false;
        }
    }
    const auto pointAt = [&](double s) -> Vector<2>
    { return origin + s * along + (heightOnA(s) + heightOnB(s)) / 2 * across; };
    // An outline runs counter-clockwise, its block on the left: `across` points into a's block, away from
    // b's.
    joint = {a.block, b.block, pointAt(begin), pointAt(end), across};
    return true;
}

} // namespace

template<>
std::vector<ContactPoint<2>> findContactPoints(const Assembly<2>& assembly, double relativeTolerance)
{
    const double tolerance = relativeTolerance * meanBlockSize(assembly);

    std::vector<Edge> edges;
    edges.reserve(4 * assembly.blocks.size());
    for (std::size_t block = 0; block < assembly.blocks.size(); ++block)
    {
        const Polygon outline = withoutStraightVertices(assembly.blocks[block].outline, tolerance / 2);
        for (std::size_t i = 0; i < outline.size(); ++i)
        {
            const Vector<2>& from = outline[i];
            const Vector<2>& to = outline[(i + 1) % outline.size()];
            if ((to - from).norm() > tolerance)
            {
                edges.push_back({static_cast<int>(block), from, to});
            }
        }
    }

    std::vector<BoundingBox> boxes;
    boxes.reserve(edges.size());
    for (const Edge& edge : edges)
    {
        boxes.push_back(enlarged({edge.from.cwiseMin(edge.to), edge.from.cwiseMax(edge.to)}, tolerance));
    }

    std::vector<Joint> joints;
    Joint joint;
    for (const auto& [first, second] : findMeetingPairs(boxes))
    {
        const Edge& a = edges[first]; // edges are in block order: a's block comes first
        const Edge& b = edges[second];
        const bool bothFixed = assembly.blocks[a.block].support >= 0 && assembly.blocks[b.block].support >= 0;
        if (a.block != b.block && !bothFixed && findJoint(a, b, tolerance, joint))
        {
            joints.push_back(joint);
        }
    }
    // Joints of one pair of blocks in a fixed order of space, whatever the order of the search.
    std::sort(joints.begin(), joints.end(),
              [](const Joint& a, const Joint& b)
              {
                  return std::tuple(a.block, a.neighbour, a.from.x(), a.from.y())
                         < std::tuple(b.block, b.neighbour, b.from.x(), b.from.y());
              });

    std::vector<ContactPoint<2>> points;
    points.reserve(2 * joints.size());
    for (std::size_t i = 0; i < joints.size(); ++i)
    {
        for (const Vector<2>& end : {joints[i].from, joints[i].to})
        {
            points.push_back(
                {joints[i].block, joints[i].neighbour, static_cast<int>(i), end, joints[i].normal, 0, {}});
        }
    }
    return points;
}

} // namespace drystone
