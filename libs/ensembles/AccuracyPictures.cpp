// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Solid medians and dashed worst runs on logarithmic axes; profiles of solvers are drawn as steps.
#include "ensembles/AccuracyPictures.h"

#include "ensembles/AccuracyWords.h"
#include "io/Plot.h"
#include "io/PlotKey.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace drystone
{
namespace
{

/// Errors of zero are drawn here, because the axis is logarithmic.
constexpr double leastDrawn = 1e-16;

/// Pictures with more curves than this show medians only.
constexpr std::size_t mostCurvesWithWorst = 8;

/// With fewer settings than this, however many their phases, solvers cannot be compared.
constexpr std::size_t leastSettings = 4;

/// Over CPU time along deltaT and points a joint; over the tolerance, with the knee, along that.
Plot errorPlot(const AccuracyStudy& study, const AccuracyResults& results, const SweepResult& sweep)
{
    const StudyQuantity& quantity = quantityOf(study, sweep);
    const double uncertainty = uncertaintyOf(results, sweep);
    double leastError = HUGE_VAL;
    const bool isMotion = quantity.kind == QuantityKind::motion;
    const bool overTolerance = sweep.axis == SweepAxis::tolerance;
    const auto curves = curvesOf(sweep);
    Plot plot;
    plot.title = fmt::format("{}: error of {}", sweep.name, quantity.name);
    const bool isCrowded = curves.size() > mostCurvesWithWorst;
    plot.subtitle = fmt::format(
        "points: {}{}; {}", axisName(sweep.axis),
        !isMotion   ? ""
        : isCrowded ? fmt::format("; median of {} phases", planOf(study, sweep).phases)
                    : fmt::format("; solid: median, dashed: worst of {} phases", planOf(study, sweep).phases),
        processorName());
    plot.x = {overTolerance ? "tolerance of the solver" : "CPU time [s]", AxisScale::logarithmic, {}, {}};
    plot.y = {"relative error", AxisScale::logarithmic, {}, {}};
    const ShownKeys shown = differingKeys(settingsAt(sweep.points), sweep.axis);
    plot.width = isCrowded ? 1000 : plot.width;
    std::vector<PlotCurve> worst;
    for (std::size_t index = 0; index < curves.size(); ++index)
    {
        const std::string name = textOf(curves[index].front().setting, shown);
        PlotCurve medians{
            name.empty() ? quantity.name : name, {}, {}, CurveLine::solid, CurveMarker::automatic, {}};
        PlotCurve worsts{"", {}, {}, CurveLine::dashed, CurveMarker::none, curveColour(index)};
        for (const AccuracyPoint& point : curves[index])
        {
            if (point.isWhole())
            {
                const double x = overTolerance ? point.setting.tolerance : point.cpuTime;
                medians.x.push_back(x);
                medians.y.push_back(std::max(point.medianError, leastDrawn));
                leastError = std::min(leastError, point.medianError);
                worsts.x.push_back(x);
                worsts.y.push_back(std::max(point.worstError, leastDrawn));
            }
        }
        if (const auto knee = kneeOf(curves[index], uncertainty); overTolerance && knee && curves.size() <= 3)
        {
            const double tolerance = curves[index][*knee].setting.tolerance;
            plot.references.push_back(
                {fmt::format("knee {:g}{}{}", tolerance, name.empty() ? "" : ": ", name),
                 ReferenceDirection::vertical, tolerance});
        }
        plot.curves.push_back(std::move(medians));
        worst.push_back(std::move(worsts));
    }
    if (isCrowded)
    {
        std::vector<std::vector<std::string>> words;
        for (const auto& curve : curves)
        {
            words.push_back(wordsOf(curve.front().setting, shown));
        }
        if (lookBySettings(plot.curves, words))
        {
            plot.height = 560;
        }
    }
    const auto named = std::count_if(plot.curves.begin(), plot.curves.end(),
                                     [](const PlotCurve& curve) { return !curve.name.empty(); });
    plot.height = std::max(plot.height, 110 + 20.0 * static_cast<double>(named)); // of the legend
    if (uncertainty > 0.3 * leastError)
    {
        plot.references.push_back(
            {"uncertainty of the reference", ReferenceDirection::horizontal, uncertainty});
    }
    if (isMotion && !isCrowded)
    {
        for (PlotCurve& curve : worst)
        {
            plot.curves.push_back(std::move(curve));
        }
    }
    return plot;
}

Plot profilePlot(const SweepResult& sweep, double tolerance)
{
    const std::vector<SolverProfile> profiles = solverProfiles(sweep.points, tolerance);
    double most = 2;
    for (const SolverProfile& profile : profiles)
    {
        most = profile.ratios.empty() ? most : std::max(most, 1.3 * profile.ratios.back());
    }
    Plot plot;
    plot.title = fmt::format("{}: solvers at tolerance {:g}", sweep.name, tolerance);
    plot.subtitle = fmt::format("{} problems; {}", profiles.front().problems, processorName());
    plot.x = {"CPU time over that of the fastest solver", AxisScale::logarithmic, 1.0, most};
    plot.y = {"part of the problems solved", AxisScale::linear, 0.0, 1.05};
    for (const SolverProfile& profile : profiles)
    {
        PlotCurve curve{wordOf(profile.solver), {1.0}, {profile.at(1)}, CurveLine::solid,
                        CurveMarker::none,      {}};
        for (const double ratio : profile.ratios)
        {
            if (ratio > 1)
            {
                curve.x.insert(curve.x.end(), {ratio, ratio});
                curve.y.insert(curve.y.end(), {curve.y.back(), profile.at(ratio)});
            }
        }
        curve.x.push_back(most);
        curve.y.push_back(curve.y.back());
        plot.curves.push_back(std::move(curve));
    }
    return plot;
}

} // namespace

std::vector<double> profileTolerances(const SweepResult& sweep)
{
    std::map<double, std::set<RunSetting>, std::greater<>> settings;
    for (const AccuracyPoint& point : sweep.points)
    {
        RunSetting problem = point.setting;
        problem.solver = SolverType::automatic;
        settings[point.setting.tolerance].insert(problem);
    }
    std::vector<double> found;
    for (const auto& [tolerance, problems] : settings)
    {
        const std::vector<SolverProfile> profiles = solverProfiles(sweep.points, tolerance);
        if (problems.size() >= leastSettings && !profiles.empty() && profiles.front().problems > 0)
        {
            found.push_back(tolerance);
        }
    }
    return found;
}

std::string_view pictureEnding(const AccuracyStudy& study)
{
    const PictureFormat shown = readPictureFormats(study.caseDirectory).front();
    const auto formats = namesOf(shown);
    return std::find_if(formats.begin(), formats.end(),
                        [&](const auto& format) { return format.second == shown; })
        ->first;
}

std::string profileName(const SweepResult& sweep, double tolerance)
{
    return fmt::format("{}Solvers{:g}", sweep.name, tolerance);
}

void writePictures(const std::filesystem::path& folder, const AccuracyStudy& study,
                   const AccuracyResults& results)
{
    const PictureFormats formats = readPictureFormats(study.caseDirectory);
    for (const SweepResult& sweep : results.sweeps)
    {
        writePlot(folder / sweep.name, errorPlot(study, results, sweep), formats);
        for (const double tolerance : profileTolerances(sweep))
        {
            writePlot(folder / profileName(sweep, tolerance), profilePlot(sweep, tolerance), formats);
        }
    }
}

} // namespace drystone
