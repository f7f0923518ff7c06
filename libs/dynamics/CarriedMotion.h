// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// How blocks move that stand on a support which moves, and stay where they are on it.
#pragma once

#include "dynamics/Step.h"

namespace drystone
{

/// The displacements of all bodies in the step, were they fixed to the supports; empty where these rest, or
/// are several, which may move apart [m, rad]. The blocks are where the step begins.
template<int Dim>
Eigen::VectorXd carriedDisplacement(const Step<Dim>& step);

/// Their mean velocities from one instant to another, where the blocks are now [m/s, rad/s]; likewise empty.
template<int Dim>
Eigen::VectorXd carriedVelocity(const Step<Dim>& step, double from, double to);

} // namespace drystone
