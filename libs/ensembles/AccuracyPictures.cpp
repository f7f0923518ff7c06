// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Solid medians and dashed worst runs on logarithmic axes; profiles of solvers are drawn as steps.
#include "ensembles/AccuracyPictures.h"

#include "ensembles/AccuracyWords.h"
#include "io/Plot.h"
#include "io/PlotKey.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
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

/// The errors of one curve of a sweep.
struct ErrorCurve
{
    std::string name; ///< of its settings, where they differ from those of other curves; or empty
    PlotCurve medians;
    PlotCurve worsts;
    double leastError = HUGE_VAL;
};

ErrorCurve errorCurve(const std::vector<AccuracyPoint>& points, std::string name, SweepAxis axis,
                      const std::string& colour)
{
    ErrorCurve curve;
    curve.name = std::move(name);
    curve.worsts.line = CurveLine::dashed;
    curve.worsts.marker = CurveMarker::none;
    curve.worsts.colour = colour;
    for (const AccuracyPoint& point : points)
    {
        if (point.isWhole())
        {
            const double x = axis == SweepAxis::tolerance ? point.setting.tolerance : point.cpuTime;
            curve.medians.x.push_back(x);
            curve.medians.y.push_back(std::max(point.medianError, leastDrawn));
            curve.leastError = std::min(curve.leastError, point.medianError);
            curve.worsts.x.push_back(x);
            curve.worsts.y.push_back(std::max(point.worstError, leastDrawn));
        }
    }
    return curve;
}

/// Whether a picture has more curves than can be shown twice, by their medians and their worst errors.
bool isCrowded(std::size_t curves)
{
    return curves > mostCurvesWithWorst;
}

/// What the points are, and the processor that took their times.
std::string subtitleOf(const AccuracyStudy& study, const SweepResult& sweep, std::size_t curves)
{
    std::string phases;
    if (quantityOf(study, sweep).kind == QuantityKind::motion)
    {
        const int count = planOf(study, sweep).phases;
        phases = isCrowded(curves) ? fmt::format("; median of {} phases", count)
                                   : fmt::format("; solid: median, dashed: worst of {} phases", count);
    }
    return fmt::format("points: {}{}; {}", axisName(sweep.axis), phases, processorName());
}

/// Colours and markers by the words of the settings, so that many curves can be told apart.
void lookByWords(Plot& plot, const std::vector<std::vector<AccuracyPoint>>& curves, const ShownKeys& shown)
{
    constexpr double width = 1000;
    constexpr double height = 560;
    plot.width = width;
    std::vector<std::vector<std::string>> words;
    for (const auto& curve : curves)
    {
        words.push_back(wordsOf(curve.front().setting, shown));
    }
    if (lookBySettings(plot.curves, words))
    {
        plot.height = height;
    }
}

/// At least as high as the legend is.
void makeRoomForLegend(Plot& plot)
{
    constexpr double titleAndAxis = 110;
    constexpr double line = 20;
    const auto named = std::count_if(plot.curves.begin(), plot.curves.end(),
                                     [](const PlotCurve& curve) { return !curve.name.empty(); });
    plot.height = std::max(plot.height, titleAndAxis + line * static_cast<double>(named));
}

/// Marks the tolerance beyond which a smaller one costs time without gain.
void markKnee(Plot& plot, const ErrorCurve& curve, const std::vector<AccuracyPoint>& points,
              double uncertainty)
{
    if (const auto knee = kneeOf(points, uncertainty))
    {
        const double tolerance = points[*knee].setting.tolerance;
        plot.references.push_back(
            {fmt::format("knee {:g}{}{}", tolerance, curve.name.empty() ? "" : ": ", curve.name),
             ReferenceDirection::vertical, tolerance});
    }
}

/// Over CPU time along deltaT and points a joint; over the tolerance, with the knee, along that.
Plot errorPlot(const AccuracyStudy& study, const AccuracyResults& results, const SweepResult& sweep)
{
    constexpr std::size_t mostKnees = 3;
    constexpr double worthShowing = 0.3; // an uncertainty, of the least error
    const StudyQuantity& quantity = quantityOf(study, sweep);
    const double uncertainty = uncertaintyOf(results, sweep);
    const bool overTolerance = sweep.axis == SweepAxis::tolerance;
    const auto curves = curvesOf(sweep);
    const ShownKeys shown = differingKeys(settingsAt(sweep.points), sweep.axis);
    Plot plot;
    plot.title = fmt::format("{}: error of {}", sweep.name, quantity.name);
    plot.subtitle = subtitleOf(study, sweep, curves.size());
    plot.x = {overTolerance ? "tolerance of the solver" : "CPU time [s]", AxisScale::logarithmic, {}, {}};
    plot.y = {"relative error", AxisScale::logarithmic, {}, {}};
    double leastError = HUGE_VAL;
    std::vector<PlotCurve> worsts;
    for (std::size_t index = 0; index < curves.size(); ++index)
    {
        ErrorCurve curve = errorCurve(curves[index], textOf(curves[index].front().setting, shown), sweep.axis,
                                      curveColour(index));
        curve.medians.name = curve.name.empty() ? quantity.name : curve.name;
        leastError = std::min(leastError, curve.leastError);
        if (overTolerance && curves.size() <= mostKnees)
        {
            markKnee(plot, curve, curves[index], uncertainty);
        }
        plot.curves.push_back(std::move(curve.medians));
        worsts.push_back(std::move(curve.worsts));
    }
    if (isCrowded(curves.size()))
    {
        lookByWords(plot, curves, shown);
    }
    makeRoomForLegend(plot);
    if (uncertainty > worthShowing * leastError)
    {
        plot.references.push_back(
            {"uncertainty of the reference", ReferenceDirection::horizontal, uncertainty});
    }
    if (quantity.kind == QuantityKind::motion && !isCrowded(curves.size()))
    {
        std::move(worsts.begin(), worsts.end(), std::back_inserter(plot.curves));
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
