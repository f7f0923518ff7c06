// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// How far a claimed solution is from being one, computed from the problem data alone, without the solvers.
#pragma once

#include "conic/ConeProgram.h"

namespace drystone
{

/// Relative errors of a solution, or of the ray that proves there is none. Each is a maximum over entries,
/// made dimensionless by the size of what it is compared with, so that units change nothing: forces by the
/// largest load on a body, moments by that times the mean lever arm of the contact points, displacements by
/// the largest displacement.
///
/// A point with a Strength has the set K = {-T <= c_n <= N, |c_t| <= C + mu c_n} instead of the cone. The
/// dual objective then has the term min over K of z'c, which with d = z_n - mu |z_t| is -C |z_t| - T d for d
/// >= 0 and -C |z_t| + N d for d < 0: where N is finite any z will do, and a wrong one shows in the duality
/// gap.
struct Certificate
{
    double primalResidual = 0; ///< of r + A c = f + alpha L and of |c_t| <= mu c_n
    double dualResidual = 0;   ///< of mu |z_t| <= z_n with z = g + C c - A' y, and of L' y = 1
    double dualityGap = 0;     ///< difference of the primal and the dual objective

    /// The largest of the three.
    double worst() const;
};

/// Certificate of an optimal solution. NaN anywhere makes every figure infinite.
template<int Rows, int Forces>
Certificate certifyOptimal(const ConeProgram<Rows, Forces>& program, const ConeSolution& solution);

/// Certificate that no contact forces balance f + alpha L for any alpha (Farkas): y with -A' y in the dual
/// cone, L' y = 0 and f' y > 0, because then y' (A c - alpha L) <= 0 < f' y. With strengths the most that y'A
/// c can be is taken from f' y. `dualityGap` is 0 when what remains is clearly positive and infinite
/// otherwise; `dualResidual` is relative to it.
template<int Rows, int Forces>
Certificate certifyInfeasible(const ConeProgram<Rows, Forces>& program,
                              const Eigen::VectorXd& displacementRay);

/// Certificate that alpha has no bound: c in the cone with A c = L, and zero where crushing bounds it.
template<int Rows, int Forces>
Certificate certifyUnbounded(const ConeProgram<Rows, Forces>& program, const Eigen::VectorXd& forceRay);

/// The certificate that belongs to the status that a solution claims; that of an optimum for `notConverged`.
template<int Rows, int Forces>
Certificate certify(const ConeProgram<Rows, Forces>& program, const ConeSolution& solution);

} // namespace drystone
