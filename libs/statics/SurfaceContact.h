// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Contact by surfaces: limit analysis in the stress resultants of the joints.
#pragma once

#include "statics/LimitAnalysis.h"

namespace drystone
{

/// Stress resultants of a joint about its middle, on the first of its two blocks.
struct JointResultant
{
    ContactPoint<2> joint; ///< of the middle: blocks, position, normal
    double halfLength = 0; ///< l/2 [m]
    double friction = 0;   ///< mu
    Eigen::Vector3d force{
        0, 0, 0}; ///< (N, T, M): M positive where the pressure lies towards the tangent [N, N, N m]
};

/// The resultants of forces at the ends of the joints. \param points two a joint, as findContactPoints gives
/// them \param friction mu of each \param contactForce (n, t) of each [N]
std::vector<JointResultant> jointResultants(const std::vector<ContactPoint<2>>& points,
                                            const std::vector<double>& friction,
                                            const Eigen::VectorXd& contactForce);

/// Certificate of a collapse as a solution of
///
///     max alpha   subject to   B s = fD + alpha fL,   |T| <= mu N,   |M| <= N l/2   at every joint,
///
/// s the resultants (N, T, M), B made from the middles of the joints. The limits form a pyramid over a
/// rectangle, whose four edges are the forces (1, +-mu) at the two ends of the joint: every s within it is a
/// sum of such forces and the other way round. So the program is solved over its edges, which is contact by
/// points, and the solution is certified here in resultants, from the joints and not from the points:
/// equilibrium and limits (primal), opening >= mu |slip| + l/2 |rotation| at every joint (dual), and equal
/// objectives (gap), relative as in conic/Certificate.h. With the crushing of more points than two a joint
/// this would not hold.
Certificate certifySurfaceContact(const Assembly<2>& assembly, const std::vector<JointResultant>& joints,
                                  const LoadVectors& loads, const LimitAnalysis& collapse);

} // namespace drystone
