// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Refuses overlaps and joints that almost close, then joins contact, loads and strengths in a program.
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
#include "statics/LimitAnalysisScope.h"
#include "statics/Settlement.h"

#include <algorithm>
#include <cmath>

namespace drystone
{
namespace
{

/// Divides joints as the case requests it and reads what each point carries.
std::vector<PointLaw> setContactPoints(LimitAnalysisCase<2>& structure)
{
    const int pointsPerJoint = structure.contact.pointsPerJoint.value_or(2);
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
    if (!structure.contact.jointPoints && !namesStrength(structure.contact))
    {
        return pointLaws(structure.contact, structure.assembly, structure.points);
    }
    structure.patches = patchCells(structure.points);
    if (const PointGrid* grid = jointPointsOf<PointGrid>(structure.contact))
    {
        for (PatchCells& patch : structure.patches)
        {
            cutIntoGrid(patch, grid->perSide);
        }
    }
    structure.points = pointsOf(structure.patches);
    return pointLaws(structure.contact, structure.assembly, structure.points, areasOf(structure.patches));
}

std::vector<double> frictionsOf(const std::vector<PointLaw>& laws)
{
    std::vector<double> frictions;
    frictions.reserve(laws.size());
    for (const PointLaw& law : laws)
    {
        frictions.push_back(law.mu);
    }
    return frictions;
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

/// Reads what system/solution and system/schemes say of the analysis.
template<int Dim>
void readControls(LimitAnalysisCase<Dim>& structure, const std::filesystem::path& caseDirectory)
{
    const Dictionary solution = readSolution(caseDirectory, "limitAnalysis");
    const auto controls = readOptions<LimitAnalysisControls>(solution);
    structure.solutionLocations = EntryLocations(solution);
    structure.solution = controls.solver;
    structure.nonAssociative = controls.nonAssociative;
    structure.pushover = controls.pushover;
    structure.effects = readSchemes(caseDirectory).effects;
    if (solvesMotionOnly(structure.solution.solver))
    {
        throw FatalIOError(nameOf(structure.solution.solver)
                               + " solves steps in time only. Write `solver interiorPoint;`.",
                           structure.solutionLocations.of("solver"));
    }
    structure.solution.solver = SolverType::interiorPoint;
}

/// Reads the contact properties. \param jointPoints see readLimitAnalysisCase
template<int Dim>
void readContact(LimitAnalysisCase<Dim>& structure, const std::filesystem::path& caseDirectory,
                 std::optional<int> jointPoints)
{
    structure.contact = readContactProperties(caseDirectory);
    if (jointPoints && Dim == 2)
    {
        structure.contact.pointsPerJoint = jointPoints;
    }
    if (jointPoints && Dim == 3)
    {
        structure.contact.jointPoints = PointGrid{*jointPoints};
    }
}

/// Reads the loads, with combinations those of the first, and what they say of the analysis.
template<int Dim>
void readLoadsOfCase(LimitAnalysisCase<Dim>& structure, const std::filesystem::path& caseDirectory)
{
    const Vector<Dim> gravity = readGravity<Dim>(caseDirectory);
    const std::vector<BlockMass<Dim>> massOfBlocks = blockMasses(structure.assembly);
    const std::vector<double> masses =
        massesOf(massOfBlocks, readDensities(caseDirectory, structure.assembly, gravity));
    const LoadContext<Dim> context{structure.assembly, masses, gravity,
                                   [&structure] { return coveredSurface(structure.assembly); }};
    structure.combinations = readLoadCombinations(caseDirectory, context);
    if (structure.combinations.empty())
    {
        structure.loads = readLoads(caseDirectory, context, LiveLoad::required);
    }
    else
    {
        static_cast<LoadVectors&>(structure.loads) = structure.combinations.front().second;
    }
    structure.freeBlocks = static_cast<int>(structure.loads.dead.size()) / freedomCount<Dim>;
    structure.movement = structure.loads.movement;
    structure.multiplier = structure.loads.multiplier;
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

template<int Dim>
LimitAnalysisCase<Dim> readLimitAnalysisCase(const std::filesystem::path& caseDirectory,
                                             std::optional<int> jointPoints)
{
    return readLimitAnalysisCase(caseDirectory, readAssembly<Dim>(caseDirectory), jointPoints);
}

template<int Dim>
SoundStructure<Dim> soundStructure(const std::filesystem::path& caseDirectory, Assembly<Dim> assembly)
{
    refuseUnstatedOverlaps(assembly, caseDirectory);
    refuseAlmostJoints(assembly, caseDirectory);
    requireFreeBlock(assembly, caseDirectory);
    std::vector<ContactPoint<Dim>> points = findContactPoints(assembly);
    return {std::move(assembly), std::move(points)};
}

template<int Dim>
LimitAnalysisCase<Dim> readLimitAnalysisCase(const std::filesystem::path& caseDirectory,
                                             Assembly<Dim> assembly, std::optional<int> jointPoints)
{
    return readLimitAnalysisCase(caseDirectory, soundStructure(caseDirectory, std::move(assembly)),
                                 jointPoints);
}

template<int Dim>
LimitAnalysisCase<Dim> readLimitAnalysisCase(const std::filesystem::path& caseDirectory,
                                             SoundStructure<Dim> blocks, std::optional<int> jointPoints)
{
    LimitAnalysisCase<Dim> result;
    readControls(result, caseDirectory);
    result.assembly = std::move(blocks.assembly);
    result.points = std::move(blocks.points);
    readContact(result, caseDirectory, jointPoints);
    readLoadsOfCase(result, caseDirectory);
    const std::vector<PointLaw> laws = setContactPoints(result);
    result.friction = frictionsOf(laws);
    result.program = programOf(result, strengthsOf(laws));
    requireInScope(result);
    return result;
}

bool readContactAnew(LimitAnalysisCase<2>& structure, const std::filesystem::path& caseDirectory)
{
    ContactProperties contact = readContactProperties(caseDirectory);
    if (contact.pointsPerJoint != structure.contact.pointsPerJoint)
    {
        return false;
    }
    structure.contact = std::move(contact);
    const std::vector<PointLaw> laws = pointLaws(structure.contact, structure.assembly, structure.points);
    structure.friction = frictionsOf(laws);
    structure.program.friction = structure.friction;
    structure.program.strength = strengthsOf(laws);
    requireInScope(structure);
    return true;
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
double sizeOf(const LimitAnalysisCase<Dim>& structure, const LimitAnalysis& result)
{
    constexpr double leastPart = 0.01;
    constexpr int rows = 3 * (Dim - 1);
    double weight = 0;
    for (int body = 0; structure.movement && body < structure.freeBlocks; ++body)
    {
        weight += structure.program.load.template segment<Dim>(rows * body).norm();
    }
    return std::max(std::abs(result.alpha), leastPart * weight);
}

template StaticProgram<2> programOf(const LimitAnalysisCase<2>& structure, std::vector<Strength> strengths);
template StaticProgram<3> programOf(const LimitAnalysisCase<3>& structure, std::vector<Strength> strengths);
template LimitAnalysisCase<2> readLimitAnalysisCase(const std::filesystem::path& caseDirectory,
                                                    std::optional<int> jointPoints);
template LimitAnalysisCase<2> readLimitAnalysisCase(const std::filesystem::path& caseDirectory,
                                                    Assembly<2> assembly, std::optional<int> jointPoints);
template SoundStructure<2> soundStructure(const std::filesystem::path& caseDirectory, Assembly<2> assembly);
template LimitAnalysisCase<2> readLimitAnalysisCase(const std::filesystem::path& caseDirectory,
                                                    SoundStructure<2> blocks, std::optional<int> jointPoints);
template const Eigen::VectorXd& liveLoadOf(const LimitAnalysisCase<2>& structure,
                                           const LimitAnalysis& result);
template double sizeOf(const LimitAnalysisCase<2>& structure, const LimitAnalysis& result);
template LimitAnalysisCase<3> readLimitAnalysisCase(const std::filesystem::path& caseDirectory,
                                                    std::optional<int> jointPoints);
template LimitAnalysisCase<3> readLimitAnalysisCase(const std::filesystem::path& caseDirectory,
                                                    Assembly<3> assembly, std::optional<int> jointPoints);
template SoundStructure<3> soundStructure(const std::filesystem::path& caseDirectory, Assembly<3> assembly);
template LimitAnalysisCase<3> readLimitAnalysisCase(const std::filesystem::path& caseDirectory,
                                                    SoundStructure<3> blocks, std::optional<int> jointPoints);
template const Eigen::VectorXd& liveLoadOf(const LimitAnalysisCase<3>& structure,
                                           const LimitAnalysis& result);
template double sizeOf(const LimitAnalysisCase<3>& structure, const LimitAnalysis& result);

} // namespace drystone
