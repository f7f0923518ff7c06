// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The runs of a study of accuracy, one after the other: which there are, and those that are not known yet.
#pragma once

#include "core/Log.h"
#include "ensembles/AccuracyCostCase.h"
#include "ensembles/AccuracyHistory.h"

#include <cstddef>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace drystone
{

/// Runs of one setting.
struct RunPlan
{
    std::size_t quantity = 0;
    RunSetting setting;
    int runs = 1;

    RunKey key(int index) const { return {quantity, setting, {index, runs}}; }
};

/// The runs of a reference: of a motion with four times, twice and once the step. \param index of the
/// quantity
std::vector<RunPlan> referencePlans(const AccuracyStudy& study, std::size_t index);

/// Those of a sweep. \param index of the sweep
std::vector<RunPlan> sweepPlans(const AccuracyStudy& study, std::size_t index);

/// Carries out runs, shows their progress, and keeps them. Neither study nor runs are owned.
class RunSequence
{
public:
    RunSequence(const AccuracyStudy& study, AccuracyRuns& knownRuns);

    /// The runs of a plan; nothing when a signal has come. Where the first of them are not solved, the others
    /// are not tried.
    std::optional<std::vector<Measurement>> carryOut(const RunPlan& plan);

    /// `12 s left`
    std::string timeLeft() const;

private:
    void count(const std::vector<RunPlan>& plans);

    const AccuracyStudy& study;
    AccuracyRuns& runs;
    std::set<RunKey> counted;
    Progress progress;
    double work = 0; ///< to be done by this call
    double done = 0;
    double spent = 0; ///< [s]
};

} // namespace drystone
