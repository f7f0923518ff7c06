// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Contact points where the hinges of joints that crush come to lie.
#pragma once

#include "conic/ConeProgram.h"
#include "contact/ContactPoint.h"

#include <vector>

namespace drystone
{

/// Contact points of joints, and what each carries; points of one joint follow each other, from end to end.
struct JointPoints
{
    std::vector<ContactPoint<2>> points;
    std::vector<double> friction;
    std::vector<Strength> strength; ///< of its part of the joint, see pointAreas
};

/// Adds a point to each joint which bears more with its points than it could.
///
/// A joint of length l that bears the pressure s and the tension T/l a metre turns about the end of a zone of
/// the depth u in which it crushes: with P = N + T = (s + T/l) u the resultant of s + T/l over that zone, P
/// lies no nearer to the end of the joint than
///
///     u/2,   u = l P / (S + T),   S = s l.
///
/// Points, each with its part of the joint, bear P at M(P) = the integral of their distances instead: a
/// polygon about that parabola, which touches it where u is the place of a point. So a multiplier found with
/// points is never too low, and one more point at u of the forces found is a tangent there (Kelley's cutting
/// planes): it converges as Newton's method does, with points where hinges are and nowhere else. Joints
/// without a limit to their pressure stay as they are.
/// \param contactForces of one or more solutions, (n, t) of each point [N]
/// \param tolerance by how much of l P a moment may be beyond the limit
/// \return whether any was added
bool addCrushingHinges(JointPoints& joints, const std::vector<Eigen::VectorXd>& contactForces,
                       double tolerance);

} // namespace drystone
