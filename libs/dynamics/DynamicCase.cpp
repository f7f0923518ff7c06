// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Reading of a case in motion.
#include "dynamics/DynamicCase.h"

#include "assembly/Loads.h"
#include "assembly/Materials.h"
#include "contact/AlmostJoints.h"
#include "contact/ClosedAssembly.h"
#include "contact/Equilibrium.h"
#include "contact/Facing.h"

#include "runControl/Solution.h"

#include <fmt/format.h>

namespace drystone
{

namespace
{

/// Refuses what motion in space does not simulate yet, so that nobody takes a result for what it is not.
void refuseInSpace(const CaseEffects<3>& read, const std::filesystem::path& caseDirectory)
{
    for (const std::string name : {"restitution", "cohesion", "tension", "elasticity"})
    {
        if (read.locations.has(name))
        {
            throw FatalIOError(fmt::format("contactDynamics does not simulate {} in space yet. Remove the "
                                           "entry to compute without it.",
                                           name),
                               read.locations.of(name));
        }
    }
    for (const auto& [name, properties] : read.contact.joints)
    {
        if (properties.cohesion || properties.tension)
        {
            throw FatalIOError(fmt::format("contactDynamics does not simulate cohesion and tension in space "
                                           "yet, which joint {} has. Remove them to compute without.",
                                           name.text),
                               read.locations.of("joints/" + name.text));
        }
    }
    if (const auto file = caseDirectory / "constant/supportMotion"; std::filesystem::exists(file))
    {
        throw FatalIOError("contactDynamics does not simulate moving supports in space yet. Remove the file "
                           "to compute without supportMotion.",
                           {file.string(), "", 0});
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
    if constexpr (Dim == 3)
    {
        refuseInSpace(read, caseDirectory);
    }
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
    return frictionAt(scene.contact, scene.jointFriction, points);
}

template std::vector<double> frictionAt(const DynamicCase<2>& scene,
                                        const std::vector<ContactPoint<2>>& points);
template DynamicCase<2> readDynamicCase(const std::filesystem::path& caseDirectory,
                                        const std::vector<EffectType<2>>& types);
template Eigen::VectorXd loadUnder(const DynamicCase<2>& scene, const Eigen::Vector3d& ground);
template std::vector<double> frictionAt(const DynamicCase<3>& scene,
                                        const std::vector<ContactPoint<3>>& points);
template DynamicCase<3> readDynamicCase(const std::filesystem::path& caseDirectory,
                                        const std::vector<EffectType<3>>& types);
template Eigen::VectorXd loadUnder(const DynamicCase<3>& scene, const Eigen::Vector3d& ground);

} // namespace drystone
