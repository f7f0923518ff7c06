// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// What a time step leaves behind for those who watch a run: function objects, writers, studies.
#pragma once

#include "contact/ContactPoint.h"
#include "dynamics/EnergyLedger.h"
#include "dynamics/StageTimes.h"
#include "geometry/Rotation.h"

#include <algorithm>
#include <optional>
#include <span>

namespace drystone
{

/// How fast a block moves.
template<int Dim>
struct BlockVelocity
{
    Vector<Dim> linear = Vector<Dim>::Zero(); ///< of the mass centre [m/s]
    Turn<Dim> angular = noTurn<Dim>(); ///< [rad/s], positive counter-clockwise; in space along its axis
};

/// Why a step whose programs are solved is not taken: what is found from tangents of turns, and contacts from
/// where blocks move to, holds for steps that are not too long only.
enum class StepFault
{
    none,
    turnsTooFar,   ///< contact turns a block by more than a radian
    entersTooDeep, ///< blocks end in each other
    createsEnergy, ///< contact does work on the blocks
    movesTooFar    ///< loads, supports or velocities move blocks so far that nothing can be computed
};

/// How hard the solver worked on a step, and how well the step is solved.
struct StepResiduals
{
    double initialResidual = 0; ///< relative, of the starting point
    double primalResidual = 0;  ///< relative, of equilibrium and of the friction cones
    double dualResidual = 0;    ///< relative, of penetration and of the flow rule
    double dualityGap = 0;      ///< relative, of complementarity
    int iterations = 0;
    int factorisations = 0;
    int programs = 0;     ///< cone programs solved for the step: more than one with non-associative friction
    int retries = 0;      ///< times that it was halved, as it was not solved
    double flowError = 0; ///< of Coulomb's law: by how much mu |u_t| is missed where a point slides [m]
    bool isWithoutRebounds = false; ///< impacts one after the other had no end: see advanceOrShorten
    double overlookedDepth = 0;     ///< of blocks in each other at the end, where no point was foreseen [m]
    StepFault fault = StepFault::none; ///< of an attempt that is not taken

    double worst() const { return std::max({primalResidual, dualResidual, dualityGap}); }
};

/// The state at the end of a step. Nothing is owned: the views are valid while an observer is called, not
/// longer.
template<int Dim>
struct StepObservation
{
    double time = 0;     ///< at the end of the step [s]
    double timeStep = 0; ///< [s]; 0 for the state a run starts from
    long step = 0;       ///< number of steps done since time 0

    const Assembly<Dim>* assembly = nullptr;
    std::span<const Placement<Dim>> placements;     ///< one a block, fixed ones too
    std::span<const BlockVelocity<Dim>> velocities; ///< one a block, fixed ones too

    std::span<const ContactPoint<Dim>> contactPoints; ///< where they are now
    std::span<const Vector<Dim>> contactForces;   ///< one a point: mean over the step with the impulses of
                                                  ///< its impacts, (normal, tangent) [N]
    std::span<const double> frictionCoefficients; ///< one a point
    std::span<const double> cohesions; ///< shear in addition to friction [N], likewise; or empty: none

    EnergyLedger energy;
    StepResiduals residuals;
    std::optional<StageTimes> stageTimes; ///< since the run began; empty for a state that was read
};

} // namespace drystone
