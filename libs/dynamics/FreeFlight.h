// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Blocks that no contact force acts on in a step: they move by the mean of their velocities, see collide.
#pragma once

#include "dynamics/Step.h"

namespace drystone
{

/// What blocks in free flight move by beyond the step: the mean of their velocities and not the step's.
/// Empty where there is none. \param result of the step from `velocity` on \param free points that no force
/// acts on, whatever the result says
template<int Dim>
Eigen::VectorXd flightOf(const Step<Dim>& step, const ThetaStep& result, const Eigen::VectorXd& velocity,
                         const std::vector<std::size_t>& free = {});

/// The same without what would lead blocks into each other.
template<int Dim>
Eigen::VectorXd flightApart(const Step<Dim>& step, const ThetaStep& result, const Eigen::VectorXd& velocity);

/// Gaps, and minus the slips, where a step and then a flight take the blocks [m].
template<int Dim>
Eigen::VectorXd openingAfterFlight(const Step<Dim>& step, const ThetaStep& result,
                                   const Eigen::VectorXd& flight);

} // namespace drystone
