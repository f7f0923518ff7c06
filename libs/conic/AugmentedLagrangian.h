// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Augmented Lagrangian solver for programs with inertia: the one that starts from the last time step.
#pragma once

#include "conic/ConeProgram.h"

namespace drystone
{

struct SymbolicAnalysis;

/// When the augmented Lagrangian has done enough.
enum class StopWhen
{
    certified, ///< the certificate meets the tolerance. Where the bodies move by much more than the forces of
               ///< one step move them, that is soon: the certificate compares with all of the motion
    settled    ///< the multipliers have settled, too, to the tolerance of what the forces do in one step
};

/// Keys of `solver augmentedLagrangian;`.
struct AugmentedLagrangianSettings
{
    double tolerance = 1e-9;     ///< on every figure of the certificate
    int maximumIterations = 100; ///< Newton steps allowed
    double penalty = 1e2;        ///< sigma to begin with, relative to the inertia; grows tenfold a round
    StopWhen stop = StopWhen::settled;
};

/// All digits, from whatever start: what proofs ask for where little is out of balance.
AugmentedLagrangianSettings exactSettings(int maximumIterations);

/// Solves a plane program with inertia (a time step) by the method of multipliers on its dual,
///
///     minimise  1/2 y' Mbar y - f' y   subject to   B' y <= g,     multipliers s >= 0,    c = R s,
///
/// with the friction cones in ray form (RayProgram.h). Each round minimises
///
///     1/2 y' Mbar y - f' y + 1/(2 sigma) |max(0, w)|^2,      w = s + sigma (B' y - g),
///
/// and takes s = max(0, w). The function is piecewise quadratic: semismooth Newton with (Mbar + sigma B_A
/// B_A') dy = -gradient, A = {w > 0}, and a line search that is exact on the pieces ends after finitely many
/// steps. Because Mbar is positive definite y is unique, however many forces would do (Rockafellar 1976), and
/// with sigma growing a handful of rounds suffices. A matrix is factorised only when A has changed.
///
/// \param start forces of the last step, and where the blocks are heading (both sized as in the solution, or
/// empty). The better they are, the fewer steps.
/// \param kept of the last program, to be used where the same bodies touch (RayProgram.h); not owned
/// \return `optimal` when the certificate meets the tolerance, otherwise `notConverged` with the last iterate
/// Cohesion bounds the rays of pure shear from above: there s = min(max(0, w), bound), and A = {0 < w <
/// bound}. \throws std::invalid_argument for a program without inertia, with a multiplier, crushing or
/// compliance
ConeSolution solveAugmentedLagrangian(const PlaneConeProgram& program, const ConeSolution& start,
                                      const AugmentedLagrangianSettings& settings = {},
                                      SymbolicAnalysis* kept = nullptr);

/// Solves a program of space likewise, with projections onto round friction cones for max(0, .):
/// |Proj(w)|^2 / (2 sigma) is once differentiable and its gradient semismooth (Hayashi, Yamashita & Fukushima
/// 2005), so that Newton's steps converge fast though no longer in finitely many.
ConeSolution solveAugmentedLagrangian(const SpaceConeProgram& program, const ConeSolution& start,
                                      const AugmentedLagrangianSettings& settings = {});

} // namespace drystone
