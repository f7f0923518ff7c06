// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
#include "statics/LimitAnalysisCase.h"

#include "assembly/AssemblyFile.h"
#include "assembly/Materials.h"
#include "contact/AlmostJoints.h"
#include "contact/ClosedAssembly.h"
#include "contact/CoveredSurface.h"
#include "contact/JointClosure.h"
#include "effects/EffectList.h"
#include "effects/JointLaws.h"
#include "runControl/Solution.h"
#include "statics/CrushingHinges.h"
#include "statics/JointDissipation.h"
#include "statics/Settlement.h"
#include "statics/SurfaceContact.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace drystone
{
namespace
{

/// By how much of the length of a joint its resultant may be beyond where it crushes, unless the tolerance of
/// the solver asks for less; and how many times points are added until then.
constexpr double hingeTolerance = 1e-7;
constexpr double looseHinges = 3e-3; ///< while other points are missing too
constexpr int mostHingeRounds = 30;

/// How many times the points that joints in space have at their corners and hinges refining may make of them:
/// then what is left is said beside the result.
constexpr std::size_t mostRefined = 20;
constexpr std::size_t alwaysRefined = 2000; ///< points that it may make of few, too

/// Multipliers of positions that differ by less, relative, are equal: those of a symmetric structure.
constexpr double sameMultiplier = 1e-7;

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

/// Null where there is none.
const PointGrid* gridOf(const ContactProperties& contact)
{
    return contact.jointPoints ? std::get_if<PointGrid>(&*contact.jointPoints) : nullptr;
}

const AdaptivePoints* adaptivePointsOf(const ContactProperties& contact)
{
    return contact.jointPoints ? std::get_if<AdaptivePoints>(&*contact.jointPoints) : nullptr;
}

std::vector<PointLaw> setContactPoints(LimitAnalysisCase<3>& structure)
{
    structure.points = findContactPoints(structure.assembly);
    if (!structure.contact.jointPoints && !namesStrength(structure.contact))
    {
        return pointLaws(structure.contact, structure.assembly, structure.points);
    }
    structure.patches = patchCells(structure.points);
    if (const PointGrid* grid = gridOf(structure.contact))
    {
        for (PatchCells& patch : structure.patches)
        {
            cutIntoGrid(patch, grid->perSide);
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
    if (adaptivePointsOf(structure.contact)
        && (structure.movement || flowRuleOf(structure.contact) == FlowRule::nonAssociative))
    {
        throw FatalIOError(
            "`jointPoints { type adaptive; }` goes by the mechanism of a live load with the associative "
            "flow rule. Write `jointPoints { type grid; perSide 5; }`, or remove supportMovement and "
            "`flowRule nonAssociative;`.",
            structure.contact.locations.of("jointPoints"));
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
void setLive(LimitAnalysisCase<Dim>& structure, const Eigen::VectorXd& live)
{
    structure.loads.live = live;
    structure.program.liveLoad = live;
}

/// Whether an answer is worse than another: no answer, then none at all that is carried, then the lower one.
bool isWorse(const LimitAnalysis& a, const LimitAnalysis& b)
{
    const auto rank = [](CollapseStatus status)
    {
        constexpr std::array worstFirst{CollapseStatus::notConverged, CollapseStatus::unstable,
                                        CollapseStatus::optimal, CollapseStatus::unbounded};
        return std::find(worstFirst.begin(), worstFirst.end(), status) - worstFirst.begin();
    };
    return rank(a.status) != rank(b.status)
               ? rank(a.status) < rank(b.status)
               : a.status == CollapseStatus::optimal && a.alpha < b.alpha * (1 - sameMultiplier);
}

template<int Dim>
std::vector<LimitAnalysis> solveAllWithPoints(const LimitAnalysisCase<Dim>& structure)
{
    std::vector<LimitAnalysis> results;
    if (!structure.loads.positions.empty())
    {
        LimitAnalysisCase<Dim> single = structure;
        single.loads.positions.clear();
        for (const LoadPosition<Dim>& position : structure.loads.positions)
        {
            setLive(single, position.live);
            results.push_back(solveWithPoints(single));
            results.back().position = static_cast<int>(results.size()) - 1;
        }
        return results;
    }
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

/// Adds points where joints crush in the answers, which are those of one structure.
/// \param tolerance of the length of a joint \return whether any was
template<int Dim>
bool addHinges(JointPoints<Dim>& joints, const std::vector<LimitAnalysis>& results, double tolerance)
{
    std::vector<Eigen::VectorXd> forces;
    for (const LimitAnalysis& result : results)
    {
        if (result.status == CollapseStatus::optimal)
        {
            forces.push_back(result.contactForce);
        }
    }
    return addCrushingHinges(joints, forces, tolerance);
}

/// By how much of itself a multiplier may exceed the bound of its mechanism; none where points are not added
/// for that.
std::optional<double> refinementTolerance(const LimitAnalysisCase<3>& structure)
{
    if (!structure.program.hasStrength() || structure.movement)
    {
        return std::nullopt;
    }
    const AdaptivePoints* adaptive = adaptivePointsOf(structure.contact);
    return adaptive                          ? adaptive->tolerance
           : structure.program.hasCrushing() ? std::optional(AdaptivePoints().tolerance)
                                             : std::nullopt;
}

/// What joints dissipate less over their cells in the answer that is farthest from the bound of its
/// mechanism; empty: in none by more than the tolerance, or there are as many points as may be.
std::vector<std::vector<double>> farthestFromItsBound(const LimitAnalysisCase<3>& structure,
                                                      const std::vector<LimitAnalysis>& results,
                                                      double tolerance)
{
    std::size_t corners = 0;
    for (const PatchCells& patch : structure.patches)
    {
        corners += patch.corners.size();
    }
    std::vector<std::vector<double>> farthest;
    double largest = structure.points.size() > alwaysRefined + mostRefined * corners
                         ? std::numeric_limits<double>::infinity()
                         : tolerance;
    for (const LimitAnalysis& result : results)
    {
        if (result.status != CollapseStatus::optimal || result.coulomb)
        {
            continue;
        }
        std::vector<std::vector<double>> less = dissipatedLessByCell(
            structure.program, structure.patches, liveLoadOf(structure, result), result.mechanism);
        double sum = 0;
        for (const std::vector<double>& ofPatch : less)
        {
            sum = std::accumulate(ofPatch.begin(), ofPatch.end(), sum);
        }
        if (sum > largest * std::abs(result.alpha))
        {
            largest = sum / std::abs(result.alpha);
            farthest = std::move(less);
        }
    }
    return farthest;
}

/// Adds points where the answers require them. \return whether any was
bool addPoints(LimitAnalysisCase<2>& structure, const std::vector<LimitAnalysis>& results)
{
    if (structure.contact.pointsPerJoint || !structure.program.hasCrushing())
    {
        return false;
    }
    JointPoints<2> joints{structure.points, structure.friction, structure.program.strength};
    if (!addHinges(joints, results, std::max(hingeTolerance, 10 * structure.solution.tolerance)))
    {
        return false;
    }
    structure.points = std::move(joints.points);
    structure.friction = std::move(joints.friction);
    structure.program = programOf(structure, std::move(joints.strength));
    return true;
}

bool addPoints(LimitAnalysisCase<3>& structure, const std::vector<LimitAnalysis>& results)
{
    if (gridOf(structure.contact))
    {
        return false;
    }
    JointPoints<3> joints{structure.patches, structure.points, structure.friction,
                          structure.program.strength};
    const double exact = std::max(hingeTolerance, 10 * structure.solution.tolerance);
    const auto addAt = [&](double tolerance)
    { return structure.program.hasCrushing() && addHinges(joints, results, tolerance); };
    // Hinges are lines and cost few points; what is left beside them is divided all over. Once joints are
    // twisted hinges need not be nearer than the rest.
    const std::optional<double> refinement = refinementTolerance(structure);
    bool isAny = addAt(std::max(exact, looseHinges));
    if (!isAny && refinement)
    {
        const std::vector<std::vector<double>> less = farthestFromItsBound(structure, results, *refinement);
        if (!less.empty())
        {
            refineJoints(joints, less);
            structure.isRefined = true;
            isAny = true;
        }
    }
    isAny = isAny || addAt(structure.isRefined ? std::max(exact, 0.1 * *refinement) : exact);
    if (isAny)
    {
        structure.patches = std::move(joints.patches);
        structure.points = std::move(joints.points);
        structure.friction = std::move(joints.friction);
        structure.program = programOf(structure, std::move(joints.strength));
    }
    return isAny;
}

/// Solves until no joint bears more than it can, and more points would not make much of a difference. \return
/// the answers; `notConverged` when that takes too long
template<int Dim, class Solve>
std::vector<LimitAnalysis> solveWithMorePoints(LimitAnalysisCase<Dim>& structure, const Solve& solve)
{
    std::vector<LimitAnalysis> results = solve(structure);
    for (int round = 0; addPoints(structure, results); ++round)
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
    const LoadContext<Dim> context{result.assembly, masses, gravity,
                                   [&result] { return coveredSurface(result.assembly); }};
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
    if (!loads.positions.empty() && (loads.multiplier != Multiplier::positive || result.pushover))
    {
        throw FatalIOError("A moving load has the positive multiplier of each place, and no capacity curve: "
                           "remove `multiplier`, or pushover of system/solution/limitAnalysis.",
                           loads.locations.of("live/type"));
    }
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
    if (!structure.loads.positions.empty())
    {
        return solveLimitAnalyses(structure).front();
    }
    return solveWithMorePoints(structure, [](const LimitAnalysisCase<Dim>& with)
                               { return std::vector<LimitAnalysis>{solveWithPoints(with)}; })
        .front();
}

template<int Dim>
std::vector<LimitAnalysis> solveLimitAnalyses(LimitAnalysisCase<Dim>& structure)
{
    std::vector<LimitAnalysis> results = solveWithMorePoints(structure, solveAllWithPoints<Dim>);
    if (structure.loads.positions.empty())
    {
        return results;
    }
    structure.envelope.clear();
    for (const LimitAnalysis& result : results)
    {
        structure.envelope.push_back({result.status, result.alpha});
    }
    const auto worst = std::min_element(results.begin(), results.end(), isWorse);
    setLive(structure, structure.loads.positions[worst - results.begin()].live);
    return {*worst};
}

template<int Dim>
const Eigen::VectorXd& liveLoadOf(const LimitAnalysisCase<Dim>& structure, const LimitAnalysis& result)
{
    if (result.position >= 0)
    {
        return structure.loads.positions[static_cast<std::size_t>(result.position)].live;
    }
    for (const auto& [name, loads] : structure.combinations)
    {
        if (name == result.combination)
        {
            return loads.live;
        }
    }
    return structure.loads.live;
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
template const Eigen::VectorXd& liveLoadOf(const LimitAnalysisCase<2>& structure,
                                           const LimitAnalysis& result);
template LimitAnalysisCase<3> readLimitAnalysisCase(const std::filesystem::path& caseDirectory,
                                                    std::optional<int> jointPoints);
template LimitAnalysisCase<3> readLimitAnalysisCase(const std::filesystem::path& caseDirectory,
                                                    Assembly<3> assembly, std::optional<int> jointPoints);
template LimitAnalysis solveLimitAnalysis(LimitAnalysisCase<3>& structure);
template std::vector<LimitAnalysis> solveLimitAnalyses(LimitAnalysisCase<3>& structure);
template const Eigen::VectorXd& liveLoadOf(const LimitAnalysisCase<3>& structure,
                                           const LimitAnalysis& result);
template Pushover solvePushover(const LimitAnalysisCase<2>& structure, const PushoverObserver<2>& observe);
template Pushover solvePushover(const LimitAnalysisCase<3>& structure, const PushoverObserver<3>& observe);

} // namespace drystone
