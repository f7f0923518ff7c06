// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The runs of a study that are known, and the file that keeps them: a study that is restarted repeats none.
#pragma once

#include "ensembles/AccuracyCostCase.h"

#include <map>

namespace drystone
{

/// One run: its quantity, setting and phase.
struct RunKey
{
    std::size_t quantity = 0;
    RunSetting setting;
    StepPhase phase;

    friend auto operator<=>(const RunKey&, const RunKey&) = default;
};

/// Everything that the rows of a history depend on: the case, the quantities without their references, the
/// machine; and the names of its columns. \param dictionary system/accuracyCostDict
std::string historyHeading(const std::filesystem::path& caseDirectory, const Dictionary& dictionary);

/// All completed runs.
class AccuracyRuns
{
public:
    /// Reads the runs of an earlier call; writes nothing yet. \throws FatalError when they belong to another
    /// study
    explicit AccuracyRuns(const AccuracyStudy& accuracyStudy);

    const Measurement* find(const RunKey& key) const;
    void add(const RunKey& key, const Measurement& run);
    std::size_t size() const { return order.size(); }
    /// Writes all runs to disk.
    void write() const;

private:
    const AccuracyStudy& study;
    std::filesystem::path file;
    std::map<RunKey, Measurement> runs;
    std::vector<RunKey> order;
};

} // namespace drystone
