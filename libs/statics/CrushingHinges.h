// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Contact points where the hinges of joints that crush come to lie.
#pragma once

#include "statics/JointPoints.h"

#include <Eigen/Core>

#include <vector>

namespace drystone
{

/// Adds points to each joint which bears more with its points than it could. What a joint of area A could:
/// any distribution of stress between the tension T/A and the pressure s = S/A that it crushes under. With
/// P = N + T the resultant of the stress above the tension, P lies no farther towards any side than that of a
/// zone which bears s + T/A everywhere, cut off on that side with the area
///
///     a = A P / (S + T)
///
/// (the rectangular stress block), since no other stress of this resultant lies farther there.
///
/// In the plane the joint has two sides, its ends: of the length l the zone takes u = l P/(S + T), and P lies
/// no nearer to the end than u/2. Points, each with its part of the joint, bear P at M(P) = the integral of
/// their distances instead: a polygon about that parabola, which touches it where u is the place of a point.
/// So a multiplier found with points is never too low, and one more point at u of the forces found is a
/// tangent there (Kelley's cutting planes): it converges as Newton's method does, with points where hinges
/// are and nowhere else.
///
/// In space a patch has a side in every direction. Its points never carry less than it does (vertexAreas),
/// and no more towards a side where the edge of that zone is an edge of cells: patches are cut along the one
/// in whose direction P lies farthest beyond it. That is one direction, since the limits of the moment at a
/// given P are convex.
///
/// Joints without a limit to their pressure stay as they are. That shear acts where the pressure is, which
/// counts where joints are twisted, is left to refineJoints (JointDissipation.h). \param contactForces of one
/// or more solutions, (n, t), in space (n, t1, t2), of each point [N] \param tolerance by how much of P times
/// the length of the joint, in space across the side, a moment may be beyond the limit \return whether any
/// was added
bool addCrushingHinges(JointPoints<2>& joints, const std::vector<Eigen::VectorXd>& contactForces,
                       double tolerance);
bool addCrushingHinges(JointPoints<3>& joints, const std::vector<Eigen::VectorXd>& contactForces,
                       double tolerance);

} // namespace drystone
