// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Paths through joints.
#include "contact/SupportPaths.h"

#include "contact/AlmostJoints.h"
#include "contact/Facing.h"
#include "geometry/BroadPhase.h"
#include "geometry/PolygonShape.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

namespace drystone
{

namespace
{

constexpr std::size_t shownBlocks = 10;

/// Whether a corner of one outline lies on the other, within a tolerance [m].
bool touches(const Polygon& one, const Polygon& other, double tolerance)
{
    const auto isOn = [tolerance](const Polygon& outline)
    {
        return [&outline, tolerance](const Vector<2>& corner)
        { return std::abs(signedDistance(outline, corner)) <= tolerance; };
    };
    return std::any_of(one.begin(), one.end(), isOn(other))
           || std::any_of(other.begin(), other.end(), isOn(one));
}

/// `block 4 block 2 (support ground)`: the first pair, of a block that nothing holds and one that it touches,
/// or nothing.
std::string cornerTouch(const Assembly<2>& assembly, const std::vector<int>& loose)
{
    const double tolerance = CheckLimits{}.jointTolerance * meanBlockSize(assembly);
    std::vector<char> isLoose(assembly.blocks.size(), false);
    for (const int block : loose)
    {
        isLoose[block] = true;
    }
    std::vector<BoundingBox> boxes;
    for (const Block<2>& block : assembly.blocks)
    {
        boxes.push_back(enlarged(boundingBox(block.outline), tolerance));
    }
    for (const auto& [one, other] : findMeetingPairs(boxes))
    {
        // Between two that are held, or two that are not, it decides nothing.
        if (isLoose[one] != isLoose[other]
            && touches(assembly.blocks[one].outline, assembly.blocks[other].outline, tolerance))
        {
            return fmt::format("{} touches {}", blockName(assembly, isLoose[one] ? one : other),
                               blockName(assembly, isLoose[one] ? other : one));
        }
    }
    return {};
}

} // namespace

std::vector<int> blocksWithoutSupport(const Assembly<2>& assembly, const std::vector<ContactPoint<2>>& points)
{
    // Groups of blocks that joints hold together, as trees of parents; fixed blocks are one group.
    std::vector<int> parent(assembly.blocks.size() + 1);
    std::iota(parent.begin(), parent.end(), 0);
    const auto root = [&](int i)
    {
        while (parent[i] != i)
        {
            parent[i] = parent[parent[i]];
            i = parent[i];
        }
        return i;
    };
    const int fixed = static_cast<int>(assembly.blocks.size());
    for (std::size_t i = 0; i < assembly.blocks.size(); ++i)
    {
        if (assembly.blocks[i].support >= 0)
        {
            parent[root(static_cast<int>(i))] = root(fixed);
        }
    }
    for (const ContactPoint<2>& point : points)
    {
        parent[root(point.block)] = root(point.neighbour);
    }
    std::vector<int> loose;
    for (std::size_t i = 0; i < assembly.blocks.size(); ++i)
    {
        if (root(static_cast<int>(i)) != root(fixed))
        {
            loose.push_back(static_cast<int>(i));
        }
    }
    return loose;
}

std::string instabilityCause(const Assembly<2>& assembly, const std::vector<ContactPoint<2>>& points)
{
    if (std::all_of(assembly.blocks.begin(), assembly.blocks.end(),
                    [](const Block<2>& block) { return block.support < 0; }))
    {
        return "Cause: no block is fixed. State supports in system/blockTextureDict, for instance `supports "
               "{ ground "
               "{ type ground; } }`, and run blockTexture again.";
    }
    const std::vector<int> loose = blocksWithoutSupport(assembly, points);
    if (loose.empty())
    {
        return {};
    }
    const std::size_t shown = std::min(shownBlocks, loose.size());
    std::string text =
        fmt::format("Cause: {} with no path to a support through joints: {}{}. Nothing holds {}; checkBlocks "
                    "shows where.",
                    loose.size() == 1 ? "a block" : fmt::format("{} blocks", loose.size()),
                    fmt::join(loose.begin(), loose.begin() + static_cast<std::ptrdiff_t>(shown), " "),
                    shown < loose.size() ? " ..." : "", loose.size() == 1 ? "it" : "them");
    if (const std::string touch = cornerTouch(assembly, loose); !touch.empty())
    {
        text += fmt::format(
            " {} at a corner only: a joint needs a face, along which two edges lie on each other.", touch);
    }
    return text;
}

} // namespace drystone
