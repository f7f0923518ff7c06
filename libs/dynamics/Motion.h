// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// A structure in motion.
#pragma once

#include "contact/MovingContacts.h"
#include "contact/space/MovingContacts.h"
#include "dynamics/DynamicCase.h"
#include "dynamics/EffectUse.h"
#include "dynamics/RestProof.h"
#include "dynamics/StepObservation.h"
#include "dynamics/ThetaStep.h"
#include "runControl/Time.h"

#include <memory>
#include <optional>

namespace drystone
{

struct SymbolicAnalysis;

/// The symbolic part of the programs of a motion, made when first requested. A copy of a motion has one of
/// its own, since threads go on from one motion each for itself.
class KeptAnalysis
{
public:
    KeptAnalysis();
    KeptAnalysis(const KeptAnalysis& other);
    KeptAnalysis& operator=(const KeptAnalysis& other);
    ~KeptAnalysis();
    SymbolicAnalysis* get();

private:
    std::unique_ptr<SymbolicAnalysis> analysis;
};

/// All that changes in a run. What a run needs to continue bit for bit is `state`, `energy`, `residuals`,
/// `points`, `contactForces`, `meanForces`, `interior`, `effectStates`, `slides`, `collisions`,
/// `stepsInVain` and `overlapsLeft`; the analyses, `contacts`, `restProof` and `jointFriction` are found
/// again from these.
template<int Dim>
struct Motion
{
    DynamicState<Dim> state;
    EnergyLedger energy;
    std::vector<ContactPoint<Dim>> points; ///< of the last step, where they are now; gaps [m]
    std::vector<Vector<Dim>>
        contactForces;                   ///< one a point, (normal, tangent) [N]: where the next step starts
    std::vector<Vector<Dim>> meanForces; ///< likewise, mean over the last step, with the impulses of its
                                         ///< impacts; empty where that is the same
    InteriorStart interior;              ///< of the last program that had one, at `points`; or empty
    StepResiduals residuals;             ///< of the last step
    StepResiduals attempt;               ///< of the last attempt at a step, solved or not
    StepWork work;                       ///< of the last step, all attempts together
    KeptAnalysis symbolic;               ///< of the last programs
    KeptAnalysis symbolicOfHeld;         ///< likewise of the blocks that were held at rest, with `automatic`
    std::optional<MovingContacts<Dim>> contacts; ///< empty with smallDisplacements: the points stay as built
    std::vector<EffectState> effectStates;       ///< one an effect of the case
    std::vector<EffectState> effectStatesBefore; ///< at the start of the last step
    /// Of joints as built and of all pairs of blocks that have been near each other in this run.
    FrictionOfJoints jointFriction;
    double restitutionShare = 1; ///< in the last step the least of its impacts, see Impact
    /// What the time integration has dissipated outside impacts since the start of this run [J]: an estimate
    /// of its error, of first order in the step with theta above 1/2. Of each step at most what it would be
    /// if velocities changed by twice what the loads alone do: impacts change them by more.
    double smoothLoss = 0;
    double largestKinetic = 0;               ///< in this run [J]
    double created = 0;                      ///< in this run, by contacts in steps with a gain of energy [J]
    StageTimes stageTimes;                   ///< of this run
    std::optional<RestProof<Dim>> restProof; ///< of where the blocks were last seen at rest, with `automatic`
    /// Whether each block, fixed ones too, was simulated in the last step, or held by a proof; empty: all
    /// were.
    std::vector<char> isAwake;
    std::vector<int> bodies; ///< in which body each block was simulated, -1: in none; empty: each was its own
    bool slides = false;     ///< see Step.h, of the last step
    int overlapsLeft = 0;    ///< steps to come that close no overlaps, since one was not solved otherwise
    int collisions = 0;      ///< steps in a row up to the last one in which points collided, see Step.h
    /// Steps in a row up to the last one in which fewer bodies gained little (HeldBlocks.h).
    int stepsInVain = 0;
    std::vector<double> effectCalls; ///< of the last step, see EffectCalls.h, with `automatic`; else empty
    EffectUse effectUse;             ///< of this run
};

/// How many blocks were simulated in the last step, and as how many bodies.
template<int Dim>
long awakeBlocks(const Motion<Dim>& motion);
template<int Dim>
long simulatedBodies(const Motion<Dim>& motion);

/// Friction coefficient of each of the motion's points.
template<int Dim>
std::vector<double> frictionAt(const DynamicCase<Dim>& scene, const Motion<Dim>& motion);

/// The strengths that effects give the points now; empty where there are none.
template<int Dim>
std::vector<Strength> strengthsOf(const DynamicCase<Dim>& scene, const Motion<Dim>& motion);

/// Blocks that effects leave out from now on stop where they are: they touch nothing and feel no load.
/// \return the kinetic energy that they take with them [J]
template<int Dim>
double leaveOutBlocks(const DynamicCase<Dim>& scene, Motion<Dim>& motion);

/// The motion that starts from a state, its ledger opened there.
template<int Dim>
Motion<Dim> startMotion(const DynamicCase<Dim>& scene, DynamicState<Dim> state);

/// Velocities (ux uy rz), in space (ux uy uz rx ry rz), of all blocks; of those that move with a support the
/// mean from one instant to another [m/s and rad/s].
template<int Dim>
std::vector<BlockVector<Dim>> velocitiesOfAllBlocks(const DynamicCase<Dim>& scene,
                                                    const DynamicState<Dim>& state, double from, double to);

/// One a contact point: mean over the last step, impulses of its impacts included, (normal, tangent) [N].
/// Together with the loads they change the momenta of the blocks by what the step does.
template<int Dim>
const std::vector<Vector<Dim>>& meanContactForces(const Motion<Dim>& motion);

/// What observers see and a motion does not keep.
template<int Dim>
struct ObservedLists
{
    std::vector<BlockVelocity<Dim>> velocities; ///< one a block
    std::vector<double> friction;               ///< one a contact point
    std::vector<double> cohesion;               ///< likewise [N]; empty in a case without bonds
};

/// What observers see. The views are into `motion` and `lists`. \param lists filled in
template<int Dim>
StepObservation<Dim> observe(const DynamicCase<Dim>& scene, const Motion<Dim>& motion, const Time& time,
                             ObservedLists<Dim>& lists);

} // namespace drystone
