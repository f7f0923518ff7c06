// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// One refusal for each combination of entries that is not formulated, with the entry to change.
#include "statics/LimitAnalysisScope.h"

#include "core/Error.h"
#include "effects/JointLaws.h"

#include <fmt/format.h>

namespace drystone
{
namespace
{

/// Refuses what contact by surfaces is not formulated for.
void requireSurfaceContact(const LimitAnalysisCase<2>& structure)
{
    const SourceLocation place = structure.contact.locations.of("contact/formulation");
    if (structure.program.hasStrength() || structure.contact.pointsPerJoint || structure.pushover
        || structure.loads.movement)
    {
        throw FatalIOError(
            "`formulation surface;` is for joints with friction alone under a live load. Remove "
            "it, or cohesion, tension, crushing, pointsPerJoint, pushover and supportMovement.",
            place);
    }
    if (flowRuleOf(structure.contact) == FlowRule::nonAssociative)
    {
        throw FatalIOError("`formulation surface;` follows the associative flow rule only. Write `flowRule "
                           "associative;`, or remove the formulation.",
                           place);
    }
}

/// Steps of this part of the mean block size are too long for a curve to be one.
constexpr double longStep = 0.5;

/// Refuses what a capacity curve does not follow.
template<int Dim>
void requirePushover(const LimitAnalysisCase<Dim>& structure)
{
    for (const std::string key :
         {"cohesion", "tension", "crushing", "pointsPerJoint", "jointPoints", "joints"})
    {
        refuseEffect(structure.contact, "pushover", key);
    }
    const SourceLocation place = structure.solutionLocations.of("pushover");
    if (flowRuleOf(structure.contact) == FlowRule::nonAssociative)
    {
        throw FatalIOError(
            "pushover follows the associative flow rule only. Write `flowRule associative;` in "
            "constant/contactProperties.",
            place);
    }
    if (!structure.combinations.empty())
    {
        throw FatalIOError("pushover follows one pair of dead and live load. Remove pushover, or the "
                           "combinations of constant/loads.",
                           place);
    }
    const CaseLoads<Dim>& loads = structure.loads;
    if (loads.movement || !loads.positions.empty() || loads.multiplier != Multiplier::positive)
    {
        throw FatalIOError("pushover follows loads that stay on their blocks, with a positive multiplier. "
                           "Remove pushover, or "
                           "change the live load and `multiplier` of constant/loads.",
                           place);
    }
    if (liveForceOf<Dim>(loads) == 0)
    {
        throw FatalIOError(
            "pushover measures displacements in the direction of the live load, which has moments "
            "only. Remove pushover, or add a force to the live load of constant/loads.",
            place);
    }
    const double size = meanBlockSize(structure.assembly);
    if (structure.pushover->step > longStep * size)
    {
        printWarning(
            fmt::format("A step of {:g} m is long for blocks of {:.3g} m: blocks pass what they would "
                        "meet, and the end of the curve is that of no structure. Write for instance "
                        "`step {:.1g};`.",
                        structure.pushover->step, size, size / 50),
            structure.solutionLocations.of("pushover/step"));
    }
}

/// Refuses what the case requests and the plane does not have.
void requireAvailable(const LimitAnalysisCase<2>& structure)
{
    if (structure.contact.jointPoints)
    {
        throw FatalIOError(
            "jointPoints are for structures in space. Write `pointsPerJoint 11;`, or remove the entry.",
            structure.contact.locations.of("jointPoints"));
    }
    if (structure.pushover)
    {
        requirePushover(structure);
    }
    if (isSurfaceContact(structure.contact))
    {
        requireSurfaceContact(structure);
    }
}

/// Refuses what the case requests and space does not have.
void requireAvailable(const LimitAnalysisCase<3>& structure)
{
    if (structure.contact.pointsPerJoint)
    {
        throw FatalIOError(
            "pointsPerJoint divides joints of the plane. In space write `jointPoints { type grid; "
            "perSide 5; }`, or remove the entry: points inside a joint add nothing with friction alone.",
            structure.contact.locations.of("pointsPerJoint"));
    }
    if (isSurfaceContact(structure.contact))
    {
        throw FatalIOError(
            "`formulation surface;` is for joints of the plane. Remove it: points at the corners of a "
            "joint carry the same as its whole face.",
            structure.contact.locations.of("contact/formulation"));
    }
    if (structure.pushover)
    {
        requirePushover(structure);
    }
    if (jointPointsOf<AdaptivePoints>(structure.contact)
        && (structure.movement || flowRuleOf(structure.contact) == FlowRule::nonAssociative))
    {
        throw FatalIOError(
            "`jointPoints { type adaptive; }` goes by the mechanism of a live load with the associative "
            "flow rule. Write `jointPoints { type grid; perSide 5; }`, or remove supportMovement and "
            "`flowRule nonAssociative;`.",
            structure.contact.locations.of("jointPoints"));
    }
}

/// Refuses what loads do not go with.
template<int Dim>
void requireLoads(const LimitAnalysisCase<Dim>& structure)
{
    if (!structure.loads.positions.empty()
        && (structure.loads.multiplier != Multiplier::positive || structure.pushover))
    {
        throw FatalIOError("A moving load has the positive multiplier of each place, and no capacity curve: "
                           "remove `multiplier`, or pushover of system/solution/limitAnalysis.",
                           structure.loads.locations.of("live/type"));
    }
    if (structure.loads.movement)
    {
        if (structure.loads.multiplier != Multiplier::positive)
        {
            throw FatalIOError("A support that moves has no multiplier: reverse its direction instead.",
                               structure.loads.locations.of("multiplier"));
        }
        if (flowRuleOf(structure.contact) == FlowRule::nonAssociative)
        {
            throw FatalIOError("supportMovement follows the associative flow rule only. Write `flowRule "
                               "associative;` in constant/contactProperties.",
                               structure.loads.locations.of("live/type"));
        }
        if (structure.program.gap.isZero(0))
        {
            throw FatalIOError("The support that moves touches no block: nothing settles.",
                               structure.loads.locations.of("live/support"));
        }
    }
    if (structure.program.hasCrushing() && flowRuleOf(structure.contact) == FlowRule::nonAssociative)
    {
        throw FatalIOError(
            "limitAnalysis follows the non-associative flow rule with joints that do not crush. "
            "Write `flowRule associative;`, or remove crushing.",
            structure.contact.locations.of("friction/flowRule"));
    }
}

} // namespace

template<int Dim>
void requireInScope(const LimitAnalysisCase<Dim>& structure)
{
    requireAvailable(structure);
    requireLoads(structure);
}

template void requireInScope(const LimitAnalysisCase<2>& structure);
template void requireInScope(const LimitAnalysisCase<3>& structure);

} // namespace drystone
