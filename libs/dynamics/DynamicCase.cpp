// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/DynamicCase.h"

#include "assembly/Loads.h"
#include "assembly/Materials.h"
#include "contact/AlmostJoints.h"
#include "contact/ClosedAssembly.h"
#include "contact/Equilibrium.h"
#include "contact/Facing.h"
#include "contact/JointLaws.h"
#include "dynamics/MassDamping.h"

#include "runControl/Solution.h"

#include <fmt/format.h>

#include <algorithm>

namespace drystone
{

void setStructure(DynamicCase& scene, Assembly<2> assembly, const std::vector<double>& densities)
{
    scene.assembly = std::move(assembly);
    scene.blocks = blockMasses(scene.assembly);
    scene.free = freeIndices(scene.assembly);
    scene.mass = massDiagonal(scene.assembly, scene.blocks, densities);
    scene.blockSize = meanBlockSize(scene.assembly);
    double extent = 0;
    for (const Block<2>& block : scene.assembly.blocks)
    {
        for (const Vector<2>& corner : block.outline)
        {
            extent = std::max(extent, block.support < 0 ? corner.lpNorm<Eigen::Infinity>() : 0);
        }
    }
    scene.roundingGap = 64 * std::numeric_limits<double>::epsilon() * extent;
}

/// Refuses what some joints shall have and motion does not simulate.
void refuseCrushingJoints(const ContactProperties& contact, const std::filesystem::path& caseDirectory)
{
    for (const auto& [name, properties] : contact.joints)
    {
        if (properties.crushing)
        {
            throw FatalIOError(fmt::format("contactDynamics does not simulate crushing, which joint {} has. "
                                           "Remove the entry to compute without it.",
                                           name.text),
                               Dictionary::readFile(caseDirectory / "constant/contactProperties")
                                   .subDict("joints")
                                   .location());
        }
    }
}

/// The friction coefficients of joints that have one of their own.
std::vector<std::pair<std::pair<int, int>, double>>
frictionOfJoints(const std::filesystem::path& caseDirectory, const ContactProperties& contact,
                 const Assembly<2>& assembly)
{
    std::vector<std::pair<std::pair<int, int>, double>> result;
    if (contact.joints.empty())
    {
        return result;
    }
    const std::vector<ContactPoint<2>> points = findContactPoints(assembly); // sorted by pairs
    const std::vector<PointLaw> laws = pointLaws(caseDirectory, contact, assembly, points);
    const double ofAll = contact.friction ? contact.friction->mu : 0;
    for (std::size_t i = 0; i < points.size(); ++i)
    {
        const std::pair pair(points[i].block, points[i].neighbour);
        if (laws[i].mu != ofAll && (result.empty() || result.back().first != pair))
        {
            result.emplace_back(pair, laws[i].mu);
        }
    }
    return result;
}

/// What elastic contact points, and deletion, do not go together with.
void refuseCombinations(const DynamicCase& scene, const std::filesystem::path& caseDirectory)
{
    const auto locationOf = [&caseDirectory](const std::string& key)
    { return Dictionary::readFile(caseDirectory / "constant/contactProperties").locationOf(key); };
    if (scene.contact.deletion && scene.schemes.smallDisplacements)
    {
        throw FatalIOError(
            "With `smallDisplacements yes;` no block leaves where it was built: remove deletion, or "
            "set `smallDisplacements no;` in system/schemes.",
            locationOf("deletion"));
    }
    if (!scene.contact.elasticity)
    {
        return;
    }
    for (const std::string effect : {"cohesion", "tension"})
    {
        if (effect == "cohesion" ? scene.contact.cohesion : scene.contact.tension)
        {
            throw FatalIOError(
                fmt::format("Joints are either elastic or hold by {0}, which is rigid until it "
                            "breaks: remove elasticity, or {0}.",
                            effect),
                locationOf(effect));
        }
    }
    for (const auto& [name, properties] : scene.contact.joints)
    {
        if (properties.cohesion || properties.tension)
        {
            throw FatalIOError(fmt::format("Joints are either elastic or hold by cohesion and tension, which "
                                           "are rigid until they break: remove elasticity, or those of {}.",
                                           name.text),
                               locationOf("joints"));
        }
    }
    if (scene.contact.restitution)
    {
        throw FatalIOError("Elastic contact points rebound by themselves: remove restitution, or elasticity.",
                           locationOf("restitution"));
    }
    if (scene.schemes.timeIntegration.theta < 1)
    {
        throw FatalIOError("Elastic contact points are integrated with theta 1 only: set `theta 1;` in "
                           "system/schemes, or remove elasticity.",
                           locationOf("elasticity"));
    }
    if (scene.solution.solver == SolverType::interiorPoint
        || scene.solution.solver == SolverType::augmentedLagrangian)
    {
        throw FatalIOError(
            "Elastic contact points are solved by Newton's method of their own, or by gaussSeidel: set "
            "`solver automatic;` for contactDynamics in system/solution, or remove elasticity.",
            locationOf("elasticity"));
    }
}

DynamicCase readDynamicCase(const std::filesystem::path& caseDirectory)
{
    DynamicCase scene;
    scene.schemes = readSchemes(caseDirectory);
    scene.solution = readOptions<SolverChoice>(readSolution(caseDirectory, "contactDynamics"));
    Assembly<2> assembly = readAssembly(caseDirectory);
    refuseOverlaps(assembly, caseDirectory);
    refuseAlmostJoints(assembly, caseDirectory);
    scene.contact = readContactProperties(caseDirectory);
    refuseEffects(caseDirectory, "contactDynamics", {"crushing", "pointsPerJoint", "contact"});
    refuseCrushingJoints(scene.contact, caseDirectory);
    refuseCombinations(scene, caseDirectory);
    scene.gravity = readGravity(caseDirectory);
    if (scene.contact.damping && scene.contact.damping->equivalentToHousner)
    {
        scene.contact.damping->massProportional =
            equivalentDamping(*scene.contact.damping->equivalentToHousner, scene.gravity.norm());
    }
    scene.effects = stepEffects(scene.contact);
    scene.bonds = jointBonds(caseDirectory, scene.contact, assembly);
    scene.jointFriction = frictionOfJoints(caseDirectory, scene.contact, assembly);
    const std::vector<double> densities = readDensities(caseDirectory, assembly, scene.gravity);
    setStructure(scene, std::move(assembly), densities);
    const std::vector<double> masses = massesOf(scene.blocks, densities);
    scene.deadLoad =
        readLoads(caseDirectory, {scene.assembly, masses, scene.gravity}, LiveLoad::optional).dead;
    if (const auto file = caseDirectory / "constant/groundMotion"; std::filesystem::exists(file))
    {
        scene.groundMotion = readGroundMotion(Dictionary::readFile(file), caseDirectory);
    }
    scene.supportMotions = readSupportMotions(caseDirectory, scene.assembly);
    return scene;
}

Eigen::VectorXd loadUnder(const DynamicCase& scene, const Eigen::Vector3d& ground)
{
    Eigen::VectorXd load = scene.deadLoad;
    for (Eigen::Index row = 0; row < load.size(); row += 3)
    {
        load.segment<2>(row) -= scene.groundFactor * scene.mass[row] * ground.head<2>();
    }
    return load;
}

std::vector<double> frictionAt(const DynamicCase& scene, const std::vector<ContactPoint<2>>& points)
{
    std::vector<double> friction(points.size(), scene.contact.friction ? scene.contact.friction->mu : 0);
    for (std::size_t i = 0; !scene.jointFriction.empty() && i < points.size(); ++i)
    {
        const std::pair pair(points[i].block, points[i].neighbour);
        const auto own =
            std::lower_bound(scene.jointFriction.begin(), scene.jointFriction.end(), pair,
                             [](const auto& entry, const auto& key) { return entry.first < key; });
        if (own != scene.jointFriction.end() && own->first == pair)
        {
            friction[i] = own->second;
        }
    }
    return friction;
}

} // namespace drystone
