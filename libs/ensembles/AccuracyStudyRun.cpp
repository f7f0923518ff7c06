// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// References first, of motions by Richardson's extrapolation, then sweeps; their log and files.
#include "ensembles/AccuracyStudyRun.h"

#include "core/Log.h"
#include "core/Signals.h"
#include "core/WholeFile.h"
#include "ensembles/AccuracyPage.h"
#include "ensembles/AccuracyPictures.h"
#include "ensembles/AccuracyWords.h"
#include "ensembles/CaseRuns.h"
#include "ensembles/RunSequence.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace drystone
{
namespace
{

namespace fs = std::filesystem;

/// The runs that a quantity is compared with, finest last; nothing when a signal has come.
/// \throws FatalIOError where one of them fails
std::optional<std::vector<AccuracyPoint>> finestRuns(const AccuracyStudy& study, std::size_t index,
                                                     RunSequence& sequence)
{
    const StudyQuantity& quantity = study.quantities[index];
    std::vector<AccuracyPoint> points;
    for (const RunPlan& runs : referencePlans(study, index))
    {
        const auto done = sequence.carryOut(runs);
        if (!done)
        {
            return {};
        }
        points.push_back(summarise(runs.setting, *done, 1, done->size()));
        if (!points.back().isWhole())
        {
            throw FatalIOError(
                fmt::format("The finest run that {} is compared with fails: {} of {} runs ({}) were not "
                            "solved, or did not have the figure before endTime.",
                            quantity.name, points.back().failed, points.back().runs,
                            settingText(runs.setting, quantity.kind)),
                quantity.reference.location, 2);
        }
    }
    return points;
}

/// \param points as finestRuns gives them
Reference ownReference(const StudyQuantity& quantity, const std::vector<AccuracyPoint>& points)
{
    const AccuracyPoint& finest = points.back();
    const std::string with = settingText(finest.setting, quantity.kind);
    if (quantity.kind != QuantityKind::motion)
    {
        return {finest.value, finest.setting.tolerance * std::abs(finest.value),
                fmt::format("the case's own finest run ({})", with)};
    }
    const Extrapolation limit = extrapolate(points[0].value, points[1].value, points[2].value);
    return {limit.value, limit.uncertainty,
            limit.order > 0
                ? fmt::format("Richardson's extrapolation of the case's own finest runs ({}, and twice "
                              "and four times this step; medians of {} phases), which converge with "
                              "order {:.2f}",
                              with, finest.runs, limit.order)
                : fmt::format("the case's own finest run ({}; median of {} phases); with twice and four "
                              "times this step it shows no order to extrapolate with",
                              with, finest.runs)};
}

/// \throws FatalIOError where no error can be relative to a reference
void checkReference(const StudyQuantity& quantity, Reference& reference)
{
    if (reference.uncertainty >= std::abs(reference.value))
    {
        reference.text += "; it is smaller than its own uncertainty, and errors relative to it say nothing";
        printWarning(
            fmt::format("The reference of {}, {:.3g}, is smaller than its own uncertainty of {:.2g}: errors "
                        "relative to it say nothing. Choose a quantity that is not zero, or a reference "
                        "of another type.",
                        quantity.name, reference.value, reference.uncertainty),
            quantity.reference.location);
    }
    if (reference.value == 0 || !std::isfinite(reference.value))
    {
        throw FatalIOError(
            fmt::format("The reference of {} is {}: there is no error relative to it. Choose a quantity "
                        "that is not zero.",
                        quantity.name, reference.value),
            quantity.reference.location);
    }
}

/// The reference of a quantity; nothing when a signal has come.
std::optional<Reference> referenceOf(const AccuracyStudy& study, std::size_t index, RunSequence& sequence)
{
    const StudyQuantity& quantity = study.quantities[index];
    Reference reference;
    switch (quantity.reference.kind)
    {
    case ReferencePlan::Kind::value:
        reference = {quantity.reference.value, 0, quantity.reference.source};
        break;
    case ReferencePlan::Kind::Housner:
        reference = {quantity.housner, 0,
                     "Housner's equation (1963) with its impacts, integrated between events by GSL's "
                     "adaptive method of Prince and Dormand of order 8 to about 1e-12"};
        break;
    case ReferencePlan::Kind::finest:
    {
        const auto points = finestRuns(study, index, sequence);
        if (!points)
        {
            return {};
        }
        reference = ownReference(quantity, *points);
        if (quantity.quantity.resolution > reference.uncertainty)
        {
            reference.uncertainty = quantity.quantity.resolution;
            reference.text += "; it is known to half the interval between the intensities that are tried";
        }
        break;
    }
    }
    checkReference(quantity, reference);
    return reference;
}

} // namespace

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

std::vector<RunSetting> settingsAt(const std::vector<AccuracyPoint>& points)
{
    std::vector<RunSetting> settings;
    for (const AccuracyPoint& point : points)
    {
        settings.push_back(point.setting);
    }
    return settings;
}

double uncertaintyOf(const AccuracyResults& results, const SweepResult& sweep)
{
    return relativeUncertainty(results.references[sweep.quantity]);
}

void printAccuracyStudy(const AccuracyStudy& study)
{
    for (const StudyQuantity& quantity : study.quantities)
    {
        info("Quantity {}: {} [{}]", quantity.name, quantity.quantity.summary, quantity.quantity.unit);
    }
    for (std::size_t index = 0; index < study.sweeps.size(); ++index)
    {
        const std::vector<RunPlan> plans = sweepPlans(study, index);
        int runs = 0;
        for (const RunPlan& plan : plans)
        {
            runs += plan.runs;
        }
        info("Sweep {}: {} over {} settings, {} runs", study.sweeps[index].first,
             study.quantities[study.quantityOfSweep[index]].name, plans.size(), runs);
    }
    printLine();
}

namespace
{

/// Why runs of a setting failed.
std::string reasonOf(const AccuracyPoint& point, QuantityKind kind)
{
    std::vector<std::string_view> reasons;
    if (point.unsolved > 0)
    {
        reasons.emplace_back("not solved to the tolerance");
    }
    if (point.failed > point.unsolved)
    {
        reasons.emplace_back(
            kind == QuantityKind::motion
                ? "the figure does not occur before endTime, or for an intensity that was tried"
                : "there is no multiplier, as where the live load is unbounded or the dead "
                  "load is not carried (limitAnalysis says which)");
    }
    return fmt::format("{}", fmt::join(reasons, ", or "));
}

/// The reference of each quantity, with the unit of work of its case. \return whether all are known, and the
/// study was not interrupted
bool findReferences(const AccuracyStudy& study, RunSequence& sequence, AccuracyResults& results)
{
    for (std::size_t index = 0; index < study.quantities.size(); ++index)
    {
        const StudyQuantity& quantity = study.quantities[index];
        const auto reference = referenceOf(study, index, sequence);
        if (!reference)
        {
            return false;
        }
        results.references.push_back(*reference);
        results.unitsOfWork.push_back(quantity.unitOfWork());
        info("Reference of {}: {:.9g}{}{}: {}", quantity.name, reference->value,
             quantity.quantity.unit == "-" ? "" : " " + quantity.quantity.unit,
             reference->uncertainty > 0 ? fmt::format(" +- {:.2g}", reference->uncertainty) : "",
             reference->text);
        info("One assembly, factorisation and solve: F = {:.3g} s", results.unitsOfWork.back());
        printLine();
    }
    return true;
}

/// The error of a point, or which of its runs have failed, for the log.
std::string errorOrFailure(const AccuracyPoint& point, QuantityKind kind)
{
    return point.isWhole()
               ? fmt::format("error {:.3g}, worst {:.3g}", point.medianError, point.worstError)
               : fmt::format("{} of {} runs FAILED{}: {}", point.failed, point.runs,
                             point.runs < point.planned ? ", no more tried" : "", reasonOf(point, kind));
}

/// The points of one sweep; nothing where the study was interrupted. \param index of the sweep
std::optional<SweepResult> carryOutSweep(const AccuracyStudy& study, std::size_t index, RunSequence& sequence,
                                         const std::vector<Reference>& references)
{
    const auto& [name, sweep] = study.sweeps[index];
    const std::size_t quantity = study.quantityOfSweep[index];
    const QuantityKind kind = study.quantities[quantity].kind;
    SweepResult result{name, quantity, axisOf(sweep, kind), {}};
    info("Sweep {}", name);
    const std::vector<RunPlan> plans = sweepPlans(study, index);
    std::vector<RunSetting> settings;
    for (const RunPlan& plan : plans)
    {
        settings.push_back(plan.setting);
    }
    for (std::size_t number = 0; number < plans.size(); ++number)
    {
        const auto done = sequence.carryOut(plans[number]);
        if (!done)
        {
            return std::nullopt;
        }
        const AccuracyPoint point = summarise(plans[number].setting, *done, references[quantity].value,
                                              static_cast<std::size_t>(plans[number].runs));
        info("    {}: {}, CPU {:.3g} s  ({} of {}, {})", settingText(point.setting, settings),
             errorOrFailure(point, kind), point.cpuTime, number + 1, plans.size(), sequence.timeLeft());
        std::fflush(stdout); // a study takes long: its log must show the progress
        result.points.push_back(point);
    }
    printLine();
    return result;
}

} // namespace

AccuracyResults carryOut(const AccuracyStudy& study, AccuracyRuns& runs)
{
    AccuracyResults results;
    RunSequence sequence(study, runs);
    results.isInterrupted = !findReferences(study, sequence, results);
    for (std::size_t index = 0; index < study.sweeps.size() && !results.isInterrupted; ++index)
    {
        const std::optional<SweepResult> sweep = carryOutSweep(study, index, sequence, results.references);
        results.isInterrupted = !sweep;
        if (sweep)
        {
            results.sweeps.push_back(*sweep);
        }
    }
    if (!results.isInterrupted)
    {
        shareMostPhases(results.sweeps);
    }
    return results;
}

void printAccuracyResults(const AccuracyStudy& study, const AccuracyResults& results)
{
    if (results.isInterrupted)
    {
        info("Stopped before the end of the study; started again, it continues from here");
        return;
    }
    for (const CheapestRow& row : cheapestRows(study, results))
    {
        const bool isMotion = study.quantities[row.quantity].kind == QuantityKind::motion;
        const std::string doubt = doubtAbout(row, results);
        info("{}: {} is reached {}by {}{}", study.quantities[row.quantity].name, percentText(row.level),
             !isMotion                             ? ""
             : row.measure == ErrorMeasure::median ? "for half of the phases "
                                                   : "for all phases ",
             row.point ? fmt::format("{} in {:.3g} s",
                                     settingText(row.point->setting, study.quantities[row.quantity].kind),
                                     row.point->cpuTime)
                       : "none of the settings",
             doubt.empty() ? "" : "; but " + doubt);
    }
}

void writeAccuracyResults(const AccuracyStudy& study, const AccuracyResults& results)
{
    if (results.isInterrupted)
    {
        return;
    }
    const fs::path folder = accuracyFolder(study.caseDirectory);
    writeWholeFile(folder / "accuracyCost.csv", accuracyTable(study, results));
    writePictures(folder, study, results);
    writeWholeFile(folder / "accuracyCost.md", accuracyPage(study, results));
    info("\nThe page: {}", (folder / "accuracyCost.md").string());
}

int exitStatus(const AccuracyResults& results)
{
    if (results.isInterrupted)
    {
        return exitStatusOfSignal(stopSignal());
    }
    bool isAnySolved = false;
    bool isAnyUnsolved = false;
    for (const SweepResult& sweep : results.sweeps)
    {
        for (const AccuracyPoint& point : sweep.points)
        {
            isAnySolved = isAnySolved || point.failed < point.runs;
            isAnyUnsolved = isAnyUnsolved || point.unsolved > 0;
        }
    }
    return isAnySolved || results.sweeps.empty() ? 0 : isAnyUnsolved ? 2 : 1;
}

} // namespace drystone
