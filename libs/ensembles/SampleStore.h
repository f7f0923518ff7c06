// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The folder that the processes of an ensemble share, and nothing else: which samples are computed, and how
/// they came out.
///
/// postProcessing/ensemble/0/work/
///     plan             what the samples depend on: a folder of another plan is refused, and one without it
///                      that has samples
///     chunks.<n>.<m>   of n samples a byte for each chunk of m: 1 when all of them are in a journal. A
///                      process claims a chunk by locking its byte (fcntl): the kernel releases the lock when
///                      the process dies, however it does
///     journal.<host>.<process>.<worker>    a row a sample with its fingerprint, written at
///                      its end and synced a chunk at a time, below a line with that of the plan
///     failures         a row an attempt that failed
///     messages.*       what workers print on standard error
///
/// Correctness never depends on the locks: a sample is a function of its number, and of two rows for one
/// sample the first counts.
#pragma once

#include "core/Doubt.h"
#include "ensembles/Ensemble.h"

#include <map>
#include <optional>

namespace drystone
{

/// A sample that is computed.
struct SampleRow
{
    SampleStatus status = SampleStatus::done;
    int attempts = 1;
    double cpuTime = 0; ///< of the last attempt [s]
    std::vector<double> results;
};

/// An attempt that failed.
struct FailedAttempt
{
    long sample = 0;
    SampleStatus status = SampleStatus::failed;
    bool isFromOutside = false; ///< its process was ended by somebody else: no fault of the sample
    std::string message;
};

/// How many samples the ensemble of a folder has, whether they are computed or not; 0 where it does not say.
long samplesOrdered(const std::filesystem::path& work);

/// How the plan of a folder differs from that of now; nothing where the folder has none yet, and no samples.
struct PlanChange
{
    std::string input;     ///< files of the case that the samples were computed from
    std::string questions; ///< what system/ensembleDict wants of them: variables, design, results, ...
    bool hasInput = true;  ///< older versions do not say in this way from which input they computed
};
/// \throws FatalIOError where the plan is damaged, or gone and the samples are there
std::optional<PlanChange> planChange(const std::filesystem::path& work, const std::string& plan);

class SampleStore
{
public:
    /// Prepares the folder, or continues in one with the same plan. Several processes may at a time.
    /// \param count of samples \param whole chunks are of so many or a multiple \throws FatalError when the
    /// plan there is another one, or a file cannot be written
    SampleStore(const std::filesystem::path& caseDirectory, const std::string& plan, long count, long whole);
    ~SampleStore();
    SampleStore(const SampleStore&) = delete;
    SampleStore& operator=(const SampleStore&) = delete;

    long samples() const { return count; }
    long chunks() const { return (count + chunkSize - 1) / chunkSize; }
    /// First sample of a chunk, and the one after its last.
    std::pair<long, long> range(long chunk) const;

    /// Whether each chunk is complete, as the folder says now.
    std::vector<char> completed() const;
    enum class Claim
    {
        taken,   ///< it is ours until `release`, or until this process ends
        refused, ///< another process has it
        noLocks  ///< the file system has no locks
    };
    Claim claim(long chunk);
    void release(long chunk);
    void complete(long chunk); ///< all samples are in synced journals; releases it too
    void reopen(long chunk);   ///< not all samples are in a journal any more

    const std::filesystem::path& folder() const { return work; }

private:
    void mark(long chunk, char state);

    std::filesystem::path work;
    long count;
    long chunkSize;
    int chunkFile = -1;
};

/// The file of the samples that one worker computes.
class Journal
{
public:
    /// \throws FatalError when it cannot be written
    explicit Journal(const std::filesystem::path& file);
    ~Journal();
    Journal(const Journal&) = delete;
    Journal& operator=(const Journal&) = delete;

    void add(long sample, const SampleRow& row); ///< in memory for at most a tenth of a second
    void sync();                                 ///< onto the disk

private:
    void flush();

    std::filesystem::path file;
    int descriptor = -1;
    std::string pending;
    double lastFlush = 0;
};

/// All rows of all journals of a folder. Rows that are torn, as where a worker was killed, are left out, and
/// so are those that have been changed since, and those of another plan than the folder has. \param results
/// in a row \param doubts what has been changed, or contradicts another row, is added to them; null: not
/// looked for
std::map<long, SampleRow> readJournals(const std::filesystem::path& work, std::size_t results,
                                       std::vector<Doubt>* doubts = nullptr);
/// Of one journal; none where there is no such file.
void readJournal(const std::filesystem::path& file, std::size_t results, std::map<long, SampleRow>& rows,
                 std::vector<Doubt>* doubts = nullptr);

void addFailure(const std::filesystem::path& work, const FailedAttempt& attempt);
std::vector<FailedAttempt> readFailures(const std::filesystem::path& work);

/// Seconds of a clock that only goes forward.
double monotonicTime();

} // namespace drystone
