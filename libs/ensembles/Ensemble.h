// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// An ensemble in a case directory, read and checked: the same in all processes that compute its samples.
#pragma once

#include "ensembles/CaseRuns.h"
#include "ensembles/CopyMessages.h"
#include "ensembles/EnsembleSettings.h"
#include "ensembles/Sampler.h"
#include "ensembles/StudyInput.h"
#include "runControl/PictureFormats.h"

#include <algorithm>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>

namespace drystone
{

/// How a sample came out; the numbers stand in the tables.
enum class SampleStatus
{
    done = 0,         ///< all results are there
    notFinite = 1,    ///< it was computed, and a result is no finite number: the structure does not stand
    failed = 2,       ///< an application ended with an error
    notConverged = 3, ///< a solver did not reach its tolerance
    crashed = 4,      ///< a signal ended it
    timeExceeded = 5, ///< it took longer than maximumTime
    outOfMemory = 6
};
inline constexpr int sampleStatuses = 7;
std::string_view textOf(SampleStatus status);
/// Whether there are no results that count.
inline bool isFailure(SampleStatus status)
{
    return status != SampleStatus::done && status != SampleStatus::notFinite;
}

struct Ensemble
{
    std::filesystem::path caseDirectory;
    EnsembleSettings settings;
    Dictionary dictionary; ///< system/ensembleDict, for the location in messages
    std::shared_ptr<const Sampler> sampler;
    bool isInProcess = false; ///< no copies of the case are made
    /// Samples are limit analyses of the same blocks in the plane, with friction alone, and no result depends
    /// on which of several solutions of one is found: they are computed together (statics/LaneAnalyses.h).
    bool areAlike = false;
    std::vector<std::string> options; ///< for the applications
    std::string plan;                 ///< all that the samples depend on, as text
    PictureFormats pictureFormats{PictureFormat::svg};

    long samples() const { return sampler->size(); }

    /// Samples that a worker takes at a time are so many or a multiple: as many as the widest register has
    /// numbers, but not so many that there is no work for all workers.
    long wholeChunk() const { return areAlike ? std::clamp(samples() / 16, 1L, 8L) : 1; }
};

/// Reads system/ensembleDict and looks up the entries that it names.
/// \param options for the applications, -noFunctionObjects
/// \throws FatalIOError for faults in it
Ensemble readEnsemble(const std::filesystem::path& caseDirectory, const std::vector<std::string>& options);

/// What the samples follow from.
StudyRuns runsOf(const Ensemble& ensemble);

/// postProcessing/ensemble/0/ of a case, and the folder in it that processes share.
std::filesystem::path ensembleFolder(const std::filesystem::path& caseDirectory);
std::filesystem::path ensembleWork(const std::filesystem::path& caseDirectory);

/// Before the first sample: applications, variables, design, results.
void printEnsemble(const Ensemble& ensemble);

/// Entries of the case as a sample has them.
std::vector<OtherEntry> entriesOf(const Ensemble& ensemble, const std::vector<SampleValue>& values);

/// Checks whether the applications can read the case, with the values of the first sample, or else of one
/// in the middle or the last. \throws FatalError with the message of the application
void requireReadableCase(const Ensemble& ensemble);

/// What came of one sample.
struct SampleOutcome
{
    SampleStatus status = SampleStatus::failed;
    std::vector<double> results; ///< nan where there is none
    std::string message;         ///< why it failed
    bool isFromOutside = false;  ///< somebody has ended an application: no fault of the sample
};

class SamplesInProcess;

/// Computes samples, one after the other.
class SampleRunner
{
public:
    /// \param scratch folder for copies of the case, where the ensemble makes any
    SampleRunner(const Ensemble& ensemble, std::filesystem::path scratch);
    ~SampleRunner();

    /// The results of a sample with these values. Faults of the sample are in its outcome; nothing is thrown
    /// but std::bad_alloc.
    SampleOutcome run(const std::vector<SampleValue>& values);

    /// How many samples are best computed together: 1 where nothing is gained by it.
    int together() const;

    /// The results of several samples, each the same to the last bit as `run` has it; nothing for samples
    /// with a fault, or where nothing is gained by it: these are for `run`. \param begins is called with the
    /// index of a sample that may take long \throws std::exception for a fault of the case
    std::vector<std::optional<SampleOutcome>>
    runTogether(const std::vector<std::vector<SampleValue>>& samples,
                const std::function<void(std::size_t)>& begins);

private:
    SampleOutcome runByApplications(const std::vector<SampleValue>& values);

    const Ensemble& ensemble;
    std::filesystem::path scratch;
    std::unique_ptr<SamplesInProcess> inProcess;
    WarningsOfCopies warnings;     ///< of applications
    bool isTogetherWorthIt = true; ///< something was gained by it with the last samples
};

} // namespace drystone
