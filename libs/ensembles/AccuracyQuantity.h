// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Figures of a case whose errors accuracyCost measures, and their references.
///
/// Periods, distances, energies, thresholds and multipliers, which the equations determine. The path of a
/// structure that rocks for a long time is not among them, because it depends on rounding.
#pragma once

#include "dictionary/Registry.h"
#include "dynamics/Motion.h"
#include "ensembles/References.h"
#include "ensembles/RunSettings.h"
#include "statics/LimitAnalysisCase.h"

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
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

/// The value that a figure is compared with.
struct Reference
{
    double value = 0;
    double uncertainty = 0; ///< estimated error of the reference itself
    std::string text;       ///< where it comes from, for the page
};

/// A figure of a case, ready to be measured: it holds the case, of the plane or of space.
struct Quantity
{
    std::string summary; ///< `time at which block 1 is upright again for the 3rd time`
    std::string unit;
    /// One run. Depends only on its arguments, except for `cpuTime` and signals.
    std::function<Measurement(const RunSetting&, const StepPhase&)> measure;
    /// The figure from Housner's equation; empty where that does not give it.
    std::function<double()> housner = {};
};

/// The contents of `reference { type ...; }`.
struct ReferencePlan : RunSettingsOf<PerhapsOneOf> ///< of the finest run; absent: the value of the case
{
    enum class Kind
    {
        Housner,
        value,
        finest
    };
    Kind kind = Kind::finest;
    double value = 0;
    std::string source;
    int phases = 20;
    SourceLocation location;
};
const Registry<ReferencePlan>& referenceTypes();

/// Makes a quantity of a case. \throws FatalIOError for a block that does not exist, or is fixed, and for
/// what there is in the plane only
struct QuantityMaker
{
    template<int Dim>
    using Make = std::function<Quantity(const std::shared_ptr<const AccuracyCase<Dim>>&)>;

    Make<2> inPlane;
    Make<3> inSpace;

    Quantity operator()(const std::shared_ptr<const AccuracyCase<2>>& study) const { return inPlane(study); }
    Quantity operator()(const std::shared_ptr<const AccuracyCase<3>>& study) const { return inSpace(study); }
};

/// A quantity of the dictionary.
struct QuantityPlan
{
    QuantityKind kind = QuantityKind::motion;
    ReferencePlan reference;
    QuantityMaker make;
};

/// All types: returnTime, displacement, energy, threshold, multiplier.
const Registry<QuantityPlan>& quantityTypes();

/// The block of a case to which Housner's equation applies: one free rectangle on a fixed ground, whose only
/// rebound is that of the impact, with its initial rotation.
struct HousnerCase
{
    RockingBlock block;
    RockingState start;
    int index = 0; ///< of the block
};
/// \throws FatalError naming the property of the case that does not agree with Housner's equation
HousnerCase housnerCase(const AccuracyCase<2>& study);

/// Steps a case with a setting, and reports each state.
/// \param observe called before the first step with a step of 0, and after each one; false ends the run
/// \return how the run ended, with its costs; `value` remains 0
template<int Dim>
using MotionObserver = std::function<bool(const Motion<Dim>& motion, double timeStep)>;
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
