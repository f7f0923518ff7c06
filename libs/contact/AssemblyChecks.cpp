// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The checks, a function each.
#include "contact/AssemblyChecks.h"

#include "contact/AlmostJoints.h"
#include "contact/ContactPoint.h"
#include "contact/Facing.h"
#include "contact/SupportPaths.h"
#include "geometry/BroadPhase.h"
#include "geometry/PolygonShape.h"

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

/// What several checks look at, found once.
struct Findings
{
    double size = 0;                       ///< meanBlockSize [m]
    std::vector<AreaProperties> areas;     ///< of each block
    std::vector<BoundingBox> boxes;        ///< of each block
    std::vector<std::pair<int, int>> near; ///< pairs of blocks whose boxes come within the gap limit
    std::vector<ContactPoint<2>> points;
    std::vector<Overlap> overlaps;         ///< of pairs
    double largestOverlap = 0;             ///< of any pair, relative to the smaller block
    std::vector<FacingPiece> almostJoints; ///< faces that nearly touch
};

void addFault(CheckResult& result, std::string fault)
{
    ++result.failures;
    if (result.faults.size() < shownFaults)
    {
        result.faults.push_back(std::move(fault));
    }
}

std::string text(const Vector<2>& point)
{
    return fmt::format("({:.6g} {:.6g})", point.x(), point.y());
}

struct Range
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

CheckResult checkVolumes(const Assembly<2>& assembly, const Findings& findings, const CheckLimits& limits)
{
    CheckResult result{"volumes", "", 0, {}};
    Range range;
    double total = 0;
    int count = 0;
    for (std::size_t i = 0; i < assembly.blocks.size(); ++i)
    {
        if (assembly.blocks[i].support < 0)
        {
            const double volume = findings.areas[i].area * assembly.blocks[i].thickness;
            range.add(volume);
            total += volume;
            ++count;
        }
    }
    for (std::size_t i = 0; i < assembly.blocks.size(); ++i)
    {
        const double volume = findings.areas[i].area * assembly.blocks[i].thickness;
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

CheckResult checkInertia(const Assembly<2>& assembly, const Findings& findings, const CheckLimits& limits)
{
    CheckResult result{"inertia", "", 0, {}};
    Range range;
    for (std::size_t i = 0; i < assembly.blocks.size(); ++i)
    {
        if (assembly.blocks[i].support >= 0)
        {
            continue;
        }
        const AreaProperties& area = findings.areas[i];
        const double gyration = area.polarMoment / (area.area * area.area);
        range.add(gyration);
        // No shape has less than the circle's 1/(2 pi).
        if (!(gyration >= 0.5 / EIGEN_PI * (1 - 1e-6) && gyration <= limits.gyration))
        {
            addFault(result, fmt::format("block {} has the polar moment {:.6g} m4 on an area of {:.6g} m2", i,
                                         area.polarMoment, area.area));
        }
    }
    result.message = range.isEmpty()
                         ? "Polar moment: no free blocks"
                         : fmt::format("Polar moment relative to area squared: min = {:.6g} max = {:.6g}",
                                       range.least, range.largest);
    return result;
}

/// Duplicates and overlaps look at the same areas.
std::pair<CheckResult, CheckResult> checkOverlaps(const Assembly<2>& assembly, const Findings& findings,
                                                  const CheckLimits& limits)
{
    CheckResult duplicates{"duplicates", "", 0, {}};
    CheckResult overlaps{"overlaps", "", 0, {}};
    std::set<std::pair<int, int>> listed;
    for (const Overlap& overlap : findings.overlaps)
    {
        const auto [i, j, common, fraction] = overlap;
        listed.emplace(i, j);
        if (common > limits.duplicate * std::max(findings.areas[i].area, findings.areas[j].area))
        {
            addFault(duplicates,
                     fmt::format("{} and {} are the same block twice, at {}", blockName(assembly, i),
                                 blockName(assembly, j), text(findings.areas[i].centroid)));
        }
        else
        {
            addFault(overlaps, fmt::format("{} and {} overlap by {:.6g} m2, {:.3g} of the smaller",
                                           blockName(assembly, i), blockName(assembly, j), common, fraction));
        }
    }
    for (const FacingPiece& piece : findings.almostJoints)
    {
        if (!isApart(piece) && listed.emplace(piece.block, piece.neighbour).second)
        {
            addFault(overlaps,
                     fmt::format("faces of {} and {} are {:.3g} m in each other at {}: no joint",
                                 blockName(assembly, piece.block), blockName(assembly, piece.neighbour),
                                 openness(piece), text(piece.from)));
        }
    }
    duplicates.message = fmt::format("Duplicated blocks: {}", duplicates.failures);
    overlaps.message = fmt::format("Overlapping pairs: {}. Largest overlap = {:.3g} of a block",
                                   overlaps.failures, findings.largestOverlap);
    return {duplicates, overlaps};
}

CheckResult checkGaps(const Assembly<2>& assembly, const Findings& findings, const CheckLimits& limits)
{
    CheckResult result{"gaps", "", 0, {}};
    int stated = 0;
    for (const FacingPiece& piece : findings.almostJoints)
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
                                 openness(piece), text(piece.from)));
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

CheckResult checkSlivers(const Assembly<2>& assembly, const Findings& findings, const CheckLimits& limits)
{
    CheckResult result{"slivers", "", 0, {}};
    Range compactness;
    Range angle;
    for (std::size_t i = 0; i < assembly.blocks.size(); ++i)
    {
        if (assembly.blocks[i].support >= 0)
        {
            continue; // a ground may be as thin and long as it likes
        }
        const Polygon& outline = assembly.blocks[i].outline;
        const ShapeQuality quality = shapeQuality(outline);
        compactness.add(quality.compactness);
        angle.add(quality.smallestAngle);
        double shortest = std::numeric_limits<double>::infinity();
        for (std::size_t k = 0; k < outline.size(); ++k)
        {
            shortest = std::min(shortest, (outline[(k + 1) % outline.size()] - outline[k]).norm());
        }
        if (quality.compactness < limits.compactness)
        {
            addFault(result, fmt::format("block {} is a sliver: 4 pi area/perimeter2 = {:.3g}", i,
                                         quality.compactness));
        }
        else if (quality.smallestAngle < limits.angle)
        {
            addFault(result, fmt::format("block {} has a corner of {:.3g} rad", i, quality.smallestAngle));
        }
        else if (shortest < limits.edge * std::sqrt(findings.areas[i].area))
        {
            addFault(result, fmt::format("block {} has an edge of {:.3g} m", i, shortest));
        }
    }
    result.message = angle.isEmpty()
                         ? "Slivers: no free blocks"
                         : fmt::format("Min compactness = {:.3g}. Sharpest corner = {:.4g} degrees",
                                       compactness.least, angle.least * 180 / EIGEN_PI);
    return result;
}

CheckResult checkSupportPaths(const Assembly<2>& assembly, const Findings& findings)
{
    CheckResult result{"supports", "", 0, {}};
    for (const int block : blocksWithoutSupport(assembly, findings.points))
    {
        addFault(result, fmt::format("block {} at {} has no path to a support through the joints", block,
                                     text(findings.areas[block].centroid)));
    }
    result.message = fmt::format("Blocks with no path to a support: {}", result.failures);
    return result;
}

CheckResult checkJointLengths(const Assembly<2>& assembly, const Findings& findings,
                              const CheckLimits& limits)
{
    CheckResult result{"shortJoints", "", 0, {}};
    Range range;
    for (std::size_t k = 0; k + 1 < findings.points.size(); k += 2)
    {
        const double length = (findings.points[k + 1].position - findings.points[k].position).norm();
        range.add(length);
        if (length < limits.jointLength * findings.size)
        {
            addFault(result, fmt::format("the joint of {} and {} at {} is {:.3g} m long",
                                         blockName(assembly, findings.points[k].block),
                                         blockName(assembly, findings.points[k].neighbour),
                                         text(findings.points[k].position), length));
        }
    }
    result.message = findings.points.empty() ? "No joints"
                                             : fmt::format("Joint length: min = {:.6g} m max = {:.6g} m",
                                                           range.least, range.largest);
    return result;
}

CheckResult checkCornerTouches(const Assembly<2>& assembly, const Findings& findings,
                               const CheckLimits& limits)
{
    const double tolerance = limits.jointTolerance * findings.size;
    std::set<std::pair<int, int>> jointed;
    for (const ContactPoint<2>& point : findings.points)
    {
        jointed.emplace(point.block, point.neighbour);
    }
    CheckResult result{"cornerTouches", "", 0, {}};
    for (const auto& [first, second] : findings.near)
    {
        const bool bothFixed = assembly.blocks[first].support >= 0 && assembly.blocks[second].support >= 0;
        if (bothFixed || jointed.contains({first, second}))
        {
            continue;
        }
        for (const auto& [one, other] : {std::pair(first, second), std::pair(second, first)})
        {
            const BoundingBox reach = enlarged(findings.boxes[other], tolerance);
            const Polygon& outline = assembly.blocks[other].outline;
            for (const Vector<2>& corner : assembly.blocks[one].outline)
            {
                const auto isHere = [&](const Vector<2>& vertex)
                { return (vertex - corner).norm() <= tolerance; };
                if (contains(reach, {corner, corner}) && std::none_of(outline.begin(), outline.end(), isHere)
                    && std::abs(signedDistance(outline, corner)) <= tolerance)
                {
                    addFault(result,
                             fmt::format("a corner of {} touches {} at {} without a joint",
                                         blockName(assembly, one), blockName(assembly, other), text(corner)));
                }
            }
        }
    }
    result.message = fmt::format("Corners that touch an edge without a joint: {}", result.failures);
    return result;
}

AssemblyStatistics count(const Assembly<2>& assembly, const std::vector<ContactPoint<2>>& points)
{
    AssemblyStatistics statistics;
    BoundingBox freeBox;
    for (const Block<2>& block : assembly.blocks)
    {
        statistics.vertices += static_cast<int>(block.outline.size());
        statistics.concaveBlocks += isConvex(block.outline) ? 0 : 1;
        if (block.support < 0)
        {
            const BoundingBox box = boundingBox(block.outline);
            ++statistics.freeBlocks;
            freeBox.lower = freeBox.lower.cwiseMin(box.lower);
            freeBox.upper = freeBox.upper.cwiseMax(box.upper);
        }
    }
    statistics.blocks = static_cast<int>(assembly.blocks.size());
    statistics.supports = static_cast<int>(assembly.supports.size());
    statistics.contactPoints = static_cast<int>(points.size());
    statistics.joints = points.empty() ? 0 : points.back().joint + 1;
    if (statistics.freeBlocks > 0)
    {
        statistics.lower = freeBox.lower;
        statistics.upper = freeBox.upper;
    }
    return statistics;
}

/// See findOverlaps. \param largest overlap of any pair, relative to the smaller block
std::vector<Overlap> overlapsOf(const Assembly<2>& assembly, const CheckLimits& limits, double& largest)
{
    const double size = meanBlockSize(assembly);
    std::vector<BoundingBox> boxes;
    for (const Block<2>& block : assembly.blocks)
    {
        boxes.push_back(boundingBox(block.outline));
    }
    std::vector<Overlap> overlaps;
    for (const auto& [i, j] : findMeetingPairs(boxes))
    {
        const Polygon& a = assembly.blocks[i].outline;
        const Polygon& b = assembly.blocks[j].outline;
        const double common = overlapArea(a, b);
        const double areaA = areaProperties(a).area;
        const double areaB = areaProperties(b).area;
        const double smaller = std::min(areaA, areaB);
        const bool isTwice = common > limits.duplicate * std::max(areaA, areaB);
        // A joint may overlap by its tolerance, over a length of at most the smaller block's box.
        const double length =
            std::min((boxes[i].upper - boxes[i].lower).norm(), (boxes[j].upper - boxes[j].lower).norm());
        const double allowed = std::min(2 * limits.jointTolerance * size * length, 0.5 * smaller);
        largest = isTwice ? largest : std::max(largest, common / smaller);
        if (isTwice || common > allowed)
        {
            overlaps.push_back({i, j, common, common / smaller});
        }
    }
    return overlaps;
}

} // namespace

std::vector<Overlap> findOverlaps(const Assembly<2>& assembly, const CheckLimits& limits)
{
    double largest = 0;
    return overlapsOf(assembly, limits, largest);
}

AssemblyStatistics countAssembly(const Assembly<2>& assembly)
{
    return count(assembly, findContactPoints(assembly));
}

AssemblyReport checkAssembly(const Assembly<2>& assembly, CheckExtent extent, const CheckLimits& limits)
{
    Findings findings;
    findings.size = meanBlockSize(assembly);
    std::vector<BoundingBox> enlargedBoxes;
    for (const Block<2>& block : assembly.blocks)
    {
        findings.areas.push_back(areaProperties(block.outline));
        findings.boxes.push_back(boundingBox(block.outline));
        enlargedBoxes.push_back(enlarged(findings.boxes.back(), limits.jointTolerance * findings.size));
    }
    findings.near = findMeetingPairs(enlargedBoxes);
    findings.points = findContactPoints(assembly, limits.jointTolerance);
    findings.overlaps = overlapsOf(assembly, limits, findings.largestOverlap);
    findings.almostJoints = findAlmostJoints(assembly, limits);

    AssemblyReport report;
    report.statistics = count(assembly, findings.points);
    report.checks.push_back(checkVolumes(assembly, findings, limits));
    report.checks.push_back(checkInertia(assembly, findings, limits));
    auto [duplicates, overlaps] = checkOverlaps(assembly, findings, limits);
    report.checks.push_back(std::move(duplicates));
    report.checks.push_back(std::move(overlaps));
    report.checks.push_back(checkGaps(assembly, findings, limits));
    report.checks.push_back(checkSlivers(assembly, findings, limits));
    report.checks.push_back(checkSupportPaths(assembly, findings));
    if (extent == CheckExtent::all)
    {
        report.checks.push_back(checkJointLengths(assembly, findings, limits));
        report.checks.push_back(checkCornerTouches(assembly, findings, limits));
    }
    return report;
}

int failedChecks(const AssemblyReport& report)
{
    return static_cast<int>(std::count_if(report.checks.begin(), report.checks.end(),
                                          [](const CheckResult& check) { return check.failures > 0; }));
}

std::string printedReport(const Assembly<2>& assembly, const AssemblyReport& report)
{
    const AssemblyStatistics& statistics = report.statistics;
    std::string text = "Assembly stats\n";
    const auto line = [&text](std::string_view name, const auto& value)
    { text += fmt::format("    {:<18}{}\n", fmt::format("{}:", name), value); };
    line("blocks", statistics.blocks);
    line("free blocks", statistics.freeBlocks);
    line("concave blocks", statistics.concaveBlocks);
    line("vertices", statistics.vertices);
    line("joints", statistics.joints);
    line("contact points", statistics.contactPoints);
    line("supports", statistics.supports);
    for (std::size_t i = 0; i < assembly.supports.size(); ++i)
    {
        const auto count =
            std::count_if(assembly.blocks.begin(), assembly.blocks.end(),
                          [&](const Block<2>& block) { return block.support == static_cast<int>(i); });
        text += fmt::format("        {} ({}), {} blocks\n", assembly.supports[i].name,
                            assembly.supports[i].type, count);
    }
    text += fmt::format("\nChecking geometry...\n    Bounding box of the free blocks {} {} m\n",
                        drystone::text(statistics.lower), drystone::text(statistics.upper));
    for (const CheckResult& check : report.checks)
    {
        text += check.failures == 0 ? fmt::format("    {} OK.\n", check.message)
                                    : fmt::format(" ***{}, {} failed.\n", check.message, check.name);
        for (const std::string& fault : check.faults)
        {
            text += fmt::format("      - {}\n", fault);
        }
        if (check.failures > static_cast<int>(check.faults.size()))
        {
            text +=
                fmt::format("      - and {} more\n", check.failures - static_cast<int>(check.faults.size()));
        }
    }
    const int failed = failedChecks(report);
    text += failed == 0 ? "\nAssembly OK." : fmt::format("\nFailed {} checks.", failed);
    return text;
}

} // namespace drystone
