// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// What time stepping reads of a case.
#pragma once

#include "conic/SolverChoice.h"
#include "contact/ContactProperties.h"
#include "dynamics/DynamicState.h"
#include "dynamics/GroundMotion.h"
#include "dynamics/JointBonds.h"
#include "dynamics/Schemes.h"
#include "dynamics/StepEffect.h"
#include "dynamics/SupportMotion.h"

#include <filesystem>

namespace drystone
{

/// A structure, what acts on it and how its motion is to be computed: read, checked, and the same all through
/// a run.
struct DynamicCase
{
    Assembly<2> assembly;
    std::vector<BlockMass<2>> blocks;      ///< of all blocks
    std::vector<int> free;                 ///< see freeIndices
    Eigen::VectorXd mass;                  ///< diagonal of M, 3 a free block [kg, kg, kg m2]
    Eigen::VectorXd deadLoad;              ///< likewise [N, N, N m]
    Vector<2> gravity = Vector<2>::Zero(); ///< [m/s2]
    ContactProperties contact;
    std::vector<std::shared_ptr<const StepEffect>>
        effects;             ///< see stepEffects; what is not there costs nothing
    std::vector<Bond> bonds; ///< empty without cohesion and tension
    /// Of the joints as built with a mu of their own, sorted by (block, neighbour); mostly empty.
    std::vector<std::pair<std::pair<int, int>, double>> jointFriction;
    GroundMotion groundMotion;
    std::vector<SupportMotion> supportMotions; ///< of supports that move; most cases have none
    double groundFactor = 1; ///< times groundMotion: the intensity of an incremental analysis
    Schemes schemes;
    SolverChoice solution;
    double blockSize = 1;   ///< mean [m]
    double roundingGap = 0; ///< a gap that small is none: what rounding leaves of the places of blocks [m]

    FlowRule flowRule() const
    {
        return contact.friction ? contact.friction->flowRule : FlowRule::associative;
    }
    double restitution() const { return contact.restitution ? contact.restitution->normal : 0; }
};

/// Gives a scene its structure: `assembly` and what follows from it, `blocks`, `free`, `mass`, `blockSize`
/// and `roundingGap`. Loads and all else are left alone. \param densities of all blocks [kg/m3]
void setStructure(DynamicCase& scene, Assembly<2> assembly, const std::vector<double>& densities);

/// Friction coefficient of each point: that of its joint as built where that has one of its own.
std::vector<double> frictionAt(const DynamicCase& scene, const std::vector<ContactPoint<2>>& points);

/// Reads constant/assembly, g, materialProperties, contactProperties, loads, groundMotion and supportMotion
/// (these three may be absent: gravity alone, ground and supports at rest), system/schemes and the
/// sub-dictionary contactDynamics of system/solution. \throws FatalIOError with the first thing that is wrong
DynamicCase readDynamicCase(const std::filesystem::path& caseDirectory);

/// The load on the free blocks while the ground accelerates: dead - groundFactor M a. \param ground mean
/// acceleration over the step [m/s2]
Eigen::VectorXd loadUnder(const DynamicCase& scene, const Eigen::Vector3d& ground);

} // namespace drystone
