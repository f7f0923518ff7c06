// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Limit analysis with Coulomb's law: joints that slide do not open.
#pragma once

#include "contact/ContactPoint.h"
#include "dictionary/Options.h"
#include "statics/LimitAnalysis.h"

namespace drystone
{

/// Keys of `nonAssociative { ... }` in system/solution/limitAnalysis.
struct NonAssociativeSettings
{
    int starts = 6;          ///< sequences from different normal forces, and as many from the mirror image
    int seed = 1;            ///< of the random numbers that the later starts are made from
    double tolerance = 1e-6; ///< on the residuals of yield and flow
};

void declare(Options& options, NonAssociativeSettings& settings);

/// How far forces c and a mechanism y are from collapse with Coulomb's law: equilibrium, |T| <= mu N in every
/// joint, no penetration, no opening where a point presses, and all friction at its limit where it slides.
/// Each figure is relative to the largest force, rate or power, as in Certificate.h.
struct CoulombResiduals
{
    double balance = 0; ///< of A c = f + alpha L, and of L'y = 1
    double yield = 0;   ///< |T| - mu N of a joint, and -n of a point, over the largest contact force
    double flow = 0;    ///< opening rate of a point that presses, or its penetration, over the largest rate
    double mismatch =
        0; ///< power that friction at its limit would take beyond what the forces take, over all of it
    double worst() const; ///< the largest of the four
};

/// \param joint of each point, from 0 \param alpha, contactForce and mechanism with L'y = 1
CoulombResiduals coulombResiduals(const PlaneConeProgram& program, const std::vector<int>& joint,
                                  double alpha, const Eigen::VectorXd& contactForce,
                                  const Eigen::VectorXd& mechanism);

/// Searches for the least multiplier at which forces and a mechanism obey Coulomb's law together (Ferris &
/// Tin-Loi 2001: a program with complementarity constraints, whose solutions are many).
///
/// With the normal forces N of the joints held, the mechanism is that of a plain program: cohesion mu N in
/// place of friction, so that the yield surface passes through the current point with slope zero and what
/// slides does not open (Gilbert, Casapulla & Ahmed 2006); N is that of the whole joint, because its points
/// slide together. With the mechanism held, least forces are those of a plain program too:
///
///     minimise  alpha + gamma sum_k (mu |s_k| + o_k) n_k,    s_k slip and o_k opening rate of point k:
///
/// a load multiplier as low as statics allow, with the dissipation of the mechanism as a penalty. From each
/// start the two are alternated with gamma growing, which leads to where low multipliers are; then the
/// sequence of Gilbert et al. closes what is left; then alpha is made least with the mechanism's sliding and
/// opening points held at their limits, exactly, and again with other mechanisms of the same normal forces
/// for as long as it falls.
///
/// The result is the lowest pair that meets `tolerance` (`optimal`, its residuals as the certificate: balance
/// and yield, flow, mismatch), or `notConverged`; a multiplier above that of the associative law cannot be.
/// It is an upper bound on the least of all pairs, which nothing here proves. What the friction cones cannot
/// carry is `unstable` with either law; `unbounded` means that the associative law has no collapse and no
/// other was met. \param joint of each contact point, from 0 \throws std::invalid_argument for a program with
/// strengths
LimitAnalysis solveNonAssociative(const PlaneConeProgram& program, const std::vector<int>& joint,
                                  const NonAssociativeSettings& settings = {},
                                  const InteriorPointSettings& solver = {});

/// Joint of each point, as ContactPoint::joint.
std::vector<int> jointsOf(const std::vector<ContactPoint<2>>& points);

} // namespace drystone
