// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The multiplier by upper bounds: slower than the interior point, and for programs at which that fails.
#pragma once

#include "conic/ConeProgram.h"

namespace drystone
{

/// Whether a program is of the kind that solveByUpperBounds takes: with a multiplier, and without inertia,
/// compliance, gaps or strengths.
template<int Rows, int Forces>
bool hasUpperBounds(const ConeProgram<Rows, Forces>& program);

/// Solves a program of the plane or of space with a multiplier, and without inertia, compliance, gaps or
/// strengths,
///
///     maximise alpha    subject to    A c = f + alpha L,    |c_t| <= mu c_n,
///
/// by programs without multiplier. For one alpha the least r, in the metric of unit masses, with r + A c = f
/// + alpha L is found by the augmented Lagrangian, whose active set is exact. Where r does not vanish, y =
/// M^-1 r is a mechanism (-A'y in the dual cone) on which the load works, (f + alpha L)'y = r'y > 0; with L'y
/// = 1 it bounds the multiplier by -f'y < alpha, which is the next alpha: Newton's method for the distance of
/// f + alpha L from the loads that are carried. That distance is made of finitely many smooth pieces, and the
/// last y is exact while r is still large, so that the last bound is too. There r vanishes, and its c proves
/// that the bound is reached.
///
/// \param from where to begin: any alpha; the nearer from above, the fewer programs
/// \param tolerance on every figure of the certificate
/// \param maximumIterations of each program, at most 40 of which are solved
/// \return `optimal` or `notConverged`, with the multiplier of the last bound, forces that are nearest to the
/// balance with it, and its mechanism, L'y = 1, or zeros where no program has had one; iterations and
/// factorisations of all programs
/// \throws std::invalid_argument for a program of another kind
template<int Rows, int Forces>
ConeSolution solveByUpperBounds(const ConeProgram<Rows, Forces>& program, double from, double tolerance,
                                int maximumIterations);

} // namespace drystone
