// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Statistics of measured runs, without any reference to how they were made.
#include "ensembles/AccuracyCost.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <utility>

namespace drystone
{
namespace
{

constexpr double never = std::numeric_limits<double>::infinity();

double median(std::vector<double> values)
{
    if (values.empty())
    {
        return std::numeric_limits<double>::quiet_NaN();
    }
    std::sort(values.begin(), values.end());
    const std::size_t half = values.size() / 2;
    return values.size() % 2 == 1 ? values[half] : (values[half - 1] + values[half]) / 2;
}

/// The pairs of points that `alike` makes equal, those of `first` with those of `second`.
template<class Alike, class IsFirst>
std::vector<PointPair> pairsOf(const std::vector<AccuracyPoint>& points, const Alike& alike,
                               const IsFirst& isFirst)
{
    std::vector<PointPair> pairs;
    for (const AccuracyPoint& first : points)
    {
        if (!isFirst(first.setting))
        {
            continue;
        }
        const auto second =
            std::find_if(points.begin(), points.end(),
                         [&](const AccuracyPoint& point)
                         { return !isFirst(point.setting) && alike(point.setting) == alike(first.setting); });
        if (second != points.end() && first.isWhole() && second->isWhole())
        {
            pairs.push_back({&first, &*second});
        }
    }
    return pairs;
}

/// Pairs of points whose settings differ in one member, which is `value` in the first of them.
template<class Value>
std::vector<PointPair> pairsAgainst(const std::vector<AccuracyPoint>& points, Value RunSetting::*member,
                                    Value value)
{
    return pairsOf(
        points,
        [member, value](RunSetting setting)
        {
            setting.*member = value;
            return setting;
        },
        [member, value](const RunSetting& setting) { return setting.*member == value; });
}

} // namespace

AccuracyPoint summarise(const RunSetting& setting, const std::vector<Measurement>& runs, double reference,
                        std::size_t planned)
{
    AccuracyPoint point;
    point.setting = setting;
    point.planned = static_cast<int>(planned);
    point.runs = static_cast<int>(runs.size());
    std::vector<double> values;
    std::vector<double> errors;
    std::vector<double> hovers;
    std::vector<double> times;
    for (const Measurement& run : runs)
    {
        point.failed += run.end == RunEnd::done ? 0 : 1;
        point.unsolved += run.end == RunEnd::unsolved ? 1 : 0;
        point.steps += run.steps / static_cast<double>(runs.size());
        point.worstResidual = std::max(point.worstResidual, run.worstResidual);
        values.push_back(run.value);
        errors.push_back(std::abs(run.value / reference - 1));
        hovers.push_back(run.hover);
        times.push_back(run.cpuTime);
        point.runTimes.push_back(run.end == RunEnd::done ? run.cpuTime : never);
    }
    point.runTimes.resize(std::max(planned, runs.size()), never);
    const double nothing = std::numeric_limits<double>::quiet_NaN();
    point.value = point.isWhole() ? median(values) : nothing;
    point.medianError = point.isWhole() ? median(errors) : nothing;
    point.worstError = point.isWhole() ? *std::max_element(errors.begin(), errors.end()) : nothing;
    point.hover = median(hovers);
    point.cpuTime = median(times);
    return point;
}

void shareMostPhases(std::vector<SweepResult>& sweeps)
{
    std::map<std::pair<std::size_t, RunSetting>, AccuracyPoint> most;
    for (const SweepResult& sweep : sweeps)
    {
        for (const AccuracyPoint& point : sweep.points)
        {
            const auto [known, isNew] = most.emplace(std::pair{sweep.quantity, point.setting}, point);
            if (!isNew && point.planned > known->second.planned)
            {
                known->second = point;
            }
        }
    }
    for (SweepResult& sweep : sweeps)
    {
        for (AccuracyPoint& point : sweep.points)
        {
            std::vector<double> runTimes = std::move(point.runTimes);
            point = most.at({sweep.quantity, point.setting});
            point.runTimes = std::move(runTimes);
        }
    }
}

std::vector<std::vector<AccuracyPoint>> curvesOf(const SweepResult& sweep)
{
    std::vector<std::vector<AccuracyPoint>> curves;
    for (const AccuracyPoint& point : sweep.points)
    {
        const RunSetting common = curveOf(point.setting, sweep.axis);
        auto curve = std::find_if(curves.begin(), curves.end(),
                                  [&](const auto& other)
                                  { return curveOf(other.front().setting, sweep.axis) == common; });
        if (curve == curves.end())
        {
            curve = curves.emplace(curves.end());
        }
        curve->push_back(point);
    }
    const bool isOfPoints = sweep.axis == SweepAxis::pointsPerJoint || sweep.axis == SweepAxis::pointsPerSide;
    const double towardsFine = isOfPoints ? 1 : -1;
    for (auto& curve : curves)
    {
        std::sort(curve.begin(), curve.end(),
                  [&](const AccuracyPoint& a, const AccuracyPoint& b) {
                      return towardsFine * alongAxis(a.setting, sweep.axis)
                             < towardsFine * alongAxis(b.setting, sweep.axis);
                  });
    }
    return curves;
}

std::optional<std::size_t> kneeOf(const std::vector<AccuracyPoint>& curve, double uncertainty)
{
    std::size_t reached = curve.size(); // the rest are tolerances that the solver cannot reach
    while (reached > 0 && !curve[reached - 1].isWhole())
    {
        --reached;
    }
    std::size_t knee = reached;
    const double gainsNothing = reached > 0 ? std::max(2 * curve[reached - 1].medianError, uncertainty) : 0;
    while (knee > 0 && curve[knee - 1].isWhole() && curve[knee - 1].medianError <= gainsNothing)
    {
        --knee;
    }
    return knee + 1 < reached ? std::optional(knee) : std::nullopt;
}

const AccuracyPoint* cheapest(const std::vector<AccuracyPoint>& points, double level, ErrorMeasure measure)
{
    const AccuracyPoint* best = nullptr;
    for (const AccuracyPoint& point : points)
    {
        const double error = measure == ErrorMeasure::median ? point.medianError : point.worstError;
        if (point.isWhole() && error <= level && (!best || point.cpuTime < best->cpuTime))
        {
            best = &point;
        }
    }
    return best;
}

double SolverProfile::at(double ratio) const
{
    const auto within = std::upper_bound(ratios.begin(), ratios.end(), ratio) - ratios.begin();
    return problems > 0 ? static_cast<double>(within) / static_cast<double>(problems) : 0;
}

std::vector<SolverProfile> solverProfiles(const std::vector<AccuracyPoint>& points, double tolerance)
{
    // CPU times by problem (setting and phase) and solver; infinite where the solver has failed.
    std::map<std::pair<RunSetting, std::size_t>, std::map<SolverType, double>> times;
    std::vector<SolverType> solvers;
    for (const AccuracyPoint& point : points)
    {
        if (point.setting.tolerance == tolerance)
        {
            RunSetting problem = point.setting;
            problem.solver = SolverType::automatic;
            for (std::size_t phase = 0; phase < point.runTimes.size(); ++phase)
            {
                times[{problem, phase}][point.setting.solver] = point.runTimes[phase];
            }
            if (std::find(solvers.begin(), solvers.end(), point.setting.solver) == solvers.end())
            {
                solvers.push_back(point.setting.solver);
            }
        }
    }
    std::vector<SolverProfile> profiles;
    if (solvers.size() < 2)
    {
        return profiles;
    }
    for (const SolverType solver : solvers)
    {
        SolverProfile profile;
        profile.solver = solver;
        for (const auto& [problem, bySolver] : times)
        {
            double fastest = never;
            for (const auto& [other, time] : bySolver)
            {
                fastest = std::min(fastest, time);
            }
            if (bySolver.size() < solvers.size() || !std::isfinite(fastest))
            {
                continue;
            }
            ++profile.problems;
            if (const double time = bySolver.at(solver); std::isfinite(time))
            {
                profile.ratios.push_back(time / fastest);
            }
        }
        std::sort(profile.ratios.begin(), profile.ratios.end());
        profiles.push_back(std::move(profile));
    }
    return profiles;
}

std::vector<PointPair> flowRulePairs(const std::vector<AccuracyPoint>& points)
{
    return pairsAgainst(points, &RunSetting::flowRule, FlowRule::associative);
}

std::vector<PointPair> displacementPairs(const std::vector<AccuracyPoint>& points)
{
    return pairsAgainst(points, &RunSetting::displacements, Displacements::large);
}

std::vector<PointPair> effectPairs(const std::vector<AccuracyPoint>& points)
{
    return pairsOf(
        points,
        [](RunSetting setting)
        {
            if (setting.effects == EffectSelection::automatic)
            {
                setting.effects = EffectSelection::asGiven;
            }
            return setting;
        },
        [](const RunSetting& setting) { return setting.effects == EffectSelection::asGiven; });
}

std::vector<PointPair> everythingPairs(const std::vector<AccuracyPoint>& points)
{
    const auto withEverything = [](RunSetting setting)
    {
        setting.effects = EffectSelection::everything;
        return asComputed(setting);
    };
    return pairsOf(points, withEverything,
                   [](const RunSetting& setting) { return setting.effects != EffectSelection::everything; });
}

std::vector<PointPair> formulationPairs(const std::vector<AccuracyPoint>& points)
{
    return pairsAgainst(points, &RunSetting::formulation, ContactFormulation::points);
}

std::vector<PointPair> jointPointsPairs(const std::vector<AccuracyPoint>& points)
{
    // A structure has one of the two: the other is 0.
    const auto number = [](const RunSetting& setting)
    { return std::max(setting.pointsPerJoint, setting.pointsPerSide); };
    int most = 0;
    for (const AccuracyPoint& point : points)
    {
        most = std::max(most, number(point.setting));
    }
    return pairsOf(
        points,
        [](RunSetting setting)
        {
            setting.pointsPerJoint = 0;
            setting.pointsPerSide = 0;
            return setting;
        },
        [most, number](const RunSetting& setting) { return number(setting) != most; });
}

Extrapolation extrapolate(double coarse, double middle, double fine)
{
    // q(h) = q + C h^p: (q(4h) - q(2h))/(q(2h) - q(h)) = 2^p, and q = q(h) + (q(h) - q(2h))/(2^p - 1).
    Extrapolation result{fine, 0, std::max(std::abs(fine - middle), std::abs(middle - coarse))};
    const double ratio = (coarse - middle) / (middle - fine);
    const double order = std::log2(ratio);
    if (order >= 0.5 && order <= 4.5)
    {
        result.order = order;
        result.value = fine + (fine - middle) / (ratio - 1);
        result.uncertainty = std::abs(result.value - fine);
    }
    return result;
}

} // namespace drystone
