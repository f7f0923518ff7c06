// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Whether forces and a mechanism obey Coulomb's law together: judged from the problem data alone, whoever
/// found them.
#pragma once

#include "conic/ConeProgram.h"

namespace drystone
{

/// How far a pair is from Coulomb's law without dilatancy, with the strengths of the points. Of point k, with
/// contact force (n, t), opening rate g = -(A'y)_n and slip s = (A'y)_t, in space a vector:
///
///     A c = f + alpha L,  L'y = 1 (or 0 where the dead load alone drives y)               balance
///     -T <= n <= N,  |t| <= C + mu n                                                      yield
///     g >= 0 unless n = N,  g <= 0 unless n = -T,  t = (C + mu n) s/|s| unless s = 0      flow
///     sum_k (C + mu n) |s| - t's = 0, and sum_k of n g but for -T and N at their limits   mismatch
///
/// Loads are relative to the largest dead or live load on a body (moments by the mean lever arm), forces to
/// the largest contact force, or that load where it is larger (a stone that is lifted out of a slot presses
/// on nothing), rates to the largest rate of a body, powers to what the dead load does. Of two figures of
/// which one has to vanish the lesser counts: the rate at which a point opens and what it presses with; its
/// slip and what its shear lacks of the limit against it.
struct CoulombResiduals
{
    double balance = 0;
    double yield = 0;
    double flow = 0;
    double mismatch = 0;
    double worst() const; ///< the largest of the four; infinite where one is not a number
};

/// \param contactForce c, F k \param mechanism y, R b \param liveWork what L'y has to be
template<int Rows, int Forces>
CoulombResiduals coulombResiduals(const ConeProgram<Rows, Forces>& program, double alpha,
                                  const Eigen::VectorXd& contactForce, const Eigen::VectorXd& mechanism,
                                  double liveWork = 1);

} // namespace drystone
