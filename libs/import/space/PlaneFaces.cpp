// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Joining of corners and fitting of planes.
#include "import/space/PlaneFaces.h"

#include "import/space/Weld.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace drystone
{

namespace
{

struct Plane
{
    Vector<3> normal = Vector<3>::Zero();
    Vector<3> origin = Vector<3>::Zero();
};

/// Plane through the mean of the corners, across their area.
Plane planeOf(const std::vector<Vector<3>>& places, const std::vector<int>& corners)
{
    Plane plane;
    for (const int corner : corners)
    {
        plane.origin += places[corner];
    }
    plane.origin /= static_cast<double>(corners.size());
    Vector<3> area = Vector<3>::Zero();
    for (std::size_t i = 0; i < corners.size(); ++i)
    {
        area += momentOf(Vector<3>(places[corners[i]] - plane.origin),
                         Vector<3>(places[corners[(i + 1) % corners.size()]] - plane.origin));
    }
    const double size = area.norm();
    plane.normal = size > 0 ? Vector<3>(area / size) : Vector<3>::Zero();
    return plane;
}

double unevennessOf(const std::vector<Vector<3>>& places, const std::vector<int>& corners)
{
    const Plane plane = planeOf(places, corners);
    double most = 0;
    for (const int corner : corners)
    {
        most = std::max(most, std::abs(plane.normal.dot(places[corner] - plane.origin)));
    }
    return most;
}

/// Corners of all blocks as nodes.
struct Net
{
    std::vector<Vector<3>> places;
    std::vector<std::vector<int>> faces;   ///< nodes of each face of each block
    std::vector<std::vector<int>> facesAt; ///< faces at each node
};

/// \param nodeOf of each corner of each block, numbered in the order in which they appear
Net netOf(const std::vector<Polyhedron>& blocks, const std::vector<int>& nodeOf)
{
    Net net;
    std::vector<int> count;
    std::size_t first = 0;
    for (const Polyhedron& block : blocks)
    {
        for (std::size_t i = 0; i < block.vertices.size(); ++i)
        {
            const auto node = static_cast<std::size_t>(nodeOf[first + i]);
            if (node == net.places.size())
            {
                net.places.push_back(block.vertices[i]);
                count.push_back(1);
                continue;
            }
            // The mean, without a change of bits where all are equal.
            ++count[node];
            net.places[node] += (block.vertices[i] - net.places[node]) / count[node];
        }
        for (const std::vector<int>& face : block.faces)
        {
            std::vector<int> nodes;
            for (const int vertex : face)
            {
                nodes.push_back(nodeOf[first + static_cast<std::size_t>(vertex)]);
            }
            net.faces.push_back(std::move(nodes));
        }
        first += block.vertices.size();
    }
    net.facesAt.resize(net.places.size());
    for (std::size_t f = 0; f < net.faces.size(); ++f)
    {
        for (const int node : net.faces[f])
        {
            net.facesAt[static_cast<std::size_t>(node)].push_back(static_cast<int>(f));
        }
    }
    return net;
}

/// Marks the nodes of faces that are not plane. \return whether there are any
bool markUneven(const Net& net, double limit, std::vector<bool>& isActive)
{
    bool hasUneven = false;
    for (const std::vector<int>& face : net.faces)
    {
        if (unevennessOf(net.places, face) > limit)
        {
            hasUneven = true;
            for (const int node : face)
            {
                isActive[static_cast<std::size_t>(node)] = true;
            }
        }
    }
    return hasUneven;
}

/// Planes are fitted to the nodes of their faces, and nodes moved to where their planes meet, in turn. Where
/// three planes meet at each node, once is enough; where several blocks share nodes, the error falls by a
/// part each time. Only nodes of faces that have been uneven take part.
void flatten(Net& net, double limit, int rounds)
{
    constexpr double stiffness = 1e-6; // holds a node where its planes do not
    std::vector<bool> isActive(net.places.size(), false);
    std::vector<Plane> planes(net.faces.size());
    for (int round = 0; round < rounds && markUneven(net, limit, isActive); ++round)
    {
        for (std::size_t f = 0; f < net.faces.size(); ++f)
        {
            planes[f] = planeOf(net.places, net.faces[f]);
        }
        for (std::size_t node = 0; node < net.places.size(); ++node)
        {
            if (!isActive[node])
            {
                continue;
            }
            Eigen::Matrix3d matrix = stiffness * Eigen::Matrix3d::Identity();
            Vector<3> right = Vector<3>::Zero();
            for (const int face : net.facesAt[node])
            {
                const Plane& plane = planes[static_cast<std::size_t>(face)];
                matrix += plane.normal * plane.normal.transpose();
                right += plane.normal.dot(plane.origin - net.places[node]) * plane.normal;
            }
            net.places[node] += matrix.ldlt().solve(right);
        }
    }
}

/// The blocks with their corners at the places of their nodes.
std::vector<Polyhedron> placedAt(const Net& net, const std::vector<int>& nodeOf,
                                 std::vector<Polyhedron> blocks)
{
    std::size_t corner = 0;
    for (Polyhedron& block : blocks)
    {
        for (Vector<3>& vertex : block.vertices)
        {
            vertex = net.places[static_cast<std::size_t>(nodeOf[corner])];
            ++corner;
        }
    }
    return blocks;
}

} // namespace

PlaneFaces makePlane(std::vector<Polyhedron>& blocks, double tolerance, Corners cornersOfBlocks)
{
    constexpr double exact = 1e-9; // of the tolerance: what rounding of doubles leaves alone
    constexpr double joinedLimit =
        1e-3; // likewise, as long as blocks share corners: the rest is made of each block
    constexpr int rounds = 100;
    constexpr double farthestMove = 3;

    PlaneFaces result;
    std::vector<Vector<3>> corners;
    std::vector<int> owners;
    for (std::size_t b = 0; b < blocks.size(); ++b)
    {
        corners.insert(corners.end(), blocks[b].vertices.begin(), blocks[b].vertices.end());
        owners.insert(owners.end(), blocks[b].vertices.size(), static_cast<int>(b));
        result.unevenness = std::max(result.unevenness, unevenness(blocks[b]));
    }
    std::vector<Polyhedron> moved = blocks;
    if (cornersOfBlocks == Corners::joined)
    {
        const std::vector<int> nodeOf = weld(corners, tolerance, owners);
        Net net = netOf(blocks, nodeOf);
        for (std::size_t i = 0; i < corners.size(); ++i)
        {
            result.joined += net.places[static_cast<std::size_t>(nodeOf[i])] != corners[i] ? 1 : 0;
        }
        flatten(net, joinedLimit * tolerance, rounds);
        moved = placedAt(net, nodeOf, std::move(moved));
    }
    std::vector<int> own(corners.size());
    std::iota(own.begin(), own.end(), 0);
    Net net = netOf(moved, own);
    flatten(net, exact * tolerance, rounds);
    for (std::size_t i = 0; i < corners.size(); ++i)
    {
        const double move = (net.places[i] - corners[i]).norm();
        result.farthest = std::max(result.farthest, move);
        result.moved += move > 0 ? 1 : 0;
    }
    if (!(result.farthest <= farthestMove * tolerance))
    {
        return {0, 0, 0, result.unevenness};
    }
    blocks = placedAt(net, own, std::move(moved));
    return result;
}

} // namespace drystone
