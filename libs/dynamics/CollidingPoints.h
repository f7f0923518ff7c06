// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Which points of a step collide, and whether at its start or in the course of it.
#pragma once

#include "dynamics/Step.h"

#include <cstddef>
#include <vector>

namespace drystone
{

/// Points that the step closes, each list ascending.
struct CollidingPoints
{
    std::vector<std::size_t> now;   ///< at the start of the step, where one of them closes then
    std::vector<std::size_t> later; ///< in the course of it
    /// At the start after all, of structures of which too many pairs of bodies meet in the course of it.
    std::vector<std::size_t> crowded;
    std::vector<std::size_t> all; ///< those at rest, too
    bool isReturning = false;     ///< none closes when it begins, but some part, and are back before its end
};

/// With ImpactInstant::stepStart all collide now that the step closes, if one was closing when it began.
/// \param closing velocity of the points [m/s], Dim a point
template<int Dim>
CollidingPoints collidingPoints(const Step<Dim>& step, const Eigen::VectorXd& closing);

/// With points that meet in the course of the step all others that are open and close, but for those of
/// crowded structures: which of several that meet together carry the force is one choice of many, and what
/// the others do until then has to be without them too. \param closing likewise
template<int Dim>
std::vector<std::size_t> withOthersApart(const Step<Dim>& step, const Eigen::VectorXd& closing,
                                         const CollidingPoints& colliding);

/// Points that would part slower after an impact do not part at all: their flight would be too short [m/s].
template<int Dim>
double slowestRebound(const Step<Dim>& step);

/// Whether the forces are one choice of many, from a program with fewer bodies, or of the associative law in
/// place of Coulomb's. Which points take part in an impact follows from forces: then any that is closed at
/// the end counts as if it carried one, and if none of these collides no forces make an impact.
template<int Dim>
bool isReduced(const Step<Dim>& step);

/// Whether closing velocities as small as the errors of a solution count: by the associative law, where any
/// point that carries a force may then collide.
template<int Dim>
bool isByErrors(const Step<Dim>& step);

} // namespace drystone
