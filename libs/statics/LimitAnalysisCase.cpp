// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
#include "statics/LimitAnalysisCase.h"

#include "assembly/AssemblyFile.h"
#include "assembly/Materials.h"
#include "contact/AlmostJoints.h"
#include "contact/ClosedAssembly.h"
#include "contact/JointClosure.h"
#include "effects/EffectList.h"
#include "effects/JointLaws.h"
#include "runControl/Solution.h"
#include "statics/CrushingHinges.h"
#include "statics/Settlement.h"
#include "statics/SurfaceContact.h"

#include <algorithm>
#include <cmath>

namespace drystone
{
namespace
{

/// By how much of the length of a joint its resultant may be beyond where it crushes, unless the tolerance of
/// the solver asks for less; and how many times points are added until then.
constexpr double hingeTolerance = 1e-7;
constexpr int mostHingeRounds = 30;

/// Finds the points and reads what each carries.
std::vector<PointLaw> setContactPoints(LimitAnalysisCase<2>& structure)
{
    const int pointsPerJoint = structure.contact.pointsPerJoint.value_or(2);
    structure.points = findContactPoints(structure.assembly);
    if (pointsPerJoint > 2)
    {
        structure.points = divideJoints(structure.points, pointsPerJoint);
    }
    return pointLaws(structure.contact, structure.assembly, structure.points);
}

/// Whether any joint is given a cohesion, a tension or a pressure that it bears.
bool namesStrength(const ContactProperties& contact)
{
    const auto isAmong = [](const auto& properties)
    { return properties.cohesion || properties.tension || properties.crushing; };
    return isAmong(contact)
           || std::any_of(contact.joints.begin(), contact.joints.end(),
                          [&](const auto& joint) { return isAmong(joint.second); });
}

std::vector<PointLaw> setContactPoints(LimitAnalysisCase<3>& structure)
{
    structure.points = findContactPoints(structure.assembly);
    if (!structure.contact.jointPoints && !namesStrength(structure.contact))
    {
        return pointLaws(structure.contact, structure.assembly, structure.points);
    }
    structure.patches = patchCells(structure.points);
    if (structure.contact.jointPoints)
    {
        for (PatchCells& patch : structure.patches)
        {
            cutIntoGrid(patch, structure.contact.jointPoints->perSide);
        }
    }
    structure.points = pointsOf(structure.patches);
    return pointLaws(structure.contact, structure.assembly, structure.points, areasOf(structure.patches));
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

/// The program of the points that the structure has.
template<int Dim>
StaticProgram<Dim> programOf(const LimitAnalysisCase<Dim>& structure, std::vector<Strength> strengths)
{
    StaticProgram<Dim> program = limitAnalysisProgram(
        structure.freeBlocks,
        equilibriumColumns(structure.assembly, blockMasses(structure.assembly), structure.points),
        structure.friction, structure.loads);
    program.strength = std::move(strengths);
    if (structure.movement)
    {
        program.liveLoad.resize(0);
        program.gap = settlementGaps(structure.assembly, structure.points, *structure.movement);
    }
    return program;
}

bool isSurfaceContact(const ContactProperties& contact)
{
    return contact.contact && contact.contact->formulation == ContactFormulation::surface;
}

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
    bool hasMoments = loads.movement.has_value();
    for (Eigen::Index row = 0; row < loads.dead.size() && !hasMoments; ++row)
    {
        hasMoments = row % freedomCount<Dim> >= Dim && (loads.dead[row] != 0 || loads.live[row] != 0);
    }
    if (hasMoments || loads.multiplier != Multiplier::positive)
    {
        throw FatalIOError(
            "pushover follows loads at the mass centres with a positive multiplier: gravity and "
            "inertial. Remove pushover, or change constant/loads.",
            place);
    }
}

/// Refuses what the case asks for and the plane does not have.
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

/// Refuses what the case asks for and space does not have.
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
}

LimitAnalysis solveWithPoints(const LimitAnalysisCase<2>& structure)
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
               ? solveNonAssociative(structure.program, structure.nonAssociative, solver)
               : solveLimitAnalysis(structure.program, solver);
}

LimitAnalysis solveWithPoints(const LimitAnalysisCase<3>& structure)
{
    const InteriorPointSettings solver = interiorPointSettings(structure.solution);
    return structure.movement ? solveSettlement(structure.program, solver)
           : flowRuleOf(structure.contact) == FlowRule::nonAssociative
               ? solveNonAssociative(structure.program, structure.nonAssociative, solver)
               : solveLimitAnalysis(structure.program, solver);
}

template<int Dim>
std::vector<LimitAnalysis> solveAllWithPoints(const LimitAnalysisCase<Dim>& structure)
{
    std::vector<LimitAnalysis> results;
    if (!structure.combinations.empty())
    {
        for (const auto& [name, loads] : structure.combinations)
        {
            LimitAnalysisCase<Dim> single = structure;
            single.combinations.clear();
            static_cast<LoadVectors&>(single.loads) = loads;
            single.multiplier = loads.multiplier;
            single.program.load = loads.dead;
            single.program.liveLoad = loads.live;
            for (LimitAnalysis& result : solveAllWithPoints(single))
            {
                result.combination = name;
                results.push_back(std::move(result));
            }
        }
        return results;
    }
    if (structure.multiplier != Multiplier::negative)
    {
        results.push_back(solveWithPoints(structure));
    }
    if (structure.multiplier != Multiplier::positive)
    {
        LimitAnalysisCase<Dim> reversed = structure;
        reversed.program.liveLoad *= -1;
        reversed.loads.live *= -1;
        results.push_back(solveWithPoints(reversed));
        results.back().alpha *= -1;
    }
    return results;
}

JointPoints<2> jointPointsOf(const LimitAnalysisCase<2>& structure)
{
    return {structure.points, structure.friction, structure.program.strength};
}

JointPoints<3> jointPointsOf(const LimitAnalysisCase<3>& structure)
{
    return {structure.patches, structure.points, structure.friction, structure.program.strength};
}

/// Adds points where joints crush in the answers, which are those of one structure. \return whether any was
template<int Dim>
bool addHinges(LimitAnalysisCase<Dim>& structure, const std::vector<LimitAnalysis>& results)
{
    if (structure.contact.pointsPerJoint || structure.contact.jointPoints || !structure.program.hasCrushing())
    {
        return false;
    }
    std::vector<Eigen::VectorXd> forces;
    for (const LimitAnalysis& result : results)
    {
        if (result.status == CollapseStatus::optimal)
        {
            forces.push_back(result.contactForce);
        }
    }
    JointPoints<Dim> joints = jointPointsOf(structure);
    if (!addCrushingHinges(joints, forces, std::max(hingeTolerance, 10 * structure.solution.tolerance)))
    {
        return false;
    }
    if constexpr (Dim == 3)
    {
        structure.patches = std::move(joints.patches);
    }
    structure.points = std::move(joints.points);
    structure.friction = std::move(joints.friction);
    structure.program = programOf(structure, std::move(joints.strength));
    return true;
}

/// Solves until no joint bears more than it can. \return the answers; `notConverged` when that takes too long
template<int Dim, class Solve>
std::vector<LimitAnalysis> solveWithHinges(LimitAnalysisCase<Dim>& structure, const Solve& solve)
{
    std::vector<LimitAnalysis> results = solve(structure);
    for (int round = 0; addHinges(structure, results); ++round)
    {
        const std::vector<LimitAnalysis> before = std::move(results);
        results = solve(structure);
        for (std::size_t i = 0; i < results.size(); ++i)
        {
            results[i].iterations += before[i].iterations;
            results[i].factorisations += before[i].factorisations;
            results[i].solves += before[i].solves;
            if (round == mostHingeRounds)
            {
                results[i].status = CollapseStatus::notConverged;
            }
        }
        if (round == mostHingeRounds)
        {
            break;
        }
    }
    return results;
}

} // namespace

void declare(Options& options, LimitAnalysisControls& controls)
{
    declare(options, controls.solver);
    options.optional("nonAssociative", controls.nonAssociative,
                     "how the lowest collapse with `flowRule nonAssociative;` is searched for");
    options.optional(
        "pushover", controls.pushover,
        "capacity curve: the multiplier as the structure moves on, until it needs none; in space blocks "
        "touch where faces face each other");
}

template<int Dim>
LimitAnalysisCase<Dim> readLimitAnalysisCase(const std::filesystem::path& caseDirectory,
                                             std::optional<int> jointPoints)
{
    return readLimitAnalysisCase(caseDirectory, readAssembly<Dim>(caseDirectory), jointPoints);
}

template<int Dim>
LimitAnalysisCase<Dim> readLimitAnalysisCase(const std::filesystem::path& caseDirectory,
                                             Assembly<Dim> assembly, std::optional<int> jointPoints)
{
    LimitAnalysisCase<Dim> result;
    const Dictionary solution = readSolution(caseDirectory, "limitAnalysis");
    const auto controls = readOptions<LimitAnalysisControls>(solution);
    result.solutionLocations = EntryLocations(solution);
    result.solution = controls.solver;
    result.nonAssociative = controls.nonAssociative;
    result.pushover = controls.pushover;
    if (solvesMotionOnly(result.solution.solver))
    {
        throw FatalIOError(nameOf(result.solution.solver)
                               + " solves steps in time only. Write `solver interiorPoint;`.",
                           result.solutionLocations.of("solver"));
    }
    result.solution.solver = SolverType::interiorPoint;
    result.assembly = std::move(assembly);
    refuseOverlaps(result.assembly, caseDirectory);
    refuseAlmostJoints(result.assembly, caseDirectory);
    requireFreeBlock(result.assembly, caseDirectory);

    result.contact = readContactProperties(caseDirectory);
    if (jointPoints && Dim == 2)
    {
        result.contact.pointsPerJoint = jointPoints;
    }
    if (jointPoints && Dim == 3)
    {
        result.contact.jointPoints = PointGrid{*jointPoints};
    }
    const Vector<Dim> gravity = readGravity<Dim>(caseDirectory);
    const std::vector<BlockMass<Dim>> blocks = blockMasses(result.assembly);
    const std::vector<double> masses =
        massesOf(blocks, readDensities(caseDirectory, result.assembly, gravity));
    const LoadContext<Dim> context{result.assembly, masses, gravity};
    result.combinations = readLoadCombinations(caseDirectory, context);
    CaseLoads<Dim> loads;
    if (result.combinations.empty())
    {
        loads = readLoads(caseDirectory, context, LiveLoad::required);
    }
    else
    {
        static_cast<LoadVectors&>(loads) = result.combinations.front().second;
    }

    const std::vector<PointLaw> laws = setContactPoints(result);
    for (const PointLaw& law : laws)
    {
        result.friction.push_back(law.mu);
    }
    result.freeBlocks = static_cast<int>(loads.dead.size()) / freedomCount<Dim>;
    result.loads = loads;
    result.movement = loads.movement;
    result.program = programOf(result, strengthsOf(laws));
    requireAvailable(result);
    result.multiplier = loads.multiplier;
    if (loads.movement)
    {
        if (loads.multiplier != Multiplier::positive)
        {
            throw FatalIOError("A support that moves has no multiplier: reverse its direction instead.",
                               loads.locations.of("multiplier"));
        }
        if (flowRuleOf(result.contact) == FlowRule::nonAssociative)
        {
            throw FatalIOError("supportMovement follows the associative flow rule only. Write `flowRule "
                               "associative;` in constant/contactProperties.",
                               loads.locations.of("live/type"));
        }
        if (result.program.gap.isZero(0))
        {
            throw FatalIOError("The support that moves touches no block: nothing settles.",
                               loads.locations.of("live/support"));
        }
    }
    if (result.program.hasCrushing() && flowRuleOf(result.contact) == FlowRule::nonAssociative)
    {
        throw FatalIOError(
            "limitAnalysis follows the non-associative flow rule with joints that do not crush. "
            "Write `flowRule associative;`, or remove crushing.",
            result.contact.locations.of("friction/flowRule"));
    }
    return result;
}

template<int Dim>
LimitAnalysis solveLimitAnalysis(LimitAnalysisCase<Dim>& structure)
{
    return solveWithHinges(structure, [](const LimitAnalysisCase<Dim>& with)
                           { return std::vector<LimitAnalysis>{solveWithPoints(with)}; })
        .front();
}

template<int Dim>
std::vector<LimitAnalysis> solveLimitAnalyses(LimitAnalysisCase<Dim>& structure)
{
    return solveWithHinges(structure, solveAllWithPoints<Dim>);
}

template<int Dim>
Pushover solvePushover(const LimitAnalysisCase<Dim>& structure, const PushoverObserver<Dim>& observe)
{
    const double mu = structure.contact.friction ? structure.contact.friction->mu : 0;
    return solvePushover(PushoverScene<Dim>{structure.assembly, mu, structure.loads}, *structure.pushover,
                         interiorPointSettings(structure.solution), observe);
}

template LimitAnalysisCase<2> readLimitAnalysisCase(const std::filesystem::path& caseDirectory,
                                                    std::optional<int> jointPoints);
template LimitAnalysisCase<2> readLimitAnalysisCase(const std::filesystem::path& caseDirectory,
                                                    Assembly<2> assembly, std::optional<int> jointPoints);
template LimitAnalysis solveLimitAnalysis(LimitAnalysisCase<2>& structure);
template std::vector<LimitAnalysis> solveLimitAnalyses(LimitAnalysisCase<2>& structure);
template LimitAnalysisCase<3> readLimitAnalysisCase(const std::filesystem::path& caseDirectory,
                                                    std::optional<int> jointPoints);
template LimitAnalysisCase<3> readLimitAnalysisCase(const std::filesystem::path& caseDirectory,
                                                    Assembly<3> assembly, std::optional<int> jointPoints);
template LimitAnalysis solveLimitAnalysis(LimitAnalysisCase<3>& structure);
template std::vector<LimitAnalysis> solveLimitAnalyses(LimitAnalysisCase<3>& structure);
template Pushover solvePushover(const LimitAnalysisCase<2>& structure, const PushoverObserver<2>& observe);
template Pushover solvePushover(const LimitAnalysisCase<3>& structure, const PushoverObserver<3>& observe);

} // namespace drystone
