// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Steps in which nothing moves: known without a program, or made exact after one.
#pragma once

#include "dynamics/ThetaStep.h"

namespace drystone
{

/// No motion, with forces, and how nearly it solves the program.
struct Rest
{
    ConeSolution solution;
    Certificate certificate;
};

template<int Dim>
Rest restWith(const StepProgram<Dim>& program, const Eigen::VectorXd& contactForce);

/// A program whose points touch where they are apart, or overlap, by no more than points may give way, or by
/// the associative law than gaps are known to.
template<int Dim>
StepProgram<Dim> closedWithin(const StepProgram<Dim>& program, const StepSettings& settings);

/// Rest with forces near others: with these, or where they do not balance the loads, as where the ground
/// shakes or blocks creep, with those nearest to them that do, at the points that press and touch, by one
/// factorisation, which is counted on the step. By Coulomb's law points that give way touch where they are
/// within that of each other. \param symbolic kept from program to program; may be null
template<int Dim>
Rest restWithin(const StepProgram<Dim>& program, const Eigen::VectorXd& contactForce,
                const StepSettings& settings, ThetaStep& step, SymbolicAnalysis* symbolic);

/// Whether forces near those of the guess may hold the blocks where they are: the blocks are at rest, or by
/// Coulomb's law the points that press move by no more than they give way. Followed from step to step they
/// slip so little in each to carry their shear, where rigid points may hold the blocks. Never in an impact,
/// nor with compliance. \param start motion by the guess, and its forces
template<int Dim>
bool mayStayAtRest(const StepProgram<Dim>& program, const ConeSolution& start, const StepSettings& settings);

/// Whether rest solves the program to the tolerance; then it is the step.
template<int Dim>
bool comesToRest(ThetaStep& step, const StepProgram<Dim>& program, Rest rest, double tolerance);

/// Whether what is out of balance is so small a part of the loads that rest is worth a look.
template<int Dim>
bool mayRest(const StepProgram<Dim>& program, const Eigen::VectorXd& outOfBalance);

/// A structure whose forces balance its loads to the tolerance stands still: not by what the solver leaves of
/// a displacement, which would be an impulse in the next step, but exactly. The gap of a certificate is work,
/// so of second order in what is out of balance: a solution that is nearly rest may be rest, and is known
/// when it is solved to the square of the tolerance. Otherwise a wall would move off below its multiplier,
/// little by little. \param solver of the solution
template<int Dim>
bool standsStill(ThetaStep& step, const StepProgram<Dim>& program, const StepSettings& settings,
                 const SolverChoice& solver, const ConeSolution& solution, SymbolicAnalysis* symbolic);

/// Solves a program and counts the work on the step.
template<int Dim>
ConeSolution solveCounted(ThetaStep& step, const StepProgram<Dim>& program, const SolverChoice& solver,
                          const ConeSolution& start, SymbolicAnalysis* symbolic);

} // namespace drystone
