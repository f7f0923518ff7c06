// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
#include "statics/LimitAnalysisCase.h"

#include "assembly/AssemblyChecks.h"
#include "assembly/AssemblyFile.h"
#include "assembly/JointLaws.h"
#include "assembly/Materials.h"
#include "core/Solution.h"
#include "statics/Settlement.h"
#include "statics/SurfaceContact.h"

#include <algorithm>
#include <cmath>

namespace drystone
{
namespace
{

/// With crushing, hinges move inwards from the ends of a joint: the points that they move along.
constexpr int pointsToCrush = 11;

std::vector<ContactPoint<2>> contactPoints(const Assembly<2>& assembly, const ContactProperties& contact)
{
    const bool canCrush = contact.crushing
                          || std::any_of(contact.joints.begin(), contact.joints.end(),
                                         [](const auto& joint) { return joint.second.crushing.has_value(); });
    const int count = contact.pointsPerJoint.value_or(canCrush ? pointsToCrush : 2);
    std::vector<ContactPoint<2>> ends = findContactPoints(assembly);
    return count > 2 ? divideJoints(ends, count) : ends;
}

/// Empty where no point has any: cones cost less.
std::vector<Strength> strengthsOf(const std::vector<PointLaw>& laws)
{
    std::vector<Strength> strengths;
    strengths.reserve(laws.size());
    bool isAny = false;
    for (const PointLaw& law : laws)
    {
        strengths.push_back({law.cohesion, law.tension, law.crushing});
        isAny = isAny || law.cohesion > 0 || law.tension > 0 || std::isfinite(law.crushing);
    }
    return isAny ? strengths : std::vector<Strength>();
}

FlowRule flowRuleOf(const ContactProperties& contact)
{
    return contact.friction ? contact.friction->flowRule : FlowRule::associative;
}

bool isSurfaceContact(const ContactProperties& contact)
{
    return contact.contact && contact.contact->formulation == ContactFormulation::surface;
}

/// Refuses what contact by surfaces is not formulated for.
void requireSurfaceContact(const LimitAnalysisCase& structure, const std::filesystem::path& caseDirectory)
{
    const Dictionary dictionary = Dictionary::readFile(caseDirectory / "constant/contactProperties");
    const SourceLocation place = dictionary.subDict("contact").locationOf("formulation");
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

/// Refuses what a capacity curve does not follow.
void requirePushover(const LimitAnalysisCase& structure, const std::filesystem::path& caseDirectory)
{
    refuseEffects(caseDirectory, "pushover", {"cohesion", "tension", "crushing", "pointsPerJoint", "joints"});
    const SourceLocation place = readSolution(caseDirectory, "limitAnalysis").locationOf("pushover");
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
    const LoadVectors& loads = structure.loads;
    bool hasMoments = loads.movement.has_value();
    for (Eigen::Index row = 2; row < loads.dead.size() && !hasMoments; row += 3)
    {
        hasMoments = loads.dead[row] != 0 || loads.live[row] != 0;
    }
    if (hasMoments || loads.multiplier != Multiplier::positive)
    {
        throw FatalIOError(
            "pushover follows loads at the mass centres with a positive multiplier: gravity and "
            "inertial. Remove pushover, or change constant/loads.",
            place);
    }
}

} // namespace

void declare(Options& options, LimitAnalysisControls& controls)
{
    declare(options, controls.solver);
    options.optional("nonAssociative", controls.nonAssociative,
                     "how the lowest collapse with `flowRule nonAssociative;` is searched for");
    options.optional("pushover", controls.pushover,
                     "capacity curve: the multiplier as the structure moves on, until it needs none");
}

LimitAnalysisCase readLimitAnalysisCase(const std::filesystem::path& caseDirectory,
                                        std::optional<int> pointsPerJoint)
{
    LimitAnalysisCase result;
    const auto controls = readOptions<LimitAnalysisControls>(readSolution(caseDirectory, "limitAnalysis"));
    result.solution = controls.solver;
    result.nonAssociative = controls.nonAssociative;
    result.pushover = controls.pushover;
    if (solvesMotionOnly(result.solution.solver))
    {
        throw FatalIOError(nameOf(result.solution.solver)
                               + " solves steps in time only. Write `solver interiorPoint;`.",
                           readSolution(caseDirectory, "limitAnalysis").locationOf("solver"));
    }
    result.solution.solver = SolverType::interiorPoint;
    result.assembly = readAssembly(caseDirectory);
    refuseOverlaps(result.assembly, caseDirectory);
    requireFreeBlock(result.assembly, caseDirectory);

    result.contact = readContactProperties(caseDirectory);
    if (pointsPerJoint)
    {
        result.contact.pointsPerJoint = pointsPerJoint;
    }
    const Vector<2> gravity = readGravity(caseDirectory);
    const std::vector<BlockMass<2>> blocks = blockMasses(result.assembly);
    const std::vector<double> masses =
        massesOf(blocks, readDensities(caseDirectory, result.assembly, gravity));
    const LoadContext context{result.assembly, masses, gravity};
    result.combinations = readLoadCombinations(caseDirectory, context);
    const LoadVectors loads = result.combinations.empty()
                                  ? readLoads(caseDirectory, context, LiveLoad::required)
                                  : result.combinations.front().second;

    result.points = contactPoints(result.assembly, result.contact);
    const std::vector<PointLaw> laws =
        pointLaws(caseDirectory, result.contact, result.assembly, result.points);
    for (const PointLaw& law : laws)
    {
        result.friction.push_back(law.mu);
    }
    result.freeBlocks = static_cast<int>(loads.dead.size()) / 3;
    result.program =
        limitAnalysisProgram(result.freeBlocks, equilibriumColumns(result.assembly, blocks, result.points),
                             result.friction, loads);
    result.program.strength = strengthsOf(laws);
    result.loads = loads;
    if (result.pushover)
    {
        requirePushover(result, caseDirectory);
    }
    if (isSurfaceContact(result.contact))
    {
        requireSurfaceContact(result, caseDirectory);
    }
    result.multiplier = loads.multiplier;
    result.movement = loads.movement;
    if (loads.movement)
    {
        result.program.liveLoad.resize(0);
        result.program.gap = settlementGaps(result.assembly, result.points, *loads.movement);
        const Dictionary dictionary = Dictionary::readFile(caseDirectory / "constant/loads");
        if (loads.multiplier != Multiplier::positive)
        {
            throw FatalIOError("A support that moves has no multiplier: reverse its direction instead.",
                               dictionary.locationOf("multiplier"));
        }
        if (flowRuleOf(result.contact) == FlowRule::nonAssociative)
        {
            throw FatalIOError("supportMovement follows the associative flow rule only. Write `flowRule "
                               "associative;` in constant/contactProperties.",
                               dictionary.subDict("live").locationOf("type"));
        }
        if (result.program.gap.isZero(0))
        {
            throw FatalIOError("The support that moves touches no block: nothing settles.",
                               dictionary.subDict("live").locationOf("support"));
        }
    }
    if (result.program.hasStrength() && flowRuleOf(result.contact) == FlowRule::nonAssociative)
    {
        const Dictionary dictionary = Dictionary::readFile(caseDirectory / "constant/contactProperties");
        throw FatalIOError("limitAnalysis follows the non-associative flow rule with friction alone. Write "
                           "`flowRule associative;`, or remove cohesion, tension and crushing.",
                           dictionary.subDict("friction").locationOf("flowRule"));
    }
    return result;
}

LimitAnalysis solveLimitAnalysis(const LimitAnalysisCase& structure)
{
    InteriorPointSettings solver = interiorPointSettings(structure.solution);
    if (isSurfaceContact(structure.contact))
    {
        // Closer, so that the certificate in resultants, whose residuals are sums, meets the tolerance too.
        const double tolerance = solver.tolerance;
        solver.tolerance *= 0.1;
        LimitAnalysis result = solveLimitAnalysis(structure.program, solver);
        const std::vector<JointResultant> joints =
            jointResultants(structure.points, structure.friction, result.contactForce);
        result.variables = 3 * static_cast<int>(joints.size()) + 1;
        if (result.status == CollapseStatus::optimal)
        {
            result.certificate = certifySurfaceContact(structure.assembly, joints, structure.loads, result);
            if (!(result.certificate.worst() <= tolerance))
            {
                result.status = CollapseStatus::notConverged;
            }
        }
        return result;
    }
    if (structure.movement)
    {
        return solveSettlement(structure.program, solver);
    }
    return flowRuleOf(structure.contact) == FlowRule::nonAssociative
               ? solveNonAssociative(structure.program, jointsOf(structure.points), structure.nonAssociative,
                                     solver)
               : solveLimitAnalysis(structure.program, solver);
}

std::vector<LimitAnalysis> solveLimitAnalyses(const LimitAnalysisCase& structure)
{
    std::vector<LimitAnalysis> results;
    if (!structure.combinations.empty())
    {
        for (const auto& [name, loads] : structure.combinations)
        {
            LimitAnalysisCase single = structure;
            single.combinations.clear();
            single.loads = loads;
            single.multiplier = loads.multiplier;
            single.program.load = loads.dead;
            single.program.liveLoad = loads.live;
            for (LimitAnalysis& result : solveLimitAnalyses(single))
            {
                result.combination = name;
                results.push_back(std::move(result));
            }
        }
        return results;
    }
    if (structure.multiplier != Multiplier::negative)
    {
        results.push_back(solveLimitAnalysis(structure));
    }
    if (structure.multiplier != Multiplier::positive)
    {
        LimitAnalysisCase reversed = structure;
        reversed.program.liveLoad *= -1;
        reversed.loads.live *= -1;
        results.push_back(solveLimitAnalysis(reversed));
        results.back().alpha *= -1;
    }
    return results;
}

Pushover solvePushover(const LimitAnalysisCase& structure, const PushoverObserver& observe)
{
    const double mu = structure.contact.friction ? structure.contact.friction->mu : 0;
    return solvePushover({structure.assembly, mu, structure.loads}, *structure.pushover,
                         interiorPointSettings(structure.solution), observe);
}

} // namespace drystone
