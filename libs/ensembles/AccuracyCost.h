// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Evaluation of the runs of accuracyCost: errors over the phases, knees of tolerance, cheapest settings,
/// profiles of solvers, comparison of settings. It needs measurements only, no case.
#pragma once

#include "ensembles/AccuracySettings.h"

#include <vector>

namespace drystone
{

/// The runs of one setting.
struct AccuracyPoint
{
    RunSetting setting;
    int planned = 0;        ///< runs: phases of a motion, repeats of a multiplier
    int runs = 0;           ///< carried out; fewer when the first of them were not solved
    int failed = 0;         ///< that were not solved, or did not have the figure
    int unsolved = 0;       ///< of these: not solved
    double value = 0;       ///< median; nan when any failed, as the errors
    double medianError = 0; ///< |value/reference - 1| over the phases
    double worstError = 0;
    double hover = 0;   ///< median of the largest gap at a point that carries force [m]
    double steps = 0;   ///< mean
    double cpuTime = 0; ///< median [s]
    double worstResidual = 0;
    std::vector<double> runTimes; ///< CPU time of each planned run [s]; infinite unless it is done

    bool isWhole() const { return runs > 0 && failed == 0; }
};

/// \param runs of one setting, none of them interrupted \param planned number of runs intended
AccuracyPoint summarise(const RunSetting& setting, const std::vector<Measurement>& runs, double reference,
                        std::size_t planned);

/// One completed sweep.
struct SweepResult
{
    std::string name;
    std::size_t quantity = 0; ///< index into the quantities
    SweepAxis axis = SweepAxis::deltaT;
    std::vector<AccuracyPoint> points;
};

/// A setting that several sweeps of a quantity have is the same point in all of them: that with the most
/// phases, for medians over few phases differ from those over many. CPU times of single runs (runTimes) stay
/// those of each sweep, whose solvers are compared run by run.
void shareMostPhases(std::vector<SweepResult>& sweeps);

/// Points that differ only along the axis, from coarse to fine; curves in the order of the sweep.
std::vector<std::vector<AccuracyPoint>> curvesOf(const SweepResult& sweep);

/// Where a curve along the tolerance bends: the largest tolerance from which on no median error is above
/// twice that of the smallest tolerance reached. A smaller one costs time without gain.
/// \param curve from large to small tolerance
/// \param uncertainty of the reference, relative: errors below it are regarded as equal
/// \return its index; nothing when that is the smallest tolerance itself
std::optional<std::size_t> kneeOf(const std::vector<AccuracyPoint>& curve, double uncertainty = 0);

/// Which error over the phases is decisive.
enum class ErrorMeasure
{
    median,
    worst
};

/// The setting of smallest CPU time whose error is not above a level; nothing when none reaches it.
const AccuracyPoint* cheapest(const std::vector<AccuracyPoint>& points, double level, ErrorMeasure measure);

/// One solver compared with the fastest on the same problems (Dolan & More 2002).
struct SolverProfile
{
    SolverType solver = SolverType::automatic;
    std::vector<double>
        ratios; ///< CPU time over that of the fastest solver, for each problem solved, ascending
    std::size_t problems = 0; ///< solved or not

    /// Fraction of the problems that it solves within `ratio` times the time of the fastest.
    double at(double ratio) const;
};

/// Profiles of the solvers at one tolerance; empty when there is only one. A problem is one phase of a
/// setting without its solver; one that no solver has solved is omitted.
std::vector<SolverProfile> solverProfiles(const std::vector<AccuracyPoint>& points, double tolerance);

/// Two points that differ in one setting.
struct PointPair
{
    const AccuracyPoint* first = nullptr;
    const AccuracyPoint* second = nullptr;
};

/// Associative compared with Coulomb. The pointers are into `points`.
std::vector<PointPair> flowRulePairs(const std::vector<AccuracyPoint>& points);

/// Large displacements compared with small ones.
std::vector<PointPair> displacementPairs(const std::vector<AccuracyPoint>& points);

/// Contact by points compared with contact by surfaces.
std::vector<PointPair> formulationPairs(const std::vector<AccuracyPoint>& points);

/// All effects that the case names in every step compared with those that each step calls for.
std::vector<PointPair> effectPairs(const std::vector<AccuracyPoint>& points);

/// Effects that were chosen, by the case or by each step, whatever its flow rule and displacements, compared
/// with everything on.
std::vector<PointPair> everythingPairs(const std::vector<AccuracyPoint>& points);

/// Few points per joint, or along each side of it in space, compared with the largest number available.
std::vector<PointPair> jointPointsPairs(const std::vector<AccuracyPoint>& points);

/// The limit of figures at steps 4 h, 2 h and h, with the order that they show.
struct Extrapolation
{
    double value = 0;
    double order = 0;       ///< 0: none between 0.5 and 4.5 was found, and `value` is the last of them
    double uncertainty = 0; ///< |value - last|, or the largest difference when there is no order
};
Extrapolation extrapolate(double coarse, double middle, double fine);

} // namespace drystone
