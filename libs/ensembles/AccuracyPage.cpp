// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Words the results of accuracyCost.
#include "ensembles/AccuracyPage.h"

#include "ensembles/AccuracyPictures.h"
#include "ensembles/AccuracyWords.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace drystone
{
namespace
{

/// Tables of pairs longer than this are truncated: the rest is in accuracyCost.csv.
constexpr std::size_t mostPairs = 24;

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

// The page, section by section

/// What the rows of a sweep have in common, and how they were computed.
std::string sweepHead(const AccuracyStudy& study, const SweepResult& sweep, const ShownKeys& shown)
{
    const StudyQuantity& quantity = quantityOf(study, sweep);
    const Sweep& plan = planOf(study, sweep);
    ShownKeys common = keysOf(sweep.points.front().setting, quantity.kind);
    forEachKey([](bool& isCommon, bool isShown) { isCommon = isCommon && !isShown; }, common, shown);
    common = withoutAxis(common, sweep.axis);
    const std::string always = textOf(sweep.points.front().setting, common);
    std::string text = fmt::format("## Sweep `{}`: {}\n\n", sweep.name, quantity.quantity.summary);
    text += always.empty() ? "" : fmt::format("All of them: {}. ", always);
    if (quantity.kind != QuantityKind::motion)
    {
        return text + fmt::format("CPU times are medians of {} repeats.\n\n", plan.repeats);
    }
    const bool sharesPhases =
        std::any_of(sweep.points.begin(), sweep.points.end(),
                    [&](const AccuracyPoint& point) { return point.planned > plan.phases; });
    return text
           + fmt::format("Each row: {} runs, whose first steps differ so that impacts occur at as many "
                         "phases of a step; CPU times are medians over them.{}\n\n",
                         plan.phases,
                         sharesPhases ? " Settings that another sweep has with more runs are shown with "
                                        "those, as the row says."
                                      : "");
}

/// A row for each point of each curve of a sweep.
std::string sweepTable(const AccuracyStudy& study, const AccuracyResults& results, const SweepResult& sweep,
                       const ShownKeys& shown)
{
    const bool isMotion = quantityOf(study, sweep).kind == QuantityKind::motion;
    const double unit = results.unitsOfWork[sweep.quantity];
    const Sweep& plan = planOf(study, sweep);
    std::string text = fmt::format(
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
    return text;
}

/// Which tolerance is tight enough, of each curve of a sweep over tolerances.
std::string kneesOf(const AccuracyStudy& study, const AccuracyResults& results, const SweepResult& sweep,
                    const ShownKeys& shown)
{
    std::string text =
        "\nThe knee is the largest tolerance from which on no error is above twice that of the "
        "smallest, or above the uncertainty of the reference: a smaller one costs time without "
        "gain.\n\n";
    for (const auto& curve : curvesOf(sweep))
    {
        const std::string name = textOf(curve.front().setting, shown);
        const auto knee = kneeOf(curve, uncertaintyOf(results, sweep));
        text +=
            fmt::format("- {}: {}\n", name.empty() ? quantityOf(study, sweep).name : name,
                        knee ? fmt::format("knee at {:g}, error {}, {:.3g} s", curve[*knee].setting.tolerance,
                                           errorText(curve[*knee].medianError), curve[*knee].cpuTime)
                             : "no knee: the error falls to the tightest tolerance");
    }
    return text;
}

std::string sweepSection(const AccuracyStudy& study, const AccuracyResults& results, const SweepResult& sweep)
{
    const ShownKeys shown = differingKeys(settingsAt(sweep.points), sweep.axis);
    std::string text = sweepHead(study, sweep, shown);
    text += fmt::format("![error]({}.{})\n\n", sweep.name, pictureEnding(study));
    text += sweepTable(study, results, sweep, shown);
    if (sweep.axis == SweepAxis::tolerance)
    {
        text += kneesOf(study, results, sweep, shown);
    }
    return text + "\n";
}

std::string profileSection(const AccuracyStudy& study, const SweepResult& sweep)
{
    std::string text;
    for (const double tolerance : profileTolerances(sweep))
    {
        const std::vector<SolverProfile> profiles = solverProfiles(sweep.points, tolerance);
        text += fmt::format(
            "### Solvers at tolerance {:g} (sweep `{}`)\n\n"
            "Profiles of Dolan and Moré (2002) over {} problems: each phase of each setting of the sweep, "
            "without the solver.\n\n![profiles]({}.{})\n\n"
            "| solver | solved | fastest | within 2 times the fastest | within 10 times |\n"
            "|---|---:|---:|---:|---:|\n",
            tolerance, sweep.name, profiles.front().problems, profileName(sweep, tolerance),
            pictureEnding(study));
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

std::string doubtAbout(const CheapestRow& row, const AccuracyResults& results)
{
    const double known = relativeUncertainty(results.references[row.quantity]);
    return row.point && known > row.level ? fmt::format("the reference is known to {:.2g}% only", 100 * known)
                                          : "";
}

std::string accuracyTable(const AccuracyStudy& study, const AccuracyResults& results)
{
    std::string text = "sweep,quantity,deltaT[s],theta,flowRule,solver,tolerance,pointsPerJoint,"
                       "pointsPerSide,displacements,formulation,contactOverlap,effects,runs,"
                       "failed,value,medianError,worstError,hover[m],steps,cpuTime[s],F[s],residual\n";
    for (const SweepResult& sweep : results.sweeps)
    {
        for (const AccuracyPoint& point : sweep.points)
        {
            const RunSetting& setting = point.setting;
            text += fmt::format("{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{:.12g},{:.6g},{:.6g},{:.6g},{:"
                                ".6g},{:.6g},{:.6g},{:.6g}\n",
                                sweep.name, quantityOf(study, sweep).name, setting.deltaT, setting.theta,
                                wordOf(setting.flowRule), wordOf(setting.solver), setting.tolerance,
                                setting.pointsPerJoint, setting.pointsPerSide, wordOf(setting.displacements),
                                wordOf(setting.formulation), setting.contactOverlap, wordOf(setting.effects),
                                point.runs, point.failed, point.value, point.medianError, point.worstError,
                                point.hover, point.steps, point.cpuTime, results.unitsOfWork[sweep.quantity],
                                point.worstResidual);
        }
    }
    return text;
}

namespace
{

/// The quantities of a study with their references.
std::string quantitySection(const AccuracyStudy& study, const AccuracyResults& results)
{
    std::string text = "| quantity | what | reference | source | F [s] |\n|---|---|---:|---|---:|\n";
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
    return text;
}

/// Which setting is the cheapest one for an error.
std::string cheapestSection(const AccuracyStudy& study, const AccuracyResults& results)
{
    std::string text =
        "\n## Cheapest settings\n\nThe setting of least CPU time, of all that were tried, whose error is "
        "not above the level: for half of the phases (median), and for all of them (worst). For "
        "motions only settings with the largest number of phases are considered.\n\n"
        "| quantity | error | of the phases | setting | its error | CPU [s] | CPU/F |\n"
        "|---|---:|---|---|---:|---:|---:|\n";
    for (const CheapestRow& row : cheapestRows(study, results))
    {
        const StudyQuantity& quantity = study.quantities[row.quantity];
        const bool isMedian = row.measure == ErrorMeasure::median;
        const std::string doubt = doubtAbout(row, results);
        text += fmt::format("| {} | {} | {} | {} |\n", quantity.name, percentText(row.level),
                            quantity.kind != QuantityKind::motion ? "-"
                            : isMedian                            ? "half"
                                                                  : "all",
                            row.point ? fmt::format(
                                "{} | {}{} | {:.3g} | {:.3g}", settingText(row.point->setting, quantity.kind),
                                errorText(isMedian ? row.point->medianError : row.point->worstError),
                                doubt.empty() ? "" : "; " + doubt, row.point->cpuTime,
                                row.point->cpuTime / results.unitsOfWork[row.quantity])
                                      : "none of those tried | | |");
    }
    return text + "\n";
}

/// Alternatives that differ in one setting alone, compared pair by pair.
std::string pairSections(const AccuracyStudy& study, const SweepResult& sweep)
{
    const auto& points = sweep.points;
    return pairSection(study, sweep, "Associative against Coulomb", "associative", "Coulomb",
                       flowRulePairs(points))
           + pairSection(study, sweep, "Point against surface contact", "points", "surface",
                         formulationPairs(points))
           + pairSection(study, sweep, "Few points a joint against many", "few", "many",
                         jointPointsPairs(points))
           + pairSection(study, sweep, "Large against small displacements", "large", "small",
                         displacementPairs(points))
           + pairSection(study, sweep, "Effects as given in every step against those that it calls for",
                         "as given", "automatic", effectPairs(points))
           + pairSection(study, sweep, "Chosen effects against everything on", "chosen", "everything",
                         everythingPairs(points));
}

} // namespace

std::string accuracyPage(const AccuracyStudy& study, const AccuracyResults& results)
{
    std::string text =
        fmt::format("# What accuracy costs\n\nMade by accuracyCost on {}, one run at a time. Errors are "
                    "relative to the reference; CPU times are in seconds and in units of F, one "
                    "assembly, factorisation and solve of the Schur matrix of the case.\n\n",
                    processorName());
    text += quantitySection(study, results);
    text += cheapestSection(study, results);
    for (const SweepResult& sweep : results.sweeps)
    {
        text += sweepSection(study, results, sweep);
        text += profileSection(study, sweep);
        text += pairSections(study, sweep);
    }
    text +=
        "Hover is the largest gap, over a run, at a point that carries force at the end of a step: with the "
        "associative flow rule a joint that slides opens. All numbers: accuracyCost.csv; all runs: "
        "history.dat.\n";
    return text;
}

} // namespace drystone
