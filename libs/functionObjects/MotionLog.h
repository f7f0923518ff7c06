// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The log of a run through time: its scene before the first step, each step, and a failure with its remedy.
#pragma once

#include "dynamics/Motion.h"

#include <string>
#include <vector>

namespace drystone
{

/// Before the first step: effects, ground motion with its peak, duration and unit, schemes, size, functions.
template<int Dim>
void printScene(const DynamicCase<Dim>& scene, const Motion<Dim>& motion, const Time& time,
                const std::vector<std::string>& functions);

/// `interiorPoint:  Solving for contact, Initial residual = .., Final residual = .., No Iterations ..`
template<int Dim>
void printStep(const DynamicCase<Dim>& scene, const Motion<Dim>& motion);

/// After the last step: what theta above 1/2 has dissipated outside impacts, as an estimate of the error.
template<int Dim>
void printIntegrationError(const DynamicCase<Dim>& scene, const Motion<Dim>& motion);

/// After the last step: the time that each stage of the steps has taken, and its part of all.
void printStageTimes(const StageTimes& times);

/// `End`, or where a run was stopped before its end and whether its state is kept.
void printStopOrEnd(const Time& time);

/// Why a run ends here, and what may repair it.
template<int Dim>
std::string unsolvedStep(const DynamicCase<Dim>& scene, const Motion<Dim>& motion, const Time& time);

} // namespace drystone
