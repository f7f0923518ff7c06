// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The sentences of a limit analysis on standard output.
#include "functionObjects/LimitAnalysisLog.h"

#include "conic/MachineText.h"
#include "contact/JointClosure.h"
#include "contact/SupportPaths.h"
#include "core/Error.h"
#include "effects/EffectList.h"
#include "functionObjects/CollapseProgressLog.h"
#include "functionObjects/CoulombRangeLog.h"
#include "functionObjects/LimitAnalysisTables.h"
#include "functionObjects/LoadEnvelope.h"
#include "functionObjects/LoadMeaning.h"
#include "functionObjects/StrengthPlausibility.h"
#include "quantities/LimitAnalysisFigures.h"
#include "statics/JointDissipation.h"
#include "statics/SolveCase.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace drystone
{

namespace
{

template<int Dim>
std::string statusText(const LimitAnalysisCase<Dim>& structure, const LimitAnalysis& result)
{
    switch (result.status)
    {
    case CollapseStatus::optimal:
        return "optimal";
    case CollapseStatus::unstable:
        return "unstable (the blocks cannot carry the dead load: the mechanism is written)";
    case CollapseStatus::unbounded:
        if (!isProvedUnbounded(result))
        {
            return "unbounded (some forces carry any multiple of the live load, and no collapse by Coulomb's "
                   "law was found with others)";
        }
        return structure.movement ? "unbounded (no force moves the support in this direction)"
                                  : "unbounded (no load of this direction makes it collapse)";
    case CollapseStatus::upperBound:
        return std::isfinite(result.alpha)
                   ? "upper bound (no collapse by Coulomb's law was found; forces and mechanism are those of "
                     "the associative law)"
                   : "no answer (no collapse by Coulomb's law was found until maximumTime ended the search, "
                     "and by the associative law, which wedges blocks that slide, there is none: more time "
                     "may find one)";
    case CollapseStatus::notConverged:
        break;
    }
    return "not converged: there is no answer. Raise tolerance or maximumIterations in "
           "system/solution/limitAnalysis";
}

/// The multiplier, or the bound on it where no more is known, which tables do not have.
double knownAlpha(const LimitAnalysis& result)
{
    return result.status == CollapseStatus::upperBound ? result.alpha : tabledAlpha(result);
}

/// The beginning of a sentence on the live load: of one that moves with the place that the answer is of.
template<int Dim>
std::string whereText(const LimitAnalysisCase<Dim>& structure, const LimitAnalysis& result)
{
    if (structure.loads.positions.empty())
    {
        return "The";
    }
    const auto position = static_cast<std::size_t>(result.position);
    return fmt::format("At {}, the",
                       pathText(structure, {structure.loads.positions[position].distance, position, 0}));
}

/// Between alpha and what bounds it.
std::string_view boundSign(const LimitAnalysis& result)
{
    return result.isReversed ? ">=" : "<=";
}

/// The combination nearest to collapse.
void printGoverning(const std::vector<LimitAnalysis>& results)
{
    const auto demand = [](const LimitAnalysis& result)
    { return result.status == CollapseStatus::unstable ? 0 : std::abs(knownAlpha(result)); };
    const auto least = std::min_element(results.begin(), results.end(),
                                        [&](const auto& a, const auto& b) { return demand(a) < demand(b); });
    if (least->status == CollapseStatus::unstable)
    {
        info("Governing combination: {}, unstable under its dead load\n", least->combination);
    }
    else
    {
        info("Governing combination: {}, alpha {} {:.9g}\n", least->combination,
             least->status == CollapseStatus::upperBound ? boundSign(*least) : "=", knownAlpha(*least));
    }
}

/// What a mechanism dissipates less than the program has it, and the stress of its joints carries less, where
/// both are taken over whole faces and not at contact points.
struct WholeJoints
{
    double size = 0;        ///< that differences are compared with, see sizeOf
    double less = 0;        ///< of the multiplier, or more of a base reaction [N]
    double carriedLess = 0; ///< likewise, by an estimate
    std::string ofFaces;    ///< the bound of the whole faces
};

WholeJoints wholeJointsOf(const LimitAnalysisCase<3>& structure, const LimitAnalysis& result)
{
    const Eigen::VectorXd& live = liveLoadOf(structure, result);
    WholeJoints joints;
    joints.size = sizeOf(structure, result);
    joints.less = sumOf(dissipatedLessByCell(structure.program, structure.patches, live, result.mechanism));
    joints.carriedLess = sumOf(
        carriedLessByCell(structure.program, structure.patches, live, result.mechanism, result.contactForce));
    joints.ofFaces = structure.movement
                         ? fmt::format("a base reaction >= {:.6g} N, {:.3g} N more",
                                       result.alpha + joints.less, joints.less)
                         : fmt::format("alpha {} {:.6g}, {:.2g}% less", boundSign(result),
                                       result.alpha - std::copysign(joints.less, live.dot(result.mechanism)),
                                       100 * joints.less / joints.size);
    return joints;
}

void warnOfCarriedLess(const LimitAnalysisCase<3>& structure, const WholeJoints& joints)
{
    printWarning(fmt::format(
        "The stress that joints bear over their faces carries less than their {} contact points: by an "
        "estimate {}. {}",
        structure.points.size(),
        structure.movement ? fmt::format("the base reaction is {:.3g} N more", joints.carriedLess)
                           : fmt::format("{:.2g}% less than alpha", 100 * joints.carriedLess / joints.size),
        jointPointsOf<PointGrid>(structure.contact)
            ? structure.movement ? "Give a finer grid."
                                 : "Give a finer grid, or `jointPoints { type adaptive; }`."
            : "No more points are added; `jointPoints { type grid; }` may have more."));
}

std::string boundOfFaces(const LimitAnalysisCase<3>& structure, const WholeJoints& joints)
{
    return fmt::format("Over the whole faces of its joints this mechanism has {}: strengths act at contact "
                       "points. With {} both come nearer to the exact {}.",
                       joints.ofFaces,
                       structure.movement
                           ? "a finer grid, `jointPoints { type grid; perSide 9; }` say,"
                           : "`jointPoints { type adaptive; tolerance 1e-4; }` or a finer grid",
                       structure.movement ? "reaction" : "multiplier");
}

/// In space, where joints have strengths: by how much their points are on the unsafe side.
void printWholeJoints(const LimitAnalysisCase<2>&, const LimitAnalysis&) {}
void printWholeJoints(const LimitAnalysisCase<3>& structure, const LimitAnalysis& result)
{
    constexpr double worthSaying = 1e-5;
    constexpr double worthWarning = 0.02;
    if (result.coulomb || sizeOf(structure, result) == 0)
    {
        return;
    }
    const WholeJoints joints = wholeJointsOf(structure, result);
    const AdaptivePoints* adaptive = jointPointsOf<AdaptivePoints>(structure.contact);
    const double tolerance = adaptive ? adaptive->tolerance : AdaptivePoints().tolerance;
    if (adaptive && joints.less > tolerance * joints.size)
    {
        printWarning(
            fmt::format("The tolerance {:g} of jointPoints is not reached: over the whole faces of its "
                        "joints this mechanism has {}. With {} contact points "
                        "no more are added.",
                        tolerance, joints.ofFaces, structure.points.size()));
    }
    else if (joints.carriedLess > std::max(joints.less, 2 * tolerance * joints.size))
    {
        warnOfCarriedLess(structure, joints);
    }
    else if (joints.less > worthWarning * joints.size)
    {
        printWarning(boundOfFaces(structure, joints));
    }
    else if (joints.less > worthSaying * joints.size)
    {
        printLine(boundOfFaces(structure, joints));
    }
}

/// Why no answer is found with a part of the blocks.
template<int Dim>
std::string whyAllBlocks(const LimitAnalysisCase<Dim>& structure)
{
    if (structure.movement)
    {
        return "a support moves";
    }
    if (flowRuleOf(structure.contact) == FlowRule::nonAssociative)
    {
        return "by Coulomb's law collapse depends on forces everywhere";
    }
    if (isSurfaceContact(structure.contact))
    {
        return "joints are one surface each";
    }
    return "a live load acts on a third of them or more, they are fewer than 100, or no part stands for all";
}

/// How many of the answers `selection automatic` has found with a part of the blocks.
template<int Dim>
void printPartUse(const LimitAnalysisCase<Dim>& structure)
{
    const PartUse& use = structure.partUse;
    if (structure.effects.selection != EffectSelection::automatic)
    {
        return;
    }
    if (use.ofParts == 0)
    {
        info("Effects that were called for: all blocks, since {}.", whyAllBlocks(structure));
        return;
    }
    info("Effects that were called for: {} of {} answers from a part of the blocks, {:.3g} of {} in the "
         "mean; the others provably stay at rest.",
         use.ofParts, use.answers, use.blocks / use.ofParts, structure.freeBlocks);
    if (use.verified > 0)
    {
        info("Verified with all blocks: {} answers, largest difference of alpha {:.2g}.", use.verified,
             use.largestDifference);
    }
}

/// What the case has of effects and motions that blocks at rest do not have, taken out of the effects that
/// are absent: they are there.
std::vector<std::string> ofMotionAlone(const ContactProperties& contact,
                                       const std::filesystem::path& caseDirectory,
                                       std::vector<std::string>& absent)
{
    std::vector<std::string> given;
    const auto isThere = [&](const std::string& name)
    { return contact.locations.has(name) || std::filesystem::exists(caseDirectory / "constant" / name); };
    for (const std::string& name : absent)
    {
        if (isThere(name))
        {
            given.push_back(name);
        }
    }
    std::erase_if(absent, isThere);
    if (std::filesystem::exists(caseDirectory / "0/motion"))
    {
        given.emplace_back("0/motion");
    }
    return given;
}

} // namespace

template<int Dim>
void printLimitAnalysisCase(const LimitAnalysisCase<Dim>& structure,
                            const std::filesystem::path& caseDirectory)
{
    ContactProperties atRest = structure.contact;
    atRest.restitution.reset(); // there are no impacts
    auto [simulated, absent] = effectNamesAtRest(atRest);
    const std::vector<std::string> ofMotion = ofMotionAlone(structure.contact, caseDirectory, absent);
    (structure.movement ? simulated : absent).emplace_back("supportMovement");
    (structure.pushover ? simulated : absent).emplace_back("pushover");
    printEffects(simulated, absent, ofMotion);
    info("Blocks: {} free, contact points: {}", structure.freeBlocks, structure.points.size());
    for (const std::string& sentence : caseMeaning<Dim>(structure.loads))
    {
        printLine(sentence);
    }
    printClosure(structure.assembly);
    if (const std::string missing = missingForceText(structure.assembly, structure.points); !missing.empty())
    {
        printWarning(missing);
    }
    if (Dim == 2 && structure.contact.pointsPerJoint
        && std::any_of(structure.program.strength.begin(), structure.program.strength.end(),
                       [](const Strength& strength) { return strength.isBounded(); }))
    {
        printWarning(
            fmt::format("Joints that crush bear at the {} points of pointsPerJoint: alpha may be more "
                        "than the stress over whole joints gives. Without the key points are added "
                        "where that takes them.",
                        *structure.contact.pointsPerJoint));
    }
    info("Solver: {}, tolerance {:g}", nameOf(structure.solution.solver), structure.solution.tolerance);
    info("{}\n", machineText());
}

namespace
{

/// The loads, also where there is no multiplier: "no load of this direction" says which that is.
template<int Dim>
void printLoads(const LimitAnalysisCase<Dim>& structure, const LimitAnalysis& result)
{
    for (const std::string& sentence : loadMeaning(structure, result))
    {
        printLine(sentence);
    }
}

/// The multiplier, as far as there is one, and what it means.
template<int Dim>
void printMultiplier(const LimitAnalysisCase<Dim>& structure, const LimitAnalysis& result)
{
    if (result.status == CollapseStatus::optimal)
    {
        if (structure.movement)
        {
            info("Base reaction of {} against its movement = {:.9g} N",
                 structure.assembly.supports[structure.movement->support].name, result.alpha);
        }
        info("Collapse load multiplier alpha = {:.9g}", result.alpha + 0.0); // no -0
        if (structure.movement)
        {
            info("alpha is that base reaction in N, and not a multiple of a load");
        }
        printWholeJoints(structure, result);
        printLoads(structure, result);
    }
    else if (structure.loads.positions.empty()) // a load that moves has no one resultant
    {
        printLoads(structure, result);
    }
    if (result.status == CollapseStatus::upperBound && std::isfinite(result.alpha))
    {
        info("Collapse load multiplier alpha {} {:.9g}", boundSign(result), result.alpha);
    }
    if (result.coulomb)
    {
        printCoulombRange(*result.coulomb, result);
    }
}

/// How the analysis has ended, and what is to be known where it is no collapse.
template<int Dim>
void printStatus(const LimitAnalysisCase<Dim>& structure, const LimitAnalysis& result)
{
    info("Status: {}", statusText(structure, result));
    if (result.held)
    {
        info("{} live load holds the blocks up: they stand for alpha from {} to {}",
             whereText(structure, result), alphaText(result.held->least), alphaText(result.held->largest));
    }
    else if (result.status == CollapseStatus::unstable)
    {
        if (const std::string cause = instabilityCause(structure.assembly, structure.points); !cause.empty())
        {
            printLine(cause);
        }
    }
}

} // namespace

template<int Dim>
void printLimitAnalysis(const LimitAnalysisCase<Dim>& structure, const std::vector<LimitAnalysis>& results)
{
    printEnvelope(structure);
    printPartUse(structure);
    for (const LimitAnalysis& result : results)
    {
        if (!result.combination.empty())
        {
            info("Combination {}", result.combination);
        }
        printMultiplier(structure, result);
        printStatus(structure, result);
        question(doubtsAboutCrushing(structure, result));
        question(doubtsAboutLargeStrengths(structure.contact, result));
        const Certificate& certificate = result.certificate;
        info(
            "Certificate: primal residual = {:.3e}, dual residual = {:.3e}, gap = {:.3e}, No Iterations {}\n",
            certificate.primalResidual, certificate.dualResidual, certificate.dualityGap, result.iterations);
    }
    printCutShort(structure, results);
    if (!structure.combinations.empty())
    {
        printGoverning(results);
    }
    else if (results.size() == 2 && results[0].status != CollapseStatus::unstable)
    {
        info("Range of load multipliers: {:.9g} to {:.9g}\n",
             results[1].status == CollapseStatus::unbounded ? -tabledAlpha(results[1])
                                                            : results[1].alpha + 0.0, // no -0
             knownAlpha(results[0]));
    }
}

template void printLimitAnalysisCase(const LimitAnalysisCase<2>& structure,
                                     const std::filesystem::path& caseDirectory);
template void printLimitAnalysisCase(const LimitAnalysisCase<3>& structure,
                                     const std::filesystem::path& caseDirectory);
template void printLimitAnalysis(const LimitAnalysisCase<2>& structure,
                                 const std::vector<LimitAnalysis>& results);
template void printLimitAnalysis(const LimitAnalysisCase<3>& structure,
                                 const std::vector<LimitAnalysis>& results);

} // namespace drystone
