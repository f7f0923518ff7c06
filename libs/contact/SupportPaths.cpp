// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Blocks that no path through joints supports, and where they touch others without a joint.
#include "contact/SupportPaths.h"

#include "contact/AlmostJoints.h"
#include "contact/ShapeChecks.h"
#include "core/DisjointSets.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace drystone
{

namespace
{

constexpr std::size_t shownBlocks = 10;

/// `at a corner only: a joint needs ...`
template<int Dim>
std::string cornersAreNoJoint()
{
    return Dim == 2 ? "at a corner only: a joint needs a face, along which two edges lie on each other"
                    : "along an edge or at a corner only: a joint needs two faces that lie on each other";
}

/// `block 4 block 2 (support ground)`: the first pair, of a block that nothing holds and one that it touches,
/// or nothing.
template<int Dim>
std::string cornerTouch(const Assembly<Dim>& assembly, const std::vector<int>& loose)
{
    const double tolerance = CheckLimits{}.jointTolerance * meanBlockSize(assembly);
    std::vector<char> isLoose(assembly.blocks.size(), false);
    for (const int block : loose)
    {
        isLoose[block] = true;
    }
    for (const auto& [one, other] : blocksWithin(assembly, tolerance))
    {
        // Between two that are held, or two that are not, it decides nothing.
        if (isLoose[one] != isLoose[other] && touch(assembly.blocks[one], assembly.blocks[other], tolerance))
        {
            return fmt::format("{} touches {}", blockName(assembly, isLoose[one] ? one : other),
                               blockName(assembly, isLoose[one] ? other : one));
        }
    }
    return {};
}

} // namespace

template<int Dim>
std::vector<int> blocksWithoutSupport(const Assembly<Dim>& assembly,
                                      const std::vector<ContactPoint<Dim>>& points)
{
    // Groups of blocks that joints hold together; fixed blocks are one group.
    const int fixed = static_cast<int>(assembly.blocks.size());
    DisjointSets together(assembly.blocks.size() + 1);
    for (int block = 0; block < fixed; ++block)
    {
        if (assembly.blocks[block].support >= 0)
        {
            together.join(block, fixed);
        }
    }
    for (const ContactPoint<Dim>& point : points)
    {
        together.join(point.block, point.neighbour);
    }
    std::vector<int> loose;
    for (int block = 0; block < fixed; ++block)
    {
        if (together.firstOf(block) != together.firstOf(fixed))
        {
            loose.push_back(block);
        }
    }
    return loose;
}

template<int Dim>
std::string touchWithoutJoint(const Assembly<Dim>& assembly, const std::vector<ContactPoint<Dim>>& points)
{
    const double tolerance = CheckLimits{}.jointTolerance * meanBlockSize(assembly);
    for (const auto& [first, second] : pairsWithoutJoint(assembly, blocksWithin(assembly, tolerance), points))
    {
        const Block<Dim>& one = assembly.blocks[first];
        const Block<Dim>& other = assembly.blocks[second];
        if (meetAtEdges(one, other, tolerance))
        {
            continue;
        }
        const bool isOn = !loneTouches(one, other, tolerance).empty();
        if (isOn || !loneTouches(other, one, tolerance).empty())
        {
            return fmt::format("{} touches {} {}", blockName(assembly, isOn ? first : second),
                               blockName(assembly, isOn ? second : first), cornersAreNoJoint<Dim>());
        }
    }
    return {};
}

template<int Dim>
std::string missingForceText(const Assembly<Dim>& assembly, const std::vector<ContactPoint<Dim>>& points)
{
    const std::string touching = touchWithoutJoint(assembly, points);
    return touching.empty() ? ""
                            : fmt::format("Limit analysis has no force where {}. In motion it would press "
                                          "there; `checkBlocks -allChecks` lists such places.",
                                          touching);
}

template<int Dim>
std::string instabilityCause(const Assembly<Dim>& assembly, const std::vector<ContactPoint<Dim>>& points)
{
    if (std::all_of(assembly.blocks.begin(), assembly.blocks.end(),
                    [](const Block<Dim>& block) { return block.support < 0; }))
    {
        return "Cause: no block is fixed. State supports in system/blockTextureDict, for instance `supports "
               "{ ground { type ground; } }`, and run blockTexture again.";
    }
    const std::vector<int> loose = blocksWithoutSupport(assembly, points);
    if (loose.empty())
    {
        const std::string touching = touchWithoutJoint(assembly, points);
        return touching.empty()
                   ? ""
                   : fmt::format("Possible cause: no force acts where {}; `checkBlocks -allChecks` "
                                 "lists such places.",
                                 touching);
    }
    const std::size_t shown = std::min(shownBlocks, loose.size());
    std::string text =
        fmt::format("Cause: {} with no path to a support through joints: {}{}. Nothing holds {}; checkBlocks "
                    "shows where.",
                    loose.size() == 1 ? "a block" : fmt::format("{} blocks", loose.size()),
                    fmt::join(loose.begin(), loose.begin() + static_cast<std::ptrdiff_t>(shown), " "),
                    shown < loose.size() ? " ..." : "", loose.size() == 1 ? "it" : "them");
    if (const std::string touching = cornerTouch(assembly, loose); !touching.empty())
    {
        text += fmt::format(" {} {}.", touching, cornersAreNoJoint<Dim>());
    }
    return text;
}

template std::vector<int> blocksWithoutSupport(const Assembly<2>& assembly,
                                               const std::vector<ContactPoint<2>>& points);
template std::vector<int> blocksWithoutSupport(const Assembly<3>& assembly,
                                               const std::vector<ContactPoint<3>>& points);
template std::string touchWithoutJoint(const Assembly<2>& assembly,
                                       const std::vector<ContactPoint<2>>& points);
template std::string touchWithoutJoint(const Assembly<3>& assembly,
                                       const std::vector<ContactPoint<3>>& points);
template std::string missingForceText(const Assembly<2>& assembly,
                                      const std::vector<ContactPoint<2>>& points);
template std::string missingForceText(const Assembly<3>& assembly,
                                      const std::vector<ContactPoint<3>>& points);
template std::string instabilityCause(const Assembly<2>& assembly,
                                      const std::vector<ContactPoint<2>>& points);
template std::string instabilityCause(const Assembly<3>& assembly,
                                      const std::vector<ContactPoint<3>>& points);

} // namespace drystone
