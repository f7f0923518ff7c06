// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Where iterations begin: from nothing, near a solution, or from where an earlier program passed. Internal
/// to the interior point.
#pragma once

#include "conic/interiorPoint/Newton.h"

namespace drystone
{

/// Where to begin from nothing.
enum class Start
{
    leastSquares, ///< Mehrotra's: fewest iterations; with `compliance`
    unit ///< all forces and openings e, no compliance: slower, but it reaches some that the other does not
};

/// The first iterate with a complementarity of at most this is kept for the next program: near enough to the
/// end to save iterations, and far enough from it that what has changed since leaves it inside its cones.
constexpr double complementarityOfInterior = 1e-2;

/// Mehrotra's start: the least forces that balance the load, and the least openings that are compatible, both
/// pushed inside their cones by as much as they lie outside and then apart until neither is out of proportion
/// to the other. Or all of them e. \return whether there is one
template<int Rows, class Scalar>
bool startFrom(Start from, State<Rows, Scalar>& state, NewtonSystem<Rows, Scalar>& newton);

/// With z = g - B'y for what the displacements open, the forces and openings of each cone are moved to where
/// their product is mu e and their difference what it was: (s + z)^2 = (s - z)^2 + 4 mu e. What presses keeps
/// its force, what is open its gap, and what may be either gets sqrt(mu) of both (Chen & Harker 1993 smooth
/// complementarity problems so). \param error e of the certificate of s and y: complementarity is of second
/// order in it, as both forces and openings are wrong by about as much
template<int Rows>
void startNear(const Eigen::VectorXd& s, const Eigen::VectorXd& y, double error, State<Rows, double>& state);

/// The displacements are moved on with those to come, and openings follow where they grow; what would close
/// keeps its opening, and the iterations repair the difference. A cone that is new is as open as the
/// displacements say, and has the force for which its product is that of the others.
/// \param interior its y from that of the solution; cones without force or opening are new \param
/// displacement about the y to come \return false where it is of another structure, or of another step
template<int Rows>
bool startInside(Iterate<double> interior, const Eigen::VectorXd& displacement, State<Rows, double>& state);

} // namespace drystone
