// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// When in a step blocks meet first that are apart at its start.
#pragma once

#include "dynamics/Step.h"

namespace drystone
{

/// The step as if some points were not there.
struct Meeting
{
    ThetaStep result;
    bool isSolved = false;
    double part = 1; ///< of the step after which the first of them meet; 1: none does
};

/// \param closing velocities of the points of the step [m/s], Dim a point \param approaching points that the
/// step closes and that are apart at its start
template<int Dim>
Meeting firstMeeting(Step<Dim>& step, const Eigen::VectorXd& closing,
                     const std::vector<std::size_t>& approaching);

} // namespace drystone
