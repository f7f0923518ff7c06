// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The checks, a function each.
#include "contact/AssemblyChecks.h"

#include "assembly/BlockShape.h"
#include "contact/AlmostJoints.h"
#include "contact/JointClosure.h"
#include "contact/PointsOfJoints.h"
#include "contact/ShapeChecks.h"
#include "contact/SupportPaths.h"
#include "contact/space/StatedJointChecks.h"
#include "geometry/BroadPhase.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

namespace drystone
{

namespace
{

constexpr std::size_t shownFaults = 5;

template<int Dim>
using FacingFaces = decltype(findAlmostJoints(std::declval<const Assembly<Dim>&>()));

/// What several checks look at, found once.
template<int Dim>
struct Findings
{
    double size = 0;                    ///< meanBlockSize [m]
    std::vector<BlockMass<Dim>> masses; ///< of each block
    std::vector<std::pair<int, int>>
        near; ///< pairs of blocks whose boxes come within CheckLimits::jointTolerance
    std::vector<ContactPoint<Dim>> points;
    OverlapSearch<Dim> overlaps;
    FacingFaces<Dim> almostJoints; ///< faces that nearly touch
};

void addFault(CheckResult& result, std::string fault)
{
    ++result.failures;
    if (result.faults.size() < shownFaults)
    {
        result.faults.push_back(std::move(fault));
    }
}

template<int Dim>
CheckResult checkVolumes(const Assembly<Dim>& assembly, const Findings<Dim>& findings,
                         const CheckLimits& limits)
{
    CheckResult result{"volumes", "", 0, {}};
    CheckedRange range;
    double total = 0;
    int count = 0;
    for (std::size_t i = 0; i < assembly.blocks.size(); ++i)
    {
        if (assembly.blocks[i].support < 0)
        {
            const double volume = findings.masses[i].volume;
            range.add(volume);
            total += volume;
            ++count;
        }
    }
    for (std::size_t i = 0; i < assembly.blocks.size(); ++i)
    {
        const double volume = findings.masses[i].volume;
        if (count > 0 && !(volume > limits.volumeRatio * total / count))
        {
            addFault(result, fmt::format("{} has the volume {:.6g} m3",
                                         blockName(assembly, static_cast<int>(i)), volume));
        }
    }
    result.message =
        count > 0 ? fmt::format("Min volume = {:.6g} m3. Max volume = {:.6g} m3. Total volume = {:.6g} m3",
                                range.least, range.largest, total)
                  : "No free blocks";
    if (count == 0)
    {
        addFault(result, "every block is fixed: there is nothing to compute");
    }
    return result;
}

/// A check of the shape of each free block.
template<int Dim, class Check>
CheckResult checkShapes(const Assembly<Dim>& assembly, std::string name, const Check& faultOf)
{
    CheckResult result{std::move(name), "", 0, {}};
    for (std::size_t i = 0; i < assembly.blocks.size(); ++i)
    {
        if (assembly.blocks[i].support < 0) // a ground may be as thin and long as it likes
        {
            if (const std::string fault = faultOf(assembly.blocks[i]); !fault.empty())
            {
                addFault(result, fmt::format("block {} {}", i, fault));
            }
        }
    }
    return result;
}

template<int Dim>
CheckResult checkInertia(const Assembly<Dim>& assembly, const CheckLimits& limits)
{
    CheckedRange range;
    CheckResult result = checkShapes(
        assembly, "inertia", [&](const Block<Dim>& block) { return inertiaFault(block, limits, range); });
    result.message = inertiaMessage<Dim>(range);
    return result;
}

template<int Dim>
CheckResult checkSlivers(const Assembly<Dim>& assembly, const CheckLimits& limits)
{
    SliverRanges ranges;
    CheckResult result = checkShapes(
        assembly, "slivers", [&](const Block<Dim>& block) { return sliverFault(block, limits, ranges); });
    result.message = sliverMessage<Dim>(ranges);
    return result;
}

/// Duplicates and overlaps look at the same areas.
template<int Dim>
std::pair<CheckResult, CheckResult> checkOverlaps(const Assembly<Dim>& assembly,
                                                  const Findings<Dim>& findings, const CheckLimits& limits)
{
    CheckResult duplicates{"duplicates", "", 0, {}};
    CheckResult overlaps{"overlaps", "", 0, {}};
    std::set<std::pair<int, int>> listed;
    for (const Overlap<Dim>& overlap : findings.overlaps.faults)
    {
        const auto [i, j, common, fraction] = overlap;
        listed.emplace(i, j);
        if (common > limits.duplicate * std::max(extentOf(assembly.blocks[i]), extentOf(assembly.blocks[j])))
        {
            addFault(duplicates,
                     fmt::format("{} and {} are the same block twice, at {}", blockName(assembly, i),
                                 blockName(assembly, j), placeText<Dim>(findings.masses[i].centroid)));
        }
        else
        {
            addFault(overlaps, fmt::format("{} and {} overlap by {:.6g} {}, {:.3g} of the smaller",
                                           blockName(assembly, i), blockName(assembly, j), common,
                                           Dim == 2 ? "m2" : "m3", fraction));
        }
    }
    for (const auto& piece : findings.almostJoints)
    {
        if (!isApart(piece) && listed.emplace(piece.block, piece.neighbour).second)
        {
            addFault(overlaps,
                     fmt::format("faces of {} and {} are {:.3g} m in each other at {}: no joint",
                                 blockName(assembly, piece.block), blockName(assembly, piece.neighbour),
                                 openness(piece), placeText<Dim>(placeOf(piece))));
        }
    }
    duplicates.message = fmt::format("Duplicated blocks: {}", duplicates.failures);
    overlaps.message = fmt::format("Overlapping pairs: {}. Largest overlap = {:.3g} of a block",
                                   overlaps.failures, findings.overlaps.largest);
    return {duplicates, overlaps};
}

template<int Dim>
CheckResult checkGaps(const Assembly<Dim>& assembly, const Findings<Dim>& findings, const CheckLimits& limits)
{
    CheckResult result{"gaps", "", 0, {}};
    int stated = 0;
    for (const auto& piece : findings.almostJoints)
    {
        if (isApart(piece) && assembly.jointTolerance && openness(piece) > *assembly.jointTolerance)
        {
            ++stated;
        }
        else if (isApart(piece))
        {
            addFault(result,
                     fmt::format("{} and {} are {:.3g} m apart at {}: no joint",
                                 blockName(assembly, piece.block), blockName(assembly, piece.neighbour),
                                 openness(piece), placeText<Dim>(placeOf(piece))));
        }
    }
    result.message = fmt::format("Faces that nearly touch (within {:.3g} m): {}", limits.gap * findings.size,
                                 result.failures + stated);
    if (stated > 0)
    {
        result.message += fmt::format(", {} of them beyond the jointTolerance that is stated", stated);
    }
    return result;
}

template<int Dim>
CheckResult checkSupportPaths(const Assembly<Dim>& assembly, const Findings<Dim>& findings)
{
    CheckResult result{"supports", "", 0, {}};
    for (const int block : blocksWithoutSupport(assembly, findings.points))
    {
        addFault(result, fmt::format("block {} at {} has no path to a support through the joints", block,
                                     placeText<Dim>(findings.masses[block].centroid)));
    }
    result.message = fmt::format("Blocks with no path to a support: {}", result.failures);
    return result;
}

template<int Dim>
CheckResult checkJointSizes(const Assembly<Dim>& assembly, const Findings<Dim>& findings,
                            const CheckLimits& limits)
{
    CheckResult result{Dim == 2 ? "shortJoints" : "smallJoints", "", 0, {}};
    CheckedRange range;
    const std::vector<ContactPoint<Dim>>& points = findings.points;
    for (const PointRange& joint : pointsOfJoints(points))
    {
        const ContactPoint<Dim>& first = points[joint.begin];
        const double size = jointSize({&first, joint.size()});
        range.add(size);
        if (size < std::pow(limits.jointLength * findings.size, Dim - 1))
        {
            addFault(result,
                     fmt::format("the joint of {} and {} at {} is {:.3g} {}",
                                 blockName(assembly, first.block), blockName(assembly, first.neighbour),
                                 placeText<Dim>(first.position), size, Dim == 2 ? "m long" : "m2 large"));
        }
    }
    result.message = points.empty() ? "No joints"
                                    : fmt::format("Joint {0}: min = {1:.6g} {3} max = {2:.6g} {3}",
                                                  Dim == 2 ? "length" : "area", range.least, range.largest,
                                                  Dim == 2 ? "m" : "m2");
    return result;
}

/// Whether joints that are stated are those of the blocks.
CheckResult checkStatedJoints(const Assembly<3>& assembly)
{
    CheckResult result{"statedJoints", "", 0, {}};
    const std::vector<MisplacedJoint> misplaced = misplacedJoints(assembly);
    for (const MisplacedJoint& one : misplaced)
    {
        const StatedJoint<3>& joint = assembly.statedJoints[static_cast<std::size_t>(one.joint)];
        addFault(result, fmt::format("the joint of {} and {} has a point at {} that is {:.3g} m off block {}",
                                     blockName(assembly, joint.block), blockName(assembly, joint.neighbour),
                                     placeText<3>(one.point), one.farOff, one.block));
    }
    const std::vector<std::pair<int, int>> lacking = facesWithoutStatedJoint(assembly);
    for (const auto& [block, neighbour] : lacking)
    {
        addFault(result, fmt::format("{} and {} share a face, and no joint is stated between them",
                                     blockName(assembly, block), blockName(assembly, neighbour)));
    }
    result.message = fmt::format(
        "{} joints are stated: {} off their blocks by more than {:.2g} m, {} lacking "
        "where blocks share a face",
        assembly.statedJoints.size(), misplaced.size(), statedJointTolerance(assembly), lacking.size());
    return result;
}

/// Reports where a corner, or in space an edge, of one of two blocks touches the other.
template<int Dim>
void addLoneTouches(CheckResult& result, const Assembly<Dim>& assembly, int first, int second,
                    double tolerance)
{
    for (const auto& [one, other] : {std::pair(first, second), std::pair(second, first)})
    {
        const std::vector<Vector<Dim>> places =
            loneTouches(assembly.blocks[one], assembly.blocks[other], tolerance);
        for (const Vector<Dim>& place : places)
        {
            addFault(result, fmt::format("{}{} touches {} at {} without a joint",
                                         Dim == 2 ? "a corner of " : "", blockName(assembly, one),
                                         blockName(assembly, other), placeText<Dim>(place)));
        }
        if (Dim == 3 && !places.empty())
        {
            break; // once for a pair
        }
    }
}

/// Reports the corners that two blocks have in common.
template<int Dim>
void addCommonCorners(CheckResult& result, const Assembly<Dim>& assembly, int first, int second,
                      double tolerance)
{
    for (const Vector<Dim>& place : commonCorners(assembly.blocks[first], assembly.blocks[second], tolerance))
    {
        addFault(result,
                 fmt::format("{} and {} touch at {}, corner to corner, without a joint",
                             blockName(assembly, first), blockName(assembly, second), placeText<Dim>(place)));
    }
}

/// Blocks that touch without a face in common.
template<int Dim>
CheckResult checkTouches(const Assembly<Dim>& assembly, const Findings<Dim>& findings,
                         const CheckLimits& limits)
{
    const double tolerance = limits.jointTolerance * findings.size;
    std::vector<char> isLoose(assembly.blocks.size(), false);
    for (const int block : blocksWithoutSupport(assembly, findings.points))
    {
        isLoose[block] = true;
    }
    CheckResult result{Dim == 2 ? "cornerTouches" : "edgeTouches", "", 0, {}};
    int usual = 0;
    for (const auto& [first, second] : pairsWithoutJoint(assembly, findings.near, findings.points))
    {
        // Joints hold both blocks, or neither: what lacks is not that these two have none.
        if (isLoose[first] == isLoose[second]
            && meetAtEdges(assembly.blocks[first], assembly.blocks[second], tolerance))
        {
            ++usual;
            continue;
        }
        addLoneTouches(result, assembly, first, second, tolerance);
        if (isLoose[first] != isLoose[second]) // else they meet so across a crossing of joints
        {
            addCommonCorners(result, assembly, first, second, tolerance);
        }
    }
    result.message = fmt::format("{} without a joint: {}",
                                 Dim == 2 ? "Corners that touch an edge"
                                          : "Blocks that touch along an edge or at a corner",
                                 result.failures + usual);
    if (usual > 0)
    {
        result.message += fmt::format(", {} of them where edges of both meet, as in a bond",
                                      result.failures > 0 ? fmt::to_string(usual) : "all");
    }
    return result;
}

} // namespace

template<int Dim>
AssemblyReport<Dim> checkAssembly(const Assembly<Dim>& assembly, CheckExtent extent,
                                  const CheckLimits& limits)
{
    Findings<Dim> findings;
    findings.size = meanBlockSize(assembly);
    findings.masses = blockMasses(assembly);
    findings.near = blocksWithin(assembly, limits.jointTolerance * findings.size);
    findings.points = findContactPoints(assembly);
    findings.overlaps = searchOverlaps(assembly, limits);
    findings.almostJoints = findAlmostJoints(assembly, limits);

    AssemblyReport<Dim> report;
    report.statistics = countAssembly(assembly, findings.points);
    report.checks.push_back(checkVolumes(assembly, findings, limits));
    report.checks.push_back(checkInertia(assembly, limits));
    auto [duplicates, overlaps] = checkOverlaps(assembly, findings, limits);
    report.checks.push_back(std::move(duplicates));
    report.checks.push_back(std::move(overlaps));
    report.checks.push_back(checkGaps(assembly, findings, limits));
    if constexpr (Dim == 3)
    {
        if (!assembly.statedJoints.empty())
        {
            report.checks.push_back(checkStatedJoints(assembly));
        }
    }
    report.checks.push_back(checkSlivers(assembly, limits));
    report.checks.push_back(checkSupportPaths(assembly, findings));
    if (extent == CheckExtent::all)
    {
        report.checks.push_back(checkJointSizes(assembly, findings, limits));
        report.checks.push_back(checkTouches(assembly, findings, limits));
    }
    return report;
}

template AssemblyReport<2> checkAssembly(const Assembly<2>& assembly, CheckExtent extent,
                                         const CheckLimits& limits);
template AssemblyReport<3> checkAssembly(const Assembly<3>& assembly, CheckExtent extent,
                                         const CheckLimits& limits);

} // namespace drystone
