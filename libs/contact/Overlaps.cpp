// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Pairs by their boxes; what rounding and the tolerance of joints explain is no fault.
#include "contact/Overlaps.h"

#include "assembly/BlockShape.h"
#include "contact/ShapeChecks.h"
#include "geometry/BroadPhase.h"

#include <algorithm>
#include <cmath>

namespace drystone
{

template<int Dim>
OverlapSearch<Dim> searchOverlaps(const Assembly<Dim>& assembly, const CheckLimits& limits)
{
    const double size = meanBlockSize(assembly);
    // Joints in space stay as far apart, or in each other, as they were built.
    const double tolerance =
        std::max(limits.jointTolerance * size, Dim == 3 ? assembly.closure.tolerance : 0);
    std::vector<Box<Dim>> boxes;
    for (const Block<Dim>& block : assembly.blocks)
    {
        boxes.push_back(boundingBox(block));
    }
    OverlapSearch<Dim> overlaps;
    for (const auto& [i, j] : findMeetingPairs(boxes))
    {
        const Block<Dim>& a = assembly.blocks[i];
        const Block<Dim>& b = assembly.blocks[j];
        const double common = commonExtent(a, b, tolerance);
        const double smaller = std::min(extentOf(a), extentOf(b));
        const bool isTwice = common > limits.duplicate * std::max(extentOf(a), extentOf(b));
        // A joint may overlap by its tolerance, over at most the length of the smaller block's box, squared
        // in space.
        const double length =
            std::min((boxes[i].upper - boxes[i].lower).norm(), (boxes[j].upper - boxes[j].lower).norm());
        const double allowed = std::min(2 * tolerance * std::pow(length, Dim - 1), 0.5 * smaller);
        overlaps.largest = isTwice ? overlaps.largest : std::max(overlaps.largest, common / smaller);
        // A tip has little volume: where that is allowed, its depth tells, unless there is less of it than a
        // sharp tip of that depth has.
        constexpr double sharpest = 1e-4;
        const double deep = std::max(2 * tolerance, limits.depth * length);
        const bool isDeep =
            common > sharpest * std::pow(deep, Dim) && common <= allowed && commonDepth(a, b) > deep;
        if (isTwice || common > allowed || isDeep)
        {
            overlaps.faults.push_back({i, j, common, common / smaller});
        }
    }
    return overlaps;
}

template<int Dim>
std::vector<Overlap<Dim>> findOverlaps(const Assembly<Dim>& assembly, const CheckLimits& limits)
{
    return searchOverlaps(assembly, limits).faults;
}

template OverlapSearch<2> searchOverlaps(const Assembly<2>& assembly, const CheckLimits& limits);
template OverlapSearch<3> searchOverlaps(const Assembly<3>& assembly, const CheckLimits& limits);
template std::vector<Overlap<2>> findOverlaps(const Assembly<2>& assembly, const CheckLimits& limits);
template std::vector<Overlap<3>> findOverlaps(const Assembly<3>& assembly, const CheckLimits& limits);

} // namespace drystone
