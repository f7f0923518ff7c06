// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Coulomb's law in a step by following the forces of the step before.
#pragma once

#include "dynamics/FlowProblem.h"

namespace drystone
{

/// How often Coulomb's law is linearised anew in a step before another way is taken.
inline constexpr int mostRelinearisations = 10;

/// Whether the flow of such steps is followed. Then the smallest overlap stands for a force: none may be
/// taken for rounding, which each step would put in its place.
inline bool followsFlow(const StepSettings& settings)
{
    return settings.flowRule == FlowRule::nonAssociative && settings.overlaps != Overlaps::none;
}

/// By how much points that are followed may give way, so that they count as touching [m]; 0 where none are.
inline double yieldingOf(const StepSettings& settings)
{
    return followsFlow(settings) ? settings.contactOverlap * settings.blockSize : 0;
}

/// Which forces it may begin with.
enum class Following
{
    notAtAll,
    fromLastStep, ///< those that the last step was followed to
    fromAnyForces ///< by way of softer points, where these are not near
};

/// Whether forces are those of the overlaps that there are when a step begins: the last one was followed.
template<int Dim>
bool areFollowed(const StepProgram<Dim>& program, const Eigen::VectorXd& contactForce);

/// Coulomb's law by following forces from a start to those of points that overlap by up to
/// `contactOverlap` (conic/coulomb/ContactPath.h). Rigid forces are not unique, and with them neither is the
/// motion: these are the least, so that the motion depends on the places and velocities of the blocks only,
/// and changes as they do. Overlaps that nothing would close later, of an impact or with theta below 1, are
/// closed again by multipliers. Only with forces to begin with. \return whether it was reached; otherwise the
/// step is as it was but for the work counted
template<int Dim>
bool followFlow(ThetaStep& step, const FlowProblem<Dim>& problem, const ConeSolution& start,
                Following following);

} // namespace drystone
