// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// What time stepping reads of a case.
#pragma once

#include "dynamics/DynamicState.h"
#include "effects/EffectList.h"
#include "effects/Friction.h"
#include "runControl/Schemes.h"

#include <filesystem>
#include <string>
#include <vector>

namespace drystone
{

/// A structure, what acts on it and how its motion is to be computed: read, checked, and the same all through
/// a run.
template<int Dim>
struct DynamicCase : Structure<Dim>
{
    ContactProperties contact;
    Effects<Dim> effects; ///< see EffectList.h; what is not there costs nothing
    EffectNames effectNames;
    FrictionOfJoints jointFriction; ///< mostly empty
    Schemes schemes;
    SolverChoice solution;
    std::vector<std::string> addedEffects = {}; ///< see addLeftOut, in words

    FlowRule flowRule() const { return flowRuleOf(contact); }
    double restitution() const { return contact.restitution ? contact.restitution->normal : 0; }
    Displacements displacements() const
    {
        return schemes.smallDisplacements ? Displacements::small : Displacements::large;
    }
};

/// With `selection everything`: turns on what the case leaves out although it takes no data, which are large
/// displacements, Coulomb's law where there is friction, and impacts when blocks meet where they are apart
/// from the program of a step. All other effects have data, and are off where the case has none. What was
/// turned on goes into addedEffects.
template<int Dim>
void addLeftOut(DynamicCase<Dim>& scene);

/// Friction coefficient of each point: that of its joint where `joints` gives it one of its own.
template<int Dim>
std::vector<double> frictionAt(const DynamicCase<Dim>& scene, const std::vector<ContactPoint<Dim>>& points);

/// Reads constant/assembly, g, materialProperties, contactProperties, loads (may be absent: gravity alone),
/// the files of effects (likewise), system/schemes and the sub-dictionary contactDynamics of
/// system/solution. \throws FatalIOError with the first thing that is wrong
/// \param types the effects that it may have
template<int Dim>
DynamicCase<Dim> readDynamicCase(const std::filesystem::path& caseDirectory,
                                 const std::vector<EffectType<Dim>>& types = effectTypes<Dim>());

} // namespace drystone
