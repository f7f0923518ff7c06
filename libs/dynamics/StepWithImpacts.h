// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// A theta step with the impacts that happen in it, and where in the step blocks meet first.
#pragma once

#include "dynamics/DynamicCase.h"
#include "dynamics/StepObservation.h"
#include "dynamics/ThetaStep.h"

namespace drystone
{

/// What the solution of a step asks for beside its program. Nothing is owned.
struct StepProblem
{
    const DynamicCase& scene;
    const DynamicState& state;                     ///< that the step starts from
    SymbolicAnalysis* symbolic;                    ///< of its programs, brought up to date
    StepWork& work;                                ///< of the step, counted on
    const std::vector<ContactPoint<2>>& points;    ///< with their gaps at the start
    const std::vector<ContactColumns<2>>* columns; ///< at the start, where those of the program are not these
    const Eigen::VectorXd& load;
    const Eigen::VectorXd& bySupports; ///< by how much points close because supports move [m]; or empty
    const StepSettings& settings;
    double timeStep;
    const StepGuess& guess;
    const Relinearisation& relinearise;
    double acceleration;     ///< the largest that the loads give a block [m/s2]
    ImpactInstant instant;   ///< where in the step blocks that are still apart at its start collide
    double instantTolerance; ///< blocks that would meet within this time meet now [s]
    double slowestRebound;   ///< see ImpactProblem [m/s]
};

struct StepSolution
{
    ThetaStep step;
    bool isSolved = false;
    /// Below 1: blocks meet after this part of the step, and it is to be solved again that long.
    double length = 1;
    Eigen::VectorXd velocity;    ///< that the step starts from: after the impacts
    Eigen::VectorXd flight;      ///< displacement of blocks in free flight beyond the step's; or empty: none
    double lostInImpacts = 0;    ///< [J]
    double workOfSupports = 0;   ///< in impacts [J]
    double restitutionShare = 1; ///< the least of the impacts, see Impact
    Eigen::VectorXd impulse;     ///< of all impacts, two a point [N s]; empty: there were none
};

/// Whether a program of the case has impacts of their own; otherwise it is the plastic impact itself.
bool hasImpacts(const DynamicCase& scene);

/// The step, and where it asks for impacts these first and the step again from the velocities after them.
///
/// With `located` a point that is apart when the step begins, and closes in it, does not collide before it is
/// there: the step is solved as if it was not, which gives the gap at the end; with gap and closing velocity
/// at the start that makes a parabola, whose root is the instant. For one body under constant forces that is
/// exact for every theta, and else right to third order in the step. The step up to there is then solved by
/// who calls this, and so is the rest, which begins with the impact.
///
/// With restitution and theta above 1/2 blocks in free flight, which no contact force acts on, move by the
/// mean of their velocities: exact under constant loads, where backward Euler would take g dt from the
/// velocity of every bounce.
/// \param work its counts are added to
StepSolution solveWithImpacts(const StepProblem& problem, PlaneConeProgram program, StepResiduals& work);

/// Of any block, that of its turning about as far from its mass centre as blocks are large [m].
double farthestMotion(const Eigen::VectorXd& displacement, double blockSize);

/// Gaps, and minus the slips, where the step takes the blocks [m]. \param program of the step as it was first
/// made; that of the places where the step ends is made of it
Eigen::VectorXd openingAtEnd(PlaneConeProgram program, const ThetaStep& step,
                             const Relinearisation& relinearise);

} // namespace drystone
