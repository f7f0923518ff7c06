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

/// Warns of a contactOverlap that no step looks at: points give way by Coulomb's law and with theta 1 only.
template<int Dim>
void warnOfUnusedOverlap(const DynamicCase<Dim>& scene, const std::filesystem::path& caseDirectory)
{
    const bool isAssociative = scene.flowRule() == FlowRule::associative;
    if (scene.schemes.contactOverlap != Schemes().contactOverlap
        && (isAssociative || scene.schemes.timeIntegration.theta < 1))
    {
        printWarningOnce(
            fmt::format("contactOverlap is not used: with {} contact points do not give way. Remove it, or "
                        "choose {}.",
                        isAssociative ? "the associative flow rule" : "theta below 1",
                        isAssociative ? "`flowRule nonAssociative;` in constant/contactProperties"
                                      : "theta 1"),
            Dictionary::readFile(caseDirectory / "system/schemes").locationOf("contactOverlap"));
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
    warnOfUnusedOverlap(scene, caseDirectory);
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
    scene.deadLoad = readLoads(caseDirectory, context, LiveLoad::optional).dead;
    return scene;
}

template<int Dim>
std::vector<double> frictionAt(const DynamicCase<Dim>& scene, const std::vector<ContactPoint<Dim>>& points)
{
    return frictionAt(scene.contact, scene.jointFriction, points);
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
