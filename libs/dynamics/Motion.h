// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// A structure in motion, and how it goes from one instant to the next.
#pragma once

#include "contact/MovingContacts.h"
#include "dynamics/DynamicCase.h"
#include "dynamics/StepObservation.h"
#include "dynamics/ThetaStep.h"
#include "runControl/Time.h"

#include <memory>
#include <optional>

namespace drystone
{

struct SymbolicAnalysis;

/// The symbolic part of the programs of a motion, made when first asked for. A copy of a motion has one of
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
    std::unique_ptr<SymbolicAnalysis> analysis_;
};

/// All that changes in a run. What a run needs to continue bit for bit is `state`, `energy`, `points`,
/// `contactForces`, `meanForces`, `interior` and `isBondBroken`.
struct Motion
{
    DynamicState state;
    EnergyLedger energy;
    std::vector<ContactPoint<2>> points;  ///< of the last step, where they are now; gaps [m]
    std::vector<Vector<2>> contactForces; ///< one a point, (normal, tangent) [N]: where the next step starts
    std::vector<Vector<2>> meanForces;    ///< likewise, mean over the last step, with the impulses of its
                                          ///< impacts; empty where that is the same
    InteriorStart interior;               ///< of the last program that had one, at `points`; or empty
    StepResiduals residuals;              ///< of the last step
    StepResiduals attempt;                ///< of the last attempt at a step, solved or not
    StepWork work;                        ///< of the last step, all attempts together
    KeptAnalysis symbolic;                ///< of the last programs
    std::optional<MovingContacts> contacts; ///< empty with smallDisplacements: the points stay as built
    std::vector<char> isDeleted;    ///< one a block, where the case has a `deletion`: it is outside the
                                    ///< box, at rest where it left it. Follows from `state`
    std::vector<char> isBondBroken; ///< one of each of the case's bonds, with what never was one
    int bondsBrokenInStep = 0;      ///< in the last step
    double restitutionShare = 1;    ///< in the last step the least of its impacts, see Impact
    /// What the time integration has dissipated outside impacts since the start of this run [J]: an estimate
    /// of its error, of first order in the step with theta above 1/2. Of each step at most what it would be
    /// if velocities changed by twice what the loads alone do: impacts change them by more.
    double smoothLoss = 0;
    double largestKinetic = 0; ///< in this run [J]
};

/// How many bonds are broken that once held [-].
int brokenBonds(const DynamicCase& scene, const Motion& motion);

/// The strengths that the bonds give the points now, none that is broken; empty in a case without bonds.
std::vector<Strength> strengthsOf(const DynamicCase& scene, const Motion& motion);

/// The motion that starts from a state, its ledger opened there.
Motion startMotion(const DynamicCase& scene, DynamicState state);

/// One step (Portioli & Cascini 2017, eq. 1-9):
///
/// 1. contact points where blocks touch or may meet within the step;
/// 2. the theta step as a cone program, its gaps right to second order; bonds that would give way in it break
///    and it is solved again without them (JointBonds.h);
/// 3. impacts, where restitution or a theta below 1 asks for them (Impact.h: none creates energy; without
///    either the program itself is the plastic impact). Blocks that touch when the step begins collide first
///    and the step goes on from the velocities after that; where blocks meet in the course of the step it is
///    taken in parts, up to where they meet and on from there (StepWithImpacts.h). A rebound that would last
///    less than a tenth of the step is none: bounces that grow shorter for ever end. After eight attempts at
///    parts, or where more than two pairs of blocks meet in one, and with `impacts stepStart`, points that
///    the step closes and that were closing when it began collide at its start, wherever they meet;
/// 4. blocks moved by finite rotations, and the ledger of energy kept;
/// 5. with `deletion`, blocks whose mass centre is outside the box stopped there for good: they touch nothing
///    and feel no load. The kinetic energy that they take with them counts as external work, negative.
///
/// \return whether the step was solved; otherwise nothing but `attempt` and `work` has changed
bool advance(const DynamicCase& scene, Motion& motion, double timeStep);

/// The step that ends at time.value(). One that is not solved is tried again half as long, up to ten times
/// and as long as `maximumFactorisations` allow for. With adjustTimeStep the next step is chosen such that no
/// block moves by more than maxDisplacement. \return whether it was solved; otherwise the time is that of the
/// start of the step again
bool advance(const DynamicCase& scene, Motion& motion, Time& time);

/// One a contact point: mean over the last step, impulses of its impacts included, (normal, tangent) [N].
/// Together with the loads they change the momenta of the blocks by what the step does.
const std::vector<Vector<2>>& meanContactForces(const Motion& motion);

/// What observers see and a motion does not keep.
struct ObservedLists
{
    std::vector<BlockVelocity<2>> velocities; ///< one a block
    std::vector<double> friction;             ///< one a contact point
    std::vector<double> cohesion;             ///< likewise [N]; empty in a case without bonds
};

/// What observers see. The views are into `motion` and `lists`. \param lists filled in
StepObservation<2> observe(const DynamicCase& scene, const Motion& motion, const Time& time,
                           ObservedLists& lists);

} // namespace drystone
