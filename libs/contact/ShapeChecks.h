// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// What the checks of an assembly ask of the shapes of its blocks; the answers are in plane/ and space/.
#pragma once

#include "assembly/BlockShape.h"
#include "contact/CheckLimits.h"
#include "contact/ContactPoint.h"
#include "geometry/BroadPhase.h"

#include <algorithm>
#include <limits>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace drystone
{

/// The least and the largest of the figures that a check has seen.
struct CheckedRange
{
    double least = std::numeric_limits<double>::infinity();
    double largest = -std::numeric_limits<double>::infinity();

    void add(double value)
    {
        least = std::min(least, value);
        largest = std::max(largest, value);
    }
    bool isEmpty() const { return least > largest; }
};

/// How compact the blocks of an assembly are, and how sharp their corners.
struct SliverRanges
{
    CheckedRange compactness;
    CheckedRange angle; ///< of the corners [rad], of the plane
};

/// Pairs of blocks whose boxes come within a distance [m] of each other, the lower index first.
template<int Dim>
std::vector<std::pair<int, int>> blocksWithin(const Assembly<Dim>& assembly, double distance)
{
    std::vector<Box<Dim>> boxes;
    for (const Block<Dim>& block : assembly.blocks)
    {
        boxes.push_back(enlarged<Dim>(boundingBox(block), distance));
    }
    return findMeetingPairs(boxes);
}

/// Of pairs of blocks those that no contact point joins and of which one is free at least.
template<int Dim>
std::vector<std::pair<int, int>> pairsWithoutJoint(const Assembly<Dim>& assembly,
                                                   const std::vector<std::pair<int, int>>& pairs,
                                                   const std::vector<ContactPoint<Dim>>& points)
{
    std::set<std::pair<int, int>> jointed;
    for (const ContactPoint<Dim>& point : points)
    {
        jointed.emplace(point.block, point.neighbour);
    }
    std::vector<std::pair<int, int>> without;
    for (const auto& [first, second] : pairs)
    {
        const bool bothFixed = assembly.blocks[first].support >= 0 && assembly.blocks[second].support >= 0;
        if (!bothFixed && !jointed.contains({first, second}))
        {
            without.emplace_back(first, second);
        }
    }
    return without;
}

/// Area of a block of the plane [m2], volume of one of space [m3].
double extentOf(const Block<2>& block);
double extentOf(const Block<3>& block);

/// Area or volume of the common part of two blocks. \param tolerance depth up to which blocks of space do not
/// count as overlapping; not used in the plane [m]
double commonExtent(const Block<2>& one, const Block<2>& other, double tolerance);
double commonExtent(const Block<3>& one, const Block<3>& other, double tolerance);

/// How deep two blocks lie in each other [m]; 0 where they are apart or touch.
double commonDepth(const Block<2>& one, const Block<2>& other);
double commonDepth(const Block<3>& one, const Block<3>& other);

/// Whether no corner of an outline, or edge of a polyhedron, turns inwards.
bool isConvexBlock(const Block<2>& block);
bool isConvexBlock(const Block<3>& block);

/// What is wrong with the inertia of a block, as a predicate that continues `block 3 `; empty when nothing
/// is. \param range gets the block's figure, CheckLimits::gyration
std::string inertiaFault(const Block<2>& block, const CheckLimits& limits, CheckedRange& range);
std::string inertiaFault(const Block<3>& block, const CheckLimits& limits, CheckedRange& range);
/// The line of the report, without its verdict.
template<int Dim>
std::string inertiaMessage(const CheckedRange& range);
template<>
std::string inertiaMessage<2>(const CheckedRange& range);
template<>
std::string inertiaMessage<3>(const CheckedRange& range);

/// What makes a block a sliver, likewise. \param ranges get the block's figures
std::string sliverFault(const Block<2>& block, const CheckLimits& limits, SliverRanges& ranges);
std::string sliverFault(const Block<3>& block, const CheckLimits& limits, SliverRanges& ranges);
template<int Dim>
std::string sliverMessage(const SliverRanges& ranges);
template<>
std::string sliverMessage<2>(const SliverRanges& ranges);
template<>
std::string sliverMessage<3>(const SliverRanges& ranges);

/// Length of a joint of the plane [m], area of one of space [m2]. \param points of one joint, as
/// findContactPoints gives them
double jointSize(std::span<const ContactPoint<2>> points);
double jointSize(std::span<const ContactPoint<3>> points);

/// Where one block touches another that it has no joint with: in the plane each corner of the one that lies
/// on an edge of the other and not at its corner; in space one such corner, or a place between them where
/// edges cross. \param tolerance within which they touch [m] \return the places [m]; none where they do not
/// touch
std::vector<Vector<2>> loneTouches(const Block<2>& one, const Block<2>& other, double tolerance);
std::vector<Vector<3>> loneTouches(const Block<3>& one, const Block<3>& other, double tolerance);

/// Where corners of both blocks are together in the plane, as those of bricks on either side of a crossing of
/// joints, or of a block that stands on the corner of another [m]; in space loneTouches has such places.
std::vector<Vector<2>> commonCorners(const Block<2>& one, const Block<2>& other, double tolerance);
std::vector<Vector<3>> commonCorners(const Block<3>& one, const Block<3>& other, double tolerance);

/// Whether two blocks that touch without a joint do so where edges of both meet, as bricks of a bond meet
/// those diagonally above them, and nowhere within a face, as a block that stands on its edge. In the plane
/// never: loneTouches leaves corners that meet corners out.
bool meetAtEdges(const Block<2>& one, const Block<2>& other, double tolerance);
bool meetAtEdges(const Block<3>& one, const Block<3>& other, double tolerance);

} // namespace drystone
