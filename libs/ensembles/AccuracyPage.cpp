// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Words and draws the results of accuracyCost.
#include "ensembles/AccuracyPage.h"

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

/// Tables of pairs longer than this are truncated: the rest is in accuracyCost.csv.
constexpr std::size_t mostPairs = 24;

template<class Enumeration>
std::string wordOf(Enumeration value)
{
    for (const auto& [name, named] : namesOf(value))
    {
        if (named == value)
        {
            return std::string(name);
        }
    }
    return {};
}

/// The keys of a setting that are shown. The others are the same for all points, or have no meaning.
using ShownKeys = RunSettingsOf<FlagOf>;

/// The words of a setting, one for each key that is shown.
std::vector<std::string> wordsOf(const RunSetting& setting, const ShownKeys& shown)
{
    std::vector<std::string> parts;
    if (shown.deltaT)
    {
        parts.push_back(fmt::format("deltaT {:g}", setting.deltaT));
    }
    if (shown.theta)
    {
        parts.push_back(fmt::format("theta {:g}", setting.theta));
    }
    if (shown.flowRule)
    {
        parts.push_back(wordOf(setting.flowRule));
    }
    if (shown.solver)
    {
        parts.push_back(wordOf(setting.solver));
    }
    if (shown.tolerance)
    {
        parts.push_back(fmt::format("tolerance {:g}", setting.tolerance));
    }
    if (shown.pointsPerJoint)
    {
        parts.push_back(fmt::format("{} points a joint", setting.pointsPerJoint));
    }
    if (shown.pointsPerSide)
    {
        parts.push_back(fmt::format("{} points a side", setting.pointsPerSide));
    }
    if (shown.displacements)
    {
        parts.push_back(wordOf(setting.displacements) + " displacements");
    }
    if (shown.formulation)
    {
        parts.push_back(setting.formulation == ContactFormulation::points ? "by points" : "by surfaces");
    }
    return parts;
}

std::string textOf(const RunSetting& setting, const ShownKeys& shown)
{
    return fmt::format("{}", fmt::join(wordsOf(setting, shown), ", "));
}

ShownKeys keysOf(const RunSetting& setting, QuantityKind kind)
{
    const bool isMotion = kind == QuantityKind::motion;
    ShownKeys shown;
    shown.deltaT = isMotion;
    shown.theta = isMotion;
    shown.flowRule = true;
    shown.solver = isMotion;
    shown.tolerance = true;
    shown.pointsPerJoint = setting.pointsPerJoint > 0;
    shown.pointsPerSide = setting.pointsPerSide > 0;
    shown.displacements = isMotion;
    shown.formulation = setting.formulation == ContactFormulation::surface;
    return shown;
}

/// What varies along a curve is not shown.
ShownKeys withoutAxis(ShownKeys shown, std::optional<SweepAxis> axis)
{
    shown.deltaT = shown.deltaT && axis != SweepAxis::deltaT;
    shown.tolerance = shown.tolerance && axis != SweepAxis::tolerance;
    shown.pointsPerJoint = shown.pointsPerJoint && axis != SweepAxis::pointsPerJoint;
    shown.pointsPerSide = shown.pointsPerSide && axis != SweepAxis::pointsPerSide;
    return shown;
}

/// Those that differ between some settings, without the axis.
ShownKeys differingKeys(const std::vector<RunSetting>& settings, std::optional<SweepAxis> axis)
{
    ShownKeys shown;
    for (const RunSetting& other : settings)
    {
        forEachKey([](bool& isShown, const auto& value, const auto& first)
                   { isShown = isShown || value != first; },
                   shown, other, settings.front());
    }
    return withoutAxis(shown, axis);
}

std::vector<RunSetting> settingsAt(const std::vector<AccuracyPoint>& points)
{
    std::vector<RunSetting> settings;
    for (const AccuracyPoint& point : points)
    {
        settings.push_back(point.setting);
    }
    return settings;
}

std::string errorText(double error)
{
    return std::isfinite(error) ? fmt::format("{:.2g}%", 100 * error) : "failed";
}

/// `2 of 20 failed`, `the first 3 of 20, no more were tried`
std::string failedText(const AccuracyPoint& point)
{
    return point.runs < point.planned
               ? fmt::format("the first {} of {}: no more were tried", point.runs, point.planned)
               : fmt::format("{} of {} failed", point.failed, point.runs);
}

const StudyQuantity& quantityOf(const AccuracyStudy& study, const SweepResult& sweep)
{
    return study.quantities[sweep.quantity];
}

const Sweep& planOf(const AccuracyStudy& study, const SweepResult& sweep)
{
    return std::find_if(study.sweeps.begin(), study.sweeps.end(),
                        [&](const auto& plan) { return plan.first == sweep.name; })
        ->second;
}

std::string axisName(SweepAxis axis)
{
    return axis == SweepAxis::pointsPerJoint  ? "points a joint"
           : axis == SweepAxis::pointsPerSide ? "points a side"
           : axis == SweepAxis::deltaT        ? "deltaT [s]"
                                              : "tolerance";
}

/// The tolerances with more than one solver and enough settings.
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

std::string profileName(const SweepResult& sweep, double tolerance)
{
    return fmt::format("{}Solvers{:g}.svg", sweep.name, tolerance);
}

/// Of the reference of a sweep, relative.
double uncertaintyOf(const AccuracyResults& results, const SweepResult& sweep)
{
    const Reference& reference = results.references[sweep.quantity];
    return reference.uncertainty / std::abs(reference.value);
}

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

// The page, section by section

std::string sweepSection(const AccuracyStudy& study, const AccuracyResults& results, const SweepResult& sweep)
{
    const StudyQuantity& quantity = quantityOf(study, sweep);
    const bool isMotion = quantity.kind == QuantityKind::motion;
    const double unit = results.unitsOfWork[sweep.quantity];
    const ShownKeys shown = differingKeys(settingsAt(sweep.points), sweep.axis);
    ShownKeys common = keysOf(sweep.points.front().setting, quantity.kind);
    forEachKey([](bool& isCommon, bool isShown) { isCommon = isCommon && !isShown; }, common, shown);
    common = withoutAxis(common, sweep.axis);
    const std::string always = textOf(sweep.points.front().setting, common);
    const Sweep& plan = planOf(study, sweep);
    const bool sharesPhases =
        isMotion
        && std::any_of(sweep.points.begin(), sweep.points.end(),
                       [&](const AccuracyPoint& point) { return point.planned > plan.phases; });
    std::string text = fmt::format("## Sweep `{}`: {}\n\n", sweep.name, quantity.quantity.summary);
    text += always.empty() ? "" : fmt::format("All of them: {}. ", always);
    text += isMotion
                ? fmt::format("Each row: {} runs, whose first steps differ so that impacts occur at as many "
                              "phases of a step; CPU times are medians over them.{}\n\n",
                              plan.phases,
                              sharesPhases ? " Settings that another sweep has with more runs are shown with "
                                             "those, as the row says."
                                           : "")
                : fmt::format("CPU times are medians of {} repeats.\n\n", plan.repeats);
    text += fmt::format("![error]({}.svg)\n\n", sweep.name);
    text += fmt::format(
        "| setting | {} | {} | CPU [s] | {} | CPU/({} F) |{}\n|---|---:|{}---:|---:|---:|{}\n",
        axisName(sweep.axis), isMotion ? "median error | worst error" : "error",
        isMotion ? "steps" : "iterations", isMotion ? "step" : "iteration", isMotion ? " hover [m] |" : "",
        isMotion ? "---:|---:|" : "---:|", isMotion ? "---:|" : "");
    for (const auto& curve : curvesOf(sweep))
    {
        const std::string name = textOf(curve.front().setting, shown);
        for (const AccuracyPoint& point : curve)
        {
            const std::string failed = point.isWhole() ? "" : " (" + failedText(point) + ")";
            const std::string phases =
                isMotion && point.planned > plan.phases ? fmt::format(" ({} runs)", point.planned) : "";
            text += fmt::format("| {}{} | {:g} | {}{}{} | {:.3g} | {:.4g} | {:.3g} |{}\n",
                                name.empty() ? "all" : name, phases, alongAxis(point.setting, sweep.axis),
                                errorText(point.medianError), failed,
                                isMotion ? " | " + errorText(point.worstError) : "", point.cpuTime,
                                point.steps, point.steps > 0 ? point.cpuTime / point.steps / unit : 0,
                                isMotion ? fmt::format(" {:.2g} |", point.hover) : "");
        }
    }
    if (sweep.axis == SweepAxis::tolerance)
    {
        text += "\nThe knee is the largest tolerance from which on no error is above twice that of the "
                "smallest, or above the uncertainty of the reference: a smaller one costs time without "
                "gain.\n\n";
        for (const auto& curve : curvesOf(sweep))
        {
            const std::string name = textOf(curve.front().setting, shown);
            const auto knee = kneeOf(curve, uncertaintyOf(results, sweep));
            text += fmt::format("- {}: {}\n", name.empty() ? quantity.name : name,
                                knee ? fmt::format("knee at {:g}, error {}, {:.3g} s",
                                                   curve[*knee].setting.tolerance,
                                                   errorText(curve[*knee].medianError), curve[*knee].cpuTime)
                                     : "no knee: the error falls to the tightest tolerance");
        }
    }
    return text + "\n";
}

std::string profileSection(const SweepResult& sweep)
{
    std::string text;
    for (const double tolerance : profileTolerances(sweep))
    {
        const std::vector<SolverProfile> profiles = solverProfiles(sweep.points, tolerance);
        text += fmt::format(
            "### Solvers at tolerance {:g} (sweep `{}`)\n\n"
            "Profiles of Dolan and Moré (2002) over {} problems: each phase of each setting of the sweep, "
            "without the solver.\n\n![profiles]({})\n\n"
            "| solver | solved | fastest | within 2 times the fastest | within 10 times |\n"
            "|---|---:|---:|---:|---:|\n",
            tolerance, sweep.name, profiles.front().problems, profileName(sweep, tolerance));
        for (const SolverProfile& profile : profiles)
        {
            text += fmt::format("| {} | {:.0f}% | {:.0f}% | {:.0f}% | {:.0f}% |\n", wordOf(profile.solver),
                                100 * profile.at(HUGE_VAL), 100 * profile.at(1), 100 * profile.at(2),
                                100 * profile.at(10));
        }
        text += "\n";
    }
    return text;
}

/// A table of pairs; empty when there are none.
std::string pairSection(const AccuracyStudy& study, const SweepResult& sweep, const std::string& title,
                        const std::string& first, const std::string& second,
                        const std::vector<PointPair>& pairs)
{
    if (pairs.empty())
    {
        return "";
    }
    const StudyQuantity& quantity = quantityOf(study, sweep);
    const bool isMotion = quantity.kind == QuantityKind::motion;
    std::vector<RunSetting> firsts;
    for (const PointPair& pair : pairs)
    {
        firsts.push_back(pair.first->setting);
    }
    const std::string unit = quantity.quantity.unit;
    std::string text =
        fmt::format("### {} (sweep `{}`)\n\n| setting | {} [{}] | {} [{}] | difference |{} CPU [s] | "
                    "CPU [s] | CPU ratio |\n|---|---:|---:|---:|{}---:|---:|---:|\n",
                    title, sweep.name, first, unit, second, unit, isMotion ? " hover [m] | hover [m] |" : "",
                    isMotion ? "---:|---:|" : "");
    for (std::size_t index = 0; index < std::min(pairs.size(), mostPairs); ++index)
    {
        const AccuracyPoint& a = *pairs[index].first;
        const AccuracyPoint& b = *pairs[index].second;
        const std::string name = settingText(a.setting, firsts);
        text += fmt::format("| {} | {:.7g} | {:.7g} | {} |{} {:.3g} | {:.3g} | {:.2f} |\n", name, a.value,
                            b.value, errorText(b.value / a.value - 1),
                            isMotion ? fmt::format(" {:.2g} | {:.2g} |", a.hover, b.hover) : "", a.cpuTime,
                            b.cpuTime, b.cpuTime / a.cpuTime);
    }
    if (pairs.size() > mostPairs)
    {
        text += fmt::format("\n{} more are in accuracyCost.csv.\n", pairs.size() - mostPairs);
    }
    return text + "\n";
}

} // namespace

std::string settingText(const RunSetting& setting, QuantityKind kind)
{
    return textOf(setting, keysOf(setting, kind));
}

std::string settingText(const RunSetting& setting, const std::vector<RunSetting>& among)
{
    const std::string text = textOf(setting, differingKeys(among, {}));
    return text.empty() ? "all" : text;
}

std::string percentText(double level)
{
    return fmt::format("{:g}%", 100 * level);
}

std::vector<CheapestRow> cheapestRows(const AccuracyStudy& study, const AccuracyResults& results)
{
    std::vector<CheapestRow> rows;
    for (std::size_t quantity = 0; quantity < study.quantities.size(); ++quantity)
    {
        std::vector<AccuracyPoint> points;
        for (const SweepResult& sweep : results.sweeps)
        {
            if (sweep.quantity == quantity)
            {
                points.insert(points.end(), sweep.points.begin(), sweep.points.end());
            }
        }
        if (points.empty())
        {
            continue;
        }
        if (study.quantities[quantity].kind == QuantityKind::motion)
        {
            // Settings with few phases are not compared with settings with many.
            int most = 0;
            for (const AccuracyPoint& point : points)
            {
                most = std::max(most, point.runs);
            }
            std::erase_if(points, [most](const AccuracyPoint& point) { return point.runs < most; });
        }
        for (const double level : {0.05, 0.01, 0.001})
        {
            for (const ErrorMeasure measure : {ErrorMeasure::median, ErrorMeasure::worst})
            {
                if (measure == ErrorMeasure::median
                    && study.quantities[quantity].kind != QuantityKind::motion)
                {
                    continue; // there are no phases
                }
                const AccuracyPoint* point = cheapest(points, level, measure);
                rows.push_back({quantity, level, measure, point ? std::optional(*point) : std::nullopt});
            }
        }
    }
    return rows;
}

std::string accuracyTable(const AccuracyStudy& study, const AccuracyResults& results)
{
    std::string text = "sweep,quantity,deltaT[s],theta,flowRule,solver,tolerance,pointsPerJoint,"
                       "pointsPerSide,displacements,formulation,runs,"
                       "failed,value,medianError,worstError,hover[m],steps,cpuTime[s],F[s],residual\n";
    for (const SweepResult& sweep : results.sweeps)
    {
        for (const AccuracyPoint& point : sweep.points)
        {
            const RunSetting& setting = point.setting;
            text += fmt::format(
                "{},{},{},{},{},{},{},{},{},{},{},{},{},{:.12g},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g},"
                "{:.6g}\n",
                sweep.name, quantityOf(study, sweep).name, setting.deltaT, setting.theta,
                wordOf(setting.flowRule), wordOf(setting.solver), setting.tolerance, setting.pointsPerJoint,
                setting.pointsPerSide, wordOf(setting.displacements), wordOf(setting.formulation), point.runs,
                point.failed, point.value, point.medianError, point.worstError, point.hover, point.steps,
                point.cpuTime, results.unitsOfWork[sweep.quantity], point.worstResidual);
        }
    }
    return text;
}

void writePictures(const std::filesystem::path& folder, const AccuracyStudy& study,
                   const AccuracyResults& results)
{
    for (const SweepResult& sweep : results.sweeps)
    {
        writePlot(folder / (sweep.name + ".svg"), errorPlot(study, results, sweep));
        for (const double tolerance : profileTolerances(sweep))
        {
            writePlot(folder / profileName(sweep, tolerance), profilePlot(sweep, tolerance));
        }
    }
}

std::string accuracyPage(const AccuracyStudy& study, const AccuracyResults& results)
{
    std::string text =
        fmt::format("# What accuracy costs\n\nMade by accuracyCost on {}, one run at a time. Errors are "
                    "relative to the reference; CPU times are in seconds and in units of F, one "
                    "assembly, factorisation and solve of the Schur matrix of the case.\n\n",
                    processorName());
    text += "| quantity | what | reference | source | F [s] |\n|---|---|---:|---|---:|\n";
    for (std::size_t index = 0; index < study.quantities.size(); ++index)
    {
        const StudyQuantity& quantity = study.quantities[index];
        const Reference& reference = results.references[index];
        text +=
            fmt::format("| {} | {} | {:.9g} {}{} | {} | {:.2g} |\n", quantity.name, quantity.quantity.summary,
                        reference.value, quantity.quantity.unit == "-" ? "" : quantity.quantity.unit,
                        reference.uncertainty > 0 ? fmt::format(" ± {:.1g}", reference.uncertainty) : "",
                        reference.text, results.unitsOfWork[index]);
    }
    text += "\n## Cheapest settings\n\nThe setting of least CPU time, of all that were tried, whose error is "
            "not above the level: for half of the phases (median), and for all of them (worst). For "
            "motions only settings with the largest number of phases are considered.\n\n"
            "| quantity | error | of the phases | setting | its error | CPU [s] | CPU/F |\n"
            "|---|---:|---|---|---:|---:|---:|\n";
    for (const CheapestRow& row : cheapestRows(study, results))
    {
        const StudyQuantity& quantity = study.quantities[row.quantity];
        const bool isMedian = row.measure == ErrorMeasure::median;
        text += fmt::format("| {} | {} | {} | {} |\n", quantity.name, percentText(row.level),
                            quantity.kind != QuantityKind::motion ? "-"
                            : isMedian                            ? "half"
                                                                  : "all",
                            row.point ? fmt::format(
                                "{} | {} | {:.3g} | {:.3g}", settingText(row.point->setting, quantity.kind),
                                errorText(isMedian ? row.point->medianError : row.point->worstError),
                                row.point->cpuTime, row.point->cpuTime / results.unitsOfWork[row.quantity])
                                      : "none of those tried | | |");
    }
    text += "\n";
    for (const SweepResult& sweep : results.sweeps)
    {
        text += sweepSection(study, results, sweep);
        text += profileSection(sweep);
        text += pairSection(study, sweep, "Associative against Coulomb", "associative", "Coulomb",
                            flowRulePairs(sweep.points));
        text += pairSection(study, sweep, "Point against surface contact", "points", "surface",
                            formulationPairs(sweep.points));
        text += pairSection(study, sweep, "Few points a joint against many", "few", "many",
                            jointPointsPairs(sweep.points));
        text += pairSection(study, sweep, "Large against small displacements", "large", "small",
                            displacementPairs(sweep.points));
    }
    text +=
        "Hover is the largest gap, over a run, at a point that carries force at the end of a step: with the "
        "associative flow rule a joint that slides opens. All numbers: accuracyCost.csv; all runs: "
        "history.dat.\n";
    return text;
}

} // namespace drystone
