// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// What time stepping reads of a case.
#pragma once

#include "dynamics/DynamicState.h"
#include "dynamics/Schemes.h"
#include "effects/EffectList.h"
#include "effects/GroundMotion.h"
#include "effects/SupportMotion.h"

#include <filesystem>

namespace drystone
{

/// A structure, what acts on it and how its motion is to be computed: read, checked, and the same all through
/// a run.
struct DynamicCase : Structure
{
    ContactProperties contact;
    Effects effects; ///< see EffectList.h; what is not there costs nothing
    EffectNames effectNames;
    /// Of the joints as built with a mu of their own, sorted by (block, neighbour); mostly empty.
    std::vector<std::pair<std::pair<int, int>, double>> jointFriction;
    GroundMotion groundMotion;
    std::vector<SupportMotion> supportMotions; ///< of supports that move; most cases have none
    double groundFactor = 1; ///< times groundMotion: the intensity of an incremental analysis
    Schemes schemes;
    SolverChoice solution;

    FlowRule flowRule() const
    {
        return contact.friction ? contact.friction->flowRule : FlowRule::associative;
    }
    double restitution() const { return contact.restitution ? contact.restitution->normal : 0; }
    Displacements displacements() const
    {
        return schemes.smallDisplacements ? Displacements::small : Displacements::large;
    }
};

/// Friction coefficient of each point: that of its joint as built where that has one of its own.
std::vector<double> frictionAt(const DynamicCase& scene, const std::vector<ContactPoint<2>>& points);

/// Reads constant/assembly, g, materialProperties, contactProperties, loads, groundMotion and supportMotion
/// (these three may be absent: gravity alone, ground and supports at rest), system/schemes and the
/// sub-dictionary contactDynamics of system/solution. \throws FatalIOError with the first thing that is wrong
/// \param types the effects that it may have
DynamicCase readDynamicCase(const std::filesystem::path& caseDirectory,
                            const std::vector<EffectType>& types = effectTypes());

/// The load on the free blocks while the ground accelerates: dead - groundFactor M a. \param ground mean
/// acceleration over the step [m/s2]
Eigen::VectorXd loadUnder(const DynamicCase& scene, const Eigen::Vector3d& ground);

} // namespace drystone
