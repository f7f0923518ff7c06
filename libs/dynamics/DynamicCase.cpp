// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Reading of a case in motion.
#include "dynamics/DynamicCase.h"

#include "assembly/Loads.h"
#include "assembly/Materials.h"
#include "contact/AlmostJoints.h"
#include "contact/ClosedAssembly.h"
#include "contact/CoveredSurface.h"
#include "contact/Equilibrium.h"
#include "contact/Facing.h"
#include "runControl/Solution.h"

#include <fmt/format.h>

namespace drystone
{
namespace
{

/// Whether the steps of the case choose their length.
bool adjustsTimeStep(const std::filesystem::path& caseDirectory)
{
    const Dictionary control = Dictionary::readFileIfPresent(caseDirectory / "system/controlDict");
    return control.find("adjustTimeStep") && control.get<bool>("adjustTimeStep");
}

/// Warns of settings that no step looks at. Points give way by Coulomb's law and with theta 1 only.
template<int Dim>
void warnOfUnused(const DynamicCase<Dim>& scene, const std::filesystem::path& caseDirectory)
{
    const std::filesystem::path file = caseDirectory / "system/schemes";
    const auto warn = [&file](const char* key, const std::string& why)
    {
        printWarningOnce(fmt::format("{} is not used: {}.", key, why),
                         Dictionary::readFile(file).locationOf(key));
    };
    const Schemes& schemes = scene.schemes;
    const bool isAssociative = scene.flowRule() == FlowRule::associative;
    const double theta = schemes.timeIntegration.theta;
    if (schemes.contactOverlap != Schemes().contactOverlap && (isAssociative || theta < 1))
    {
        warn("contactOverlap",
             fmt::format("with {} contact points do not give way. Remove it, or choose {}",
                         isAssociative ? "the associative flow rule" : "theta below 1",
                         isAssociative ? "`flowRule nonAssociative;` in constant/contactProperties"
                                       : "theta 1"));
    }
    if (schemes.impacts != Schemes().impacts && theta == 1 && scene.restitution() == 0)
    {
        warn("impacts",
             "with theta 1 and without restitution what meets is stopped by the step itself. Remove "
             "it, or give restitution in constant/contactProperties");
    }
    for (const auto& [key, isGiven] :
         {std::pair("maxDisplacement", schemes.maxDisplacement != Schemes().maxDisplacement),
          std::pair("maxDeltaT", schemes.maxDeltaT != Schemes().maxDeltaT)})
    {
        if (isGiven && !adjustsTimeStep(caseDirectory))
        {
            warn(key, "deltaT is fixed. Remove it, or set `adjustTimeStep yes;` in system/controlDict");
        }
    }
}

} // namespace

template<int Dim>
void addLeftOut(DynamicCase<Dim>& scene)
{
    if (scene.schemes.effects.selection != EffectSelection::everything)
    {
        return;
    }
    if (scene.schemes.smallDisplacements)
    {
        scene.schemes.smallDisplacements = false;
        scene.addedEffects.emplace_back("large displacements");
    }
    if (scene.contact.friction && scene.contact.friction->flowRule == FlowRule::associative)
    {
        scene.contact.friction->flowRule = FlowRule::nonAssociative;
        scene.addedEffects.emplace_back("Coulomb's law");
    }
    if (scene.schemes.impacts == ImpactInstant::stepStart)
    {
        scene.schemes.impacts = ImpactInstant::located;
        scene.addedEffects.emplace_back("impacts when blocks meet");
    }
}

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
    scene.contact = read.contact;
    addLeftOut(scene);
    warnOfUnused(scene, caseDirectory);
    scene.effectNames = effectNames(read);
    scene.gravity = readGravity<Dim>(caseDirectory);
    scene.jointFriction = frictionOfJoints(scene.contact, assembly);
    const std::vector<double> densities = readDensities(caseDirectory, assembly, scene.gravity);
    setStructure(scene, std::move(assembly), densities);
    scene.effects = makeEffects(read, {scene, scene.contact, caseDirectory, scene.displacements(),
                                       scene.schemes.timeIntegration.theta, scene.solution.solver});
    const std::vector<double> masses = massesOf(scene.blocks, densities);
    const LoadContext<Dim> context{scene.assembly, masses, scene.gravity,
                                   [&scene] { return coveredSurface(scene.assembly); }};
    CaseLoads<Dim> loads = readLoads(caseDirectory, context, LiveLoad::optional);
    scene.deadLoad = {std::move(loads.dead), {}};
    if (!scene.schemes.smallDisplacements) // with which points of forces stay as built, as contacts do
    {
        scene.deadLoad.firstMoments = std::move(loads.firstMomentsOfDead);
    }
    return scene;
}

template<int Dim>
std::vector<double> frictionAt(const DynamicCase<Dim>& scene, const std::vector<ContactPoint<Dim>>& points)
{
    return frictionAt(scene.contact, scene.assembly, scene.jointFriction, points);
}

template std::vector<double> frictionAt(const DynamicCase<2>& scene,
                                        const std::vector<ContactPoint<2>>& points);
template void addLeftOut(DynamicCase<2>& scene);
template DynamicCase<2> readDynamicCase(const std::filesystem::path& caseDirectory,
                                        const std::vector<EffectType<2>>& types);
template std::vector<double> frictionAt(const DynamicCase<3>& scene,
                                        const std::vector<ContactPoint<3>>& points);
template void addLeftOut(DynamicCase<3>& scene);
template DynamicCase<3> readDynamicCase(const std::filesystem::path& caseDirectory,
                                        const std::vector<EffectType<3>>& types);

} // namespace drystone
