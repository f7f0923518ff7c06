// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// How a motion goes from one instant to the next: one step, one that is shortened until it is solved, and
/// one of a run.
#pragma once

#include "dynamics/Motion.h"
#include "runControl/Time.h"

namespace drystone
{

/// One step (Portioli, Cascini & Landolfo 2017, eq. 1-9), in the stages of Step.h:
///
/// 1. findContacts: contact points where blocks touch or may meet within the step;
/// 2. assemble: the theta step as a cone program;
/// 3. contribute: what effects and moving supports add to it;
/// 4. solve: its gaps right to second order;
/// 5. collide: impacts, where restitution or a theta below 1 requires them (Impact.h: none creates energy;
///    without either the program itself is the plastic impact). Blocks that touch when the step begins
///    collide first and the step goes on from the velocities after that;
/// 6. review: bonds that would give way in the solution break, and the step is solved again without them
///    (JointBonds.h);
/// 7. move: blocks are moved by finite rotations;
/// 8. account: the ledger of energy is kept; with `deletion`, blocks whose mass centre is outside the box are
///    stopped there for good: they touch nothing and feel no load. The kinetic energy that they take with
///    them counts as external work, negative.
///
/// With `selection automatic` a step from rest that provably ends at rest has none of these (ProvedRest.h).
/// Where blocks meet in the course of the step it is taken in parts, up to where they meet and on from there
/// (PartedStep.h).
///
/// \return whether the step was solved and is taken (StepFault); otherwise nothing but `attempt`, `work`,
/// `stageTimes`, and what is found again (analyses, `contacts`, `restProof`, `jointFriction`), has changed
template<int Dim>
bool advance(const DynamicCase<Dim>& scene, Motion<Dim>& motion, double timeStep);

/// A step that was shortened until it was solved.
struct ShortenedStep
{
    bool isSolved = false;
    double timeStep = 0; ///< of the last attempt [s]
};

/// One step; one that is not solved is tried again half as long, up to ten times and as long as
/// `maximumFactorisations` allow for. With restitution or theta below 1 such a step is then tried, from
/// its whole length on, by theta 1 without restitution, so that blocks which do not stop hitting each other
/// stay together, and `motion.residuals` say so; half of `maximumFactorisations` once more is for that. The
/// retries are in `motion.attempt`, and in `motion.residuals` of a step that was solved. Nothing else changes
/// in a motion whose step was not.
template<int Dim>
ShortenedStep advanceOrShorten(const DynamicCase<Dim>& scene, Motion<Dim>& motion, double timeStep);

/// Sets the step of a run with adjustTimeStep: as long as is wanted [s], or shorter such that no block moves
/// by more than maxDisplacement, effects are resolved, and steps end where the motion of ground or supports
/// changes.
template<int Dim>
void chooseTimeStep(const DynamicCase<Dim>& scene, const Motion<Dim>& motion, double wanted, Time& time);

/// The step of a run that ends at time.value(), shortened if it is not solved. With adjustTimeStep the next
/// is chosen, at most 1.2 times as long as this was meant to be. \return whether it was solved;
/// otherwise the time is that of the start of the step again
template<int Dim>
bool advance(const DynamicCase<Dim>& scene, Motion<Dim>& motion, Time& time);

} // namespace drystone
