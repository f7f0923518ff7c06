// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Reading of a case in motion.
#include "dynamics/DynamicCase.h"

#include "assembly/Loads.h"
#include "assembly/Materials.h"
#include "contact/AlmostJoints.h"
#include "contact/ClosedAssembly.h"
#include "contact/Equilibrium.h"
#include "contact/Facing.h"
#include "contact/JointLaws.h"

#include "runControl/Solution.h"

#include <fmt/format.h>

#include <algorithm>

namespace drystone
{

namespace
{

/// The friction coefficients of joints that have one of their own.
template<int Dim>
std::vector<std::pair<std::pair<int, int>, double>>
frictionOfJoints(const std::filesystem::path& caseDirectory, const ContactProperties& contact,
                 const Assembly<Dim>& assembly)
{
    std::vector<std::pair<std::pair<int, int>, double>> result;
    if (contact.joints.empty())
    {
        return result;
    }
    const std::vector<ContactPoint<Dim>> points = findContactPoints(assembly); // sorted by pairs
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

/// Refuses effects that motion does not simulate, so that nobody takes a result for what it is not.
template<int Dim>
void refuseCrushing(const CaseEffects<Dim>& read)
{
    for (const std::string name : {"crushing", "pointsPerJoint", "jointPoints", "contact"})
    {
        if (read.locations.has(name))
        {
            throw FatalIOError(
                fmt::format("contactDynamics does not simulate {}. Remove the entry to compute without it.",
                            name),
                read.locations.of(name));
        }
    }
    for (const auto& [name, properties] : read.contact.joints)
    {
        if (properties.crushing)
        {
            throw FatalIOError(fmt::format("contactDynamics does not simulate crushing, which joint {} has. "
                                           "Remove the entry to compute without it.",
                                           name.text),
                               read.locations.of("joints/" + name.text + "/crushing"));
        }
    }
}

} // namespace

template<int Dim>
DynamicCase<Dim> readDynamicCase(const std::filesystem::path& caseDirectory,
                                 const std::vector<EffectType<Dim>>& types)
{
    DynamicCase<Dim> scene;
    scene.schemes = readSchemes(caseDirectory);
    scene.solution = readOptions<SolverChoice>(readSolution(caseDirectory, "contactDynamics"));
    Assembly<Dim> assembly = readAssembly<Dim>(caseDirectory);
    refuseOverlaps(assembly, caseDirectory);
    refuseAlmostJoints(assembly, caseDirectory);
    const CaseEffects<Dim> read = readCaseEffects(caseDirectory, types);
    refuseCrushing(read);
    scene.contact = read.contact;
    scene.effectNames = effectNames(read);
    scene.gravity = readGravity<Dim>(caseDirectory);
    scene.jointFriction = frictionOfJoints(caseDirectory, scene.contact, assembly);
    const std::vector<double> densities = readDensities(caseDirectory, assembly, scene.gravity);
    setStructure(scene, std::move(assembly), densities);
    scene.effects =
        makeEffects(read, {scene, scene.contact, read.locations, caseDirectory, scene.displacements(),
                           scene.schemes.timeIntegration.theta, scene.solution.solver});
    const std::vector<double> masses = massesOf(scene.blocks, densities);
    scene.deadLoad =
        readLoads<Dim>(caseDirectory, {scene.assembly, masses, scene.gravity}, LiveLoad::optional).dead;
    if (const auto file = caseDirectory / "constant/groundMotion"; std::filesystem::exists(file))
    {
        scene.groundMotion = readGroundMotion(Dictionary::readFile(file), caseDirectory);
    }
    scene.supportMotions = readSupportMotions(caseDirectory, scene.assembly);
    return scene;
}

template<int Dim>
Eigen::VectorXd loadUnder(const DynamicCase<Dim>& scene, const Eigen::Vector3d& ground)
{
    Eigen::VectorXd load = scene.deadLoad;
    for (Eigen::Index row = 0; row < load.size(); row += freedomCount<Dim>)
    {
        load.segment<Dim>(row) -= scene.groundFactor * scene.mass[row] * ground.head<Dim>();
    }
    return load;
}

template<int Dim>
std::vector<double> frictionAt(const DynamicCase<Dim>& scene, const std::vector<ContactPoint<Dim>>& points)
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

template std::vector<double> frictionAt(const DynamicCase<2>& scene,
                                        const std::vector<ContactPoint<2>>& points);
template DynamicCase<2> readDynamicCase(const std::filesystem::path& caseDirectory,
                                        const std::vector<EffectType<2>>& types);
template Eigen::VectorXd loadUnder(const DynamicCase<2>& scene, const Eigen::Vector3d& ground);

} // namespace drystone
