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

/// All digits, from whatever start: what proofs need where little is out of balance.
AugmentedLagrangianSettings exactSettings(int maximumIterations);

/// Solves a program with inertia (a time step), of the plane or of space, by the method of multipliers on its
/// dual,
///
///     minimise  1/2 y' Mbar y - f' y   subject to   g - B' y in K,     multipliers s in K,    c = R s,
///
/// with the friction cones in the standard form of form/Form.h. Each round minimises
///
///     1/2 y' Mbar y - f' y + 1/(2 sigma) |P(w)|^2,      w = s + sigma (B' y - g),
///
/// where P projects onto K, max(0, .) on a ray, and takes s = P(w). With rays the function is piecewise
/// quadratic: semismooth Newton with (Mbar + sigma B_A B_A') dy = -gradient, A = {w > 0}, and a line search
/// that is exact on the pieces ends after finitely many steps, and a matrix is factorised only when A has
/// changed. With round cones |P(w)|^2 is once differentiable and its gradient semismooth (Hayashi, Yamashita
/// & Fukushima 2005), so that the steps converge fast though no longer in finitely many. Because Mbar is
/// positive definite y is unique, however many forces would do (Rockafellar 1976), and with sigma growing a
/// handful of rounds suffices. Cohesion bounds rays of pure shear, and discs: P is onto the bounded set
/// there.
///
/// \param start forces of the last step, and where the blocks move to (both sized as in the solution, or
/// empty). The better they are, the fewer steps.
/// \param kept of the last program, to be used where the same bodies touch (form/Form.h); not owned
/// \return `optimal` when the certificate meets the tolerance, otherwise `notConverged` with the last iterate
/// \throws std::invalid_argument for a program without inertia, with a multiplier, crushing or compliance
template<int Rows, int Forces>
ConeSolution solveAugmentedLagrangian(const ConeProgram<Rows, Forces>& program, const ConeSolution& start,
                                      const AugmentedLagrangianSettings& settings = {},
                                      SymbolicAnalysis* kept = nullptr);

} // namespace drystone
