// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Newton's method for steps in time whose contact points all give way under force.
#pragma once

#include "conic/ConeProgram.h"

namespace drystone
{

struct SymbolicAnalysis;

/// When Newton's method for points that give way ends.
struct ElasticNewtonSettings
{
    double tolerance = 1e-9;     ///< on every figure of the certificate
    int maximumIterations = 200; ///< Newton steps
};

/// With C > 0 the forces follow from the displacements point by point, as in plasticity: the trial
/// c* = C^-1 (A'y - g) where it lies in the cone, else the point of the cone that is nearest to it in the
/// measure of C. So the step is the least of the function without constraints
///
///     phi(y) = 1/2 y' Mbar y - f'y + sum_k max over c in K of (A'y - g)'c - 1/2 c'Cc,
///     phi'   = Mbar y + A c(y) - f,        phi'' = Mbar + sum_k A_k D_k A_k',
///
/// which is convex, once differentiable and, in the plane, quadratic in pieces: D = C^-1 inside the cone, d
/// d'/(d'Cd) on its edge d = (1, mu e), e the direction of shear, 0 where the point is open. Newton's method
/// with a line search comes to it from any start, there in finitely many steps, and factorises a system of
/// the size of the blocks in each.
///
/// \param start its displacement is where the method begins; may be empty
/// \param kept analysis of the pattern, from program to program (form/Form.h), or null; not owned
/// \return `optimal` when the certificate meets the tolerance, else `notConverged` with the last iterate
/// \throws std::invalid_argument for a program without inertia, with a multiplier or strengths, or with a
/// point that does not give way in all directions, in all of shear alike
template<int Rows, int Forces>
ConeSolution solveElasticNewton(const ConeProgram<Rows, Forces>& program, const ConeSolution& start,
                                const ElasticNewtonSettings& settings = {}, SymbolicAnalysis* kept = nullptr);

} // namespace drystone
