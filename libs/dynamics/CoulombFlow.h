// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Coulomb's law in a step: blocks slide without opening, which the program's flow would make them do.
#pragma once

#include "dynamics/FollowedFlow.h"

namespace drystone
{

/// mu |u_t| of each point: what the program's flow opens. \param closing A'y
template<int Dim>
Eigen::VectorXd dilatancy(const StepProgram<Dim>& program, const Eigen::VectorXd& closing,
                          const Eigen::VectorXd& contactForce);

/// What points open by under forces near the least ones, in large structures of space with rigid joints,
/// where they are not followed (AlternatingDirections.h). \param step whose work is counted \return one a
/// point, or empty: for another problem
template<int Dim>
Eigen::VectorXd openingsOfLeastForces(ThetaStep& step, const FlowProblem<Dim>& problem);

/// How far what a program imposed is from the dilatancy of its solution, where that matters: where a point
/// presses, or would enter its partner without what is imposed. Everywhere else the point is apart and
/// without force, which Coulomb's law allows whatever it slides. \param gap of the points [m], without what
/// is imposed \param least force that counts [N]
template<int Dim>
double errorOfFlow(const Eigen::VectorXd& imposed, const Eigen::VectorXd& opening, const Eigen::VectorXd& gap,
                   const ThetaStep& step, double least);

/// Of Newton's method for Coulomb's law.
struct NewtonEffort
{
    int steps;           ///< at most, in each program
    double gapTolerance; ///< error allowed in gaps that no motion closes [m]
};

/// Takes over a solution of Coulomb's law, with gaps that are right to a tolerance as the points which touch
/// want them. \param program its gaps without what the flow opens; with it on return \param backwards how far
/// points at their limit may slide against it, as those do that give way and whose limit has become less
template<int Dim>
void takeOver(ThetaStep& step, StepProgram<Dim>& program, ConeSolution solution, const StepSettings& settings,
              double gapTolerance, double backwards);

/// Coulomb's law by Newton's method, with gaps that are right where the blocks end up. Closed rings of blocks
/// are mobile to first order only: as they move, some points open by the square of their displacements, and
/// which of them carries what is then decided by less than contactTolerance. So gaps are taken as known to
/// that, or to a thousandth of what the step changes the motion by, if that is less. \return whether it was
/// reached; otherwise the step is as it was but for the work counted
template<int Dim>
bool solveFlow(ThetaStep& step, const FlowProblem<Dim>& problem, ConeSolution start,
               const NewtonEffort& effort);

/// Whether the forces of the last step are tried as a start of Coulomb's law.
template<int Dim>
bool mayGoOn(const StepProgram<Dim>& program, const StepSettings& settings, const ConeSolution& start);

/// Coulomb's law from the forces of the last step, without a program: with `automatic` alone, since every
/// other solver is requested by name, and not near rest, which only a program distinguishes from slow motion.
template<int Dim>
bool goesOnFromLastStep(ThetaStep& step, const FlowProblem<Dim>& problem, const ConeSolution& start,
                        Following following);

} // namespace drystone
