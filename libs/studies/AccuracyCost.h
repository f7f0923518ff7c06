// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// What the runs of accuracyCost say: errors over the phases, knees of tolerance, cheapest settings, profiles
/// of solvers, one setting against another.
#pragma once

#include "studies/AccuracySettings.h"

#include <vector>

namespace drystone
{

/// The runs of one setting.
struct AccuracyPoint
{
    RunSetting setting;
    int planned = 0;        ///< runs: phases of a motion, repeats of a multiplier
    int runs = 0;           ///< that were made; fewer when the first of them were not solved
    int failed = 0;         ///< that were not solved, or did not have the figure
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

/// \param runs of one setting, none of them interrupted \param planned as many runs as there were to be
AccuracyPoint summarise(const RunSetting& setting, const std::vector<Measurement>& runs, double reference,
                        std::size_t planned);

/// One sweep that is done.
struct SweepResult
{
    std::string name;
    std::size_t quantity = 0; ///< index into the quantities
    SweepAxis axis = SweepAxis::deltaT;
    std::vector<AccuracyPoint> points;
};

/// Points that differ along the axis alone, from coarse to fine; curves in the order of the sweep.
std::vector<std::vector<AccuracyPoint>> curvesOf(const SweepResult& sweep);

/// Where a curve along the tolerance bends: the loosest tolerance from which on no median error is above
/// twice that of the tightest one that is reached. A tighter one costs time and gains nothing. \param curve
/// from loose to tight \param uncertainty of the reference, relative: errors below it are all the same
/// \return its index; nothing when that is the tightest one itself
std::optional<std::size_t> kneeOf(const std::vector<AccuracyPoint>& curve, double uncertainty = 0);

/// Which error over the phases counts.
enum class ErrorMeasure
{
    median,
    worst
};

/// The setting of least CPU time whose error is not above a level; nothing when none reaches it.
const AccuracyPoint* cheapest(const std::vector<AccuracyPoint>& points, double level, ErrorMeasure measure);

/// How one solver compares with the best on the same problems (Dolan & More 2002).
struct SolverProfile
{
    SolverType solver = SolverType::automatic;
    std::vector<double>
        ratios; ///< CPU time over that of the fastest solver, for each problem solved, ascending
    std::size_t problems = 0; ///< solved or not

    /// Part of the problems that it solves within `ratio` times the time of the fastest.
    double at(double ratio) const;
};

/// Profiles of the solvers at one tolerance; empty when there is but one. A problem is one phase of what two
/// points have in common that differ in the solver alone; one that no solver has solved is left out.
std::vector<SolverProfile> solverProfiles(const std::vector<AccuracyPoint>& points, double tolerance);

/// Two points that differ in one thing.
struct PointPair
{
    const AccuracyPoint* first = nullptr;
    const AccuracyPoint* second = nullptr;
};

/// Associative against Coulomb. The pointers are into `points`.
std::vector<PointPair> flowRulePairs(const std::vector<AccuracyPoint>& points);

/// Large displacements against small ones.
std::vector<PointPair> displacementPairs(const std::vector<AccuracyPoint>& points);

/// Contact by points against that by surfaces.
std::vector<PointPair> formulationPairs(const std::vector<AccuracyPoint>& points);

/// Some points a joint against the most that there are.
std::vector<PointPair> pointsPerJointPairs(const std::vector<AccuracyPoint>& points);

/// The limit of figures at steps 4 h, 2 h and h, with the order that they show.
struct Extrapolation
{
    double value = 0;
    double order = 0;       ///< 0: they show none between 0.5 and 4.5, and `value` is the last of them
    double uncertainty = 0; ///< |value - last|, or the largest difference when there is no order
};
Extrapolation extrapolate(double coarse, double middle, double fine);

} // namespace drystone
