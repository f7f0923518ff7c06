// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The log of a run through time: its scene before the first step, each step, and its end.
#pragma once

#include "dynamics/Motion.h"
#include "functionObjects/MotionSummary.h"

#include <filesystem>
#include <string>
#include <vector>

namespace drystone
{

/// Before the first step: effects, ground motion with its peak, duration and unit, schemes, size, functions.
template<int Dim>
void printScene(const DynamicCase<Dim>& scene, const Motion<Dim>& motion, const Time& time,
                const std::vector<std::string>& functions);

/// Before the first step: that a live load, which a case may have for limitAnalysis, does not act.
void printUnappliedLoad(const std::filesystem::path& caseDirectory);

/// With `selection everything`: what is on although the case leaves it out.
template<int Dim>
void printAddedEffects(const DynamicCase<Dim>& scene);

/// After a step, where logFrequency has its turn:
/// `interiorPoint:  Solving for contact, Initial residual = .., Final residual = .., No Iterations ..`,
/// events (joints that break, a step that was shortened) and the CPU time. Of other steps the events only,
/// under their time.
template<int Dim>
void printStep(const DynamicCase<Dim>& scene, const Motion<Dim>& motion, const Time& time);

/// Before the closing lines of a run that has gone on from a state of an earlier one: that they are of its
/// own steps.
void printWhereRunBegan(const Time& time);

/// After the last step: its largest displacement, whether the blocks rest, and a warning where these are not
/// the small displacements that the schemes take them for.
template<int Dim>
void printSummary(const MotionSummary<Dim>& summary, const Motion<Dim>& motion);

/// After the last step: what theta above 1/2 has dissipated outside impacts, as an estimate of the error.
template<int Dim>
void printIntegrationError(const DynamicCase<Dim>& scene, const Motion<Dim>& motion, const Time& time);

/// After the last step: the time that each stage of the steps has taken, and its part of all.
void printStageTimes(const StageTimes& times);

/// After the last step of a run with `selection automatic`: on which share of the steps and of the blocks its
/// effects acted, the time that the steps have taken and saved, and what verifyInterval has found.
template<int Dim>
void printEffectUse(const DynamicCase<Dim>& scene, const Motion<Dim>& motion);

/// `End`, or where a run was stopped before its end and whether its state is kept.
void printStopOrEnd(const Time& time);

} // namespace drystone
