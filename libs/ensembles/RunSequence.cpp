// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Runs in the order of a study, skipping known ones; settings whose first runs fail are given up.
#include "ensembles/RunSequence.h"

#include "core/Signals.h"

#include <algorithm>

namespace drystone
{
namespace
{

/// When the first runs of a setting are not solved, this many of them, the others are not tried: a solver
/// that fails takes a long time to do so.
constexpr int runsUntilGivenUp = 3;

RunPlan planOf(const AccuracyStudy& study, std::size_t quantity, const RunSetting& setting, int phases,
               int repeats)
{
    return {quantity, setting, study.quantities[quantity].kind == QuantityKind::motion ? phases : repeats};
}

/// Approximate work of a plan, in steps of a motion; limit analyses count as some tens.
double workOf(const AccuracyStudy& study, const RunPlan& plan)
{
    return plan.runs * (plan.setting.deltaT > 0 ? study.duration / plan.setting.deltaT : 30);
}

bool isUnsolved(const std::vector<Measurement>& made)
{
    return std::all_of(made.begin(), made.end(),
                       [](const Measurement& run) { return run.end == RunEnd::unsolved; });
}

} // namespace

std::vector<RunPlan> referencePlans(const AccuracyStudy& study, std::size_t index)
{
    const StudyQuantity& quantity = study.quantities[index];
    std::vector<RunPlan> plans;
    if (quantity.reference.kind == ReferencePlan::Kind::finest)
    {
        const RunSetting finest = finestSetting(quantity.reference, quantity.ofCase);
        for (const double factor : {4.0, 2.0, 1.0})
        {
            RunSetting setting = finest;
            setting.deltaT *= factor;
            if (quantity.kind == QuantityKind::motion || factor == 1)
            {
                plans.push_back(planOf(study, index, setting, quantity.reference.phases, 1));
            }
        }
    }
    return plans;
}

std::vector<RunPlan> sweepPlans(const AccuracyStudy& study, std::size_t index)
{
    const Sweep& sweep = study.sweeps[index].second;
    const std::size_t quantity = study.quantityOfSweep[index];
    std::vector<RunPlan> plans;
    for (const RunSetting& setting : settingsOf(sweep, study.quantities[quantity].ofCase))
    {
        plans.push_back(planOf(study, quantity, setting, sweep.phases, sweep.repeats));
    }
    return plans;
}

RunSequence::RunSequence(const AccuracyStudy& accuracyStudy, AccuracyRuns& knownRuns)
    : study(accuracyStudy), runs(knownRuns)
{
    for (std::size_t quantity = 0; quantity < study.quantities.size(); ++quantity)
    {
        count(referencePlans(study, quantity));
    }
    for (std::size_t sweep = 0; sweep < study.sweeps.size(); ++sweep)
    {
        count(sweepPlans(study, sweep));
    }
}

std::optional<std::vector<Measurement>> RunSequence::carryOut(const RunPlan& plan)
{
    std::vector<Measurement> made;
    bool isNew = false;
    for (int index = 0; index < plan.runs; ++index)
    {
        if (index == runsUntilGivenUp && isUnsolved(made))
        {
            done += isNew ? workOf(study, plan) * (plan.runs - index) / plan.runs : 0;
            break;
        }
        const RunKey key = plan.key(index);
        const Measurement* known = runs.find(key);
        if (known)
        {
            made.push_back(*known);
            continue;
        }
        if (stopSignal() != 0)
        {
            runs.write();
            return {};
        }
        const StudyQuantity& quantity = study.quantities[plan.quantity];
        const double start = clockTime();
        const Measurement run = quantity.quantity.measure(plan.setting, key.phase);
        if (run.end == RunEnd::interrupted)
        {
            runs.write();
            return {};
        }
        isNew = true;
        runs.add(key, run);
        made.push_back(run);
        done += workOf(study, plan) / plan.runs;
        spent += clockTime() - start;
        progress.update(work > 0 ? done / work : 1, quantity.name);
    }
    if (isNew)
    {
        runs.write();
    }
    return made;
}

std::string RunSequence::timeLeft() const
{
    return done > 0 ? durationText(spent * std::max(work - done, 0.0) / done) + " left" : "known";
}

/// Counts what is to be done, once.
void RunSequence::count(const std::vector<RunPlan>& plans)
{
    for (const RunPlan& plan : plans)
    {
        for (int index = 0; index < plan.runs; ++index)
        {
            if (!runs.find(plan.key(index)) && counted.insert(plan.key(index)).second)
            {
                work += workOf(study, plan) / plan.runs;
            }
        }
    }
}

} // namespace drystone
