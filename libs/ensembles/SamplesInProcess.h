// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Samples that are computed in this process without any file.
#pragma once

#include "ensembles/Ensemble.h"

#include <functional>
#include <memory>

namespace drystone
{

/// What a solver without an answer throws.
struct NotConverged
{
    std::string message;
};

/// Samples without files: the dictionaries of the case in memory, those with variables anew for each sample,
/// the others read once.
class SamplesInProcess
{
public:
    /// \param ensemble not owned
    explicit SamplesInProcess(const Ensemble& ensemble);
    ~SamplesInProcess();

    /// \throws NotConverged, FatalError
    std::vector<double> run(const std::vector<SampleValue>& values);

    /// As SampleRunner::runTogether.
    std::vector<std::optional<SampleOutcome>>
    runTogether(const std::vector<std::vector<SampleValue>>& samples,
                const std::function<void(std::size_t)>& begins);

    /// Looks up what the results are figures of, as far as they are of a motion, and computes nothing.
    /// \throws FatalIOError for a block that is not there or never moves, FatalError where the case of these
    /// values cannot be read
    void requireFigures(const std::vector<SampleValue>& values);

    /// Whether lanes take the case with the entries that are set. \throws FatalError
    bool isForLanes();

private:
    struct Cases;
    std::unique_ptr<Cases> cases;
};

/// Of results that are computed.
SampleOutcome outcomeOf(std::vector<double> results);

} // namespace drystone
