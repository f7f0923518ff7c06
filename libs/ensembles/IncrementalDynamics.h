// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// A motion repeated over a growing intensity of the ground: system/incrementalDynamicsDict.
///
///     intensity { type step; unit g; from 0.6; to 0.7; step 0.001; }
///     criterion { type motion; displacement 1e-6; }
///     records   { elCentro { file "constant/elCentro.AT2"; } }     // instead of constant/groundMotion
#pragma once

#include "dynamics/Advance.h"
#include "effects/GroundMotion.h"
#include "ensembles/Intensity.h"
#include "quantities/Criterion.h"

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace drystone
{

/// A record of a multi-record analysis. The intensity is its peak, whatever the peak in the file.
struct StudyRecord
{
    std::array<double, 3> direction{1, 0, 0}; ///< of any length but zero
    RecordMotion record;
};
void declare(Options& options, StudyRecord& record);

/// The contents of the dictionary.
struct IncrementalDynamicsSettings
{
    IntensityPlan intensity;
    CriterionMaker criterion;
    std::vector<Named<StudyRecord>> records; ///< empty: constant/groundMotion is the one motion
    std::optional<int> jobs;                 ///< concurrent runs; absent: the number of cores
    bool stopWhenMet = true;                 ///< a run ends as soon as its verdict is known
};
void declare(Options& options, IncrementalDynamicsSettings& settings);

/// One ground motion of the study.
struct StudyMotion
{
    std::string name; ///< of the record; incrementalDynamics for constant/groundMotion
    GroundMotion ground;
    double peak = 0; ///< as read, of the strongest component [m/s2], positive
};

/// All data of an incremental analysis, the same for all its runs.
template<int Dim>
struct IncrementalDynamics
{
    DynamicCase<Dim> scene; ///< its motion of the ground is set for each run
    Motion<Dim> start;      ///< each run starts from a copy
    TimeControls controls;
    TimeState startTime;
    double gravity = 0; ///< of constant/g [m/s2]
    IntensityPlan intensity;
    Criterion<Dim> criterion;
    std::vector<StudyMotion> motions; ///< at least one
    int jobs = 1;
    bool stopWhenMet = true;

    /// An intensity of 1 in its unit [m/s2].
    double unitAcceleration() const { return intensity.unit == IntensityUnit::g ? gravity : 1; }
    /// The factor on the ground motion for which its peak is the intensity [-].
    double factor(const StudyMotion& motion, double value) const
    {
        return value * unitAcceleration() / motion.peak;
    }
};

/// The result of one run.
struct IncrementalRun
{
    double intensity = 0; ///< in the unit of the plan
    double factor = 0;    ///< on the motion of the ground [-]
    Verdict verdict = Verdict::stands;
    double largest = 0;       ///< of the criterion's quantity over the run
    double endTime = 0;       ///< when the run ended; with `meets`, when the criterion was met [s]
    long steps = 0;           ///< solved
    double worstResidual = 0; ///< of any step: primal, dual or gap
    /// Of a run that stands: the quantity ends with its largest value, at a rate at which it would gain a
    /// tenth of the limit in another run.
    bool isGrowing = false;
    double cpuTime = 0; ///< [s]
};

/// One run from the start at an intensity. A pure function of its arguments except for `cpuTime` and a signal
/// that requests the program to stop.
template<int Dim>
IncrementalRun runAt(const IncrementalDynamics<Dim>& study, const StudyMotion& motion, double intensity);

/// Runs of one motion of the ground, by increasing intensity.
using IncrementalCurve = std::vector<IncrementalRun>;

/// Called for each completed run, in an order that does not depend on the number of threads, from one thread
/// at a time. \param motion index into IncrementalDynamics::motions
using RunReport = std::function<void(std::size_t motion, const IncrementalRun& run)>;

/// All runs, on as many threads as there are. The result does not depend on their number. After a signal no
/// further run is
/// started. \param report of the runs that are carried out \param known of each motion, runs that are not
/// repeated; those that the plan does not request are left out; empty: none
/// \return one curve for each ground motion
template<int Dim>
std::vector<IncrementalCurve> carryOut(const IncrementalDynamics<Dim>& study, const RunReport& report = {},
                                       const std::vector<IncrementalCurve>& known = {});

/// Those of a curve that have a verdict: a run that a signal has interrupted has none.
IncrementalCurve finishedRuns(const IncrementalCurve& curve);

/// The conclusion from the verdicts. \param curve not empty
LeastIntensity leastIntensity(const IncrementalCurve& curve);

/// 0; 2 when a run did not converge; 128 + signal (130 for Ctrl-C) when one was interrupted.
int exitStatus(const std::vector<IncrementalCurve>& curves);

} // namespace drystone
