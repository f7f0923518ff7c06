// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// One run of a case with a setting in place of its own, and what it costs.
#pragma once

#include "dynamics/Motion.h"
#include "ensembles/RunSettings.h"
#include "statics/LimitAnalysisCase.h"

#include <functional>
#include <map>
#include <optional>
#include <type_traits>

namespace drystone
{

enum class QuantityKind
{
    motion,       ///< of runs in time, as contactDynamics makes them
    limitAnalysis ///< of collapse, as limitAnalysis finds it
};

/// The phase of the steps at which the motion begins: the first step is shortened, so that impacts occur at
/// different phases of the steps.
struct StepPhase
{
    int index = 0;
    int count = 1;
    double firstStep() const { return count > 1 ? (index + 0.5) / count : 1; } ///< [deltaT]

    friend auto operator<=>(const StepPhase&, const StepPhase&) = default;
};

enum class RunEnd
{
    done,
    unsolved, ///< a step, or the program, was not solved to the tolerance
    missing,  ///< the run has no such figure: the block did not return before endTime
    interrupted
};

/// The result of one run.
struct Measurement
{
    double value = 0;         ///< nan unless done
    double hover = 0;         ///< largest gap at a point that carries force, at the end of a step [m]
    double steps = 0;         ///< in time, or iterations of the solver
    double cpuTime = 0;       ///< [s]
    double worstResidual = 0; ///< of any step: primal, dual or gap
    RunEnd end = RunEnd::done;
};

/// The structure to be computed, read once; no run changes it.
template<int Dim>
struct AccuracyCase
{
    std::optional<DynamicCase<Dim>> scene; ///< where a quantity is one of motion
    DynamicState<Dim> start;
    double endTime = 0; ///< [s]
    /// By the number of contact points (jointPointsOf), 0: as specified in the case.
    std::map<int, LimitAnalysisCase<Dim>> structures;
};

/// The setting that counts the contact points of a joint: in the plane pointsPerJoint, in space
/// pointsPerSide.
template<int Dim>
int jointPointsOf(const RunSetting& setting)
{
    return Dim == 2 ? setting.pointsPerJoint : setting.pointsPerSide;
}

/// Called before the first step with a step of 0, and after each one; false ends the run.
template<int Dim>
using MotionObserver = std::function<bool(const Motion<Dim>& motion, double timeStep)>;

/// Steps a case with a setting, and reports each state; a step that is not solved is shortened as in
/// contactDynamics. \return how the run ended, with its costs; `value` remains 0
template<int Dim>
Measurement stepThrough(const DynamicCase<Dim>& scene, const AccuracyCase<Dim>& study,
                        const RunSetting& setting, const StepPhase& phase,
                        const std::type_identity_t<MotionObserver<Dim>>& observe);

/// The scene of a case with a setting in place of its own.
template<int Dim>
DynamicCase<Dim> sceneWith(const AccuracyCase<Dim>& study, const RunSetting& setting);

/// F: CPU time of one assembly, factorisation and solution of the Schur matrix of the case, that of its first
/// step or of its collapse [s].
template<int Dim>
double unitOfWork(const AccuracyCase<Dim>& study, const RunSetting& setting, QuantityKind kind);

} // namespace drystone
