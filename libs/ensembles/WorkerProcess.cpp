// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Computes samples together first, then alone what did not come out; notes whether a signal was sent.
#include "ensembles/WorkerProcess.h"

#include "core/Signals.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <ctime>
#include <new>
#include <optional>
#include <string_view>

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

namespace drystone
{

namespace fs = std::filesystem;

namespace
{

/// How often a sample whose worker was killed from outside is begun again: the system may have killed it for
/// the memory it takes.
constexpr int mostOutsideKills = 5;

/// Of this process, for the handler of signals, which has nowhere else to leave its note.
Activity* ownActivity = nullptr;

/// A fault of the program has a positive code; a signal that somebody has sent has none.
extern "C" void noteFault(int signal, siginfo_t* info, void*)
{
    ownActivity->isFromOutside = info->si_code <= 0 && info->si_pid != ::getpid();
    ::signal(signal, SIG_DFL);
    ::raise(signal);
}

/// \param stack for the handler, as that of the program may be what is exhausted
void noteFaults(Activity& activity, std::vector<char>& stack)
{
    ownActivity = &activity;
    stack_t alternative = {};
    alternative.ss_sp = stack.data();
    alternative.ss_size = stack.size();
    ::sigaltstack(&alternative, nullptr);
    struct sigaction action = {};
    action.sa_sigaction = noteFault;
    action.sa_flags = SA_SIGINFO | SA_ONSTACK;
    for (const int signal : {SIGSEGV, SIGBUS, SIGFPE, SIGILL})
    {
        ::sigaction(signal, &action, nullptr);
    }
}

double cpuTimeOfAll()
{
    timespec now{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    rusage children{};
    getrusage(RUSAGE_CHILDREN, &children);
    const auto seconds = [](const timeval& time)
    { return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec); };
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec)
           + seconds(children.ru_utime) + seconds(children.ru_stime);
}

/// The failed attempts of the samples of a chunk.
struct Attempts
{
    std::map<long, int> own;     ///< by fault of the sample
    std::map<long, int> outside; ///< its process was killed by somebody
    std::map<long, SampleStatus> lastStatus;
};

Attempts attemptsOf(const fs::path& work, std::pair<long, long> range)
{
    Attempts attempts;
    for (const FailedAttempt& failed : readFailures(work))
    {
        if (failed.sample >= range.first && failed.sample < range.second)
        {
            ++(failed.isFromOutside ? attempts.outside : attempts.own)[failed.sample];
            attempts.lastStatus[failed.sample] = failed.status;
        }
    }
    return attempts;
}

/// Computes one sample until it succeeds or has no attempts left. \param failed attempts so far \param
/// outside how often somebody has ended it. \return nothing when this process is to stop: the sample is then
/// begun again
std::optional<SampleRow> computeSample(const Ensemble& ensemble, const fs::path& work, SampleRunner& runner,
                                       Activity& activity, long sample, int failed, int outside)
{
    for (;;)
    {
        activity.since = monotonicTime();
        activity.sample = sample;
        const double begin = cpuTimeOfAll();
        SampleOutcome outcome;
        try
        {
            outcome = runner.run(ensemble.sampler->at(sample));
        }
        catch (const std::bad_alloc&)
        {
            outcome.status = SampleStatus::outOfMemory;
            outcome.results.assign(ensemble.settings.results.size(), std::nan(""));
            outcome.message = "out of memory";
        }
        activity.sample = -1;
        if (outcome.isFromOutside)
        {
            ::poll(nullptr, 0, 100); // whoever ended the application may be about to end this process
        }
        if (stopSignal() != 0)
        {
            return {};
        }
        const SampleRow row{outcome.status, failed + 1, cpuTimeOfAll() - begin, std::move(outcome.results)};
        if (!isFailure(row.status))
        {
            return row;
        }
        addFailure(work, {sample, row.status, outcome.isFromOutside, outcome.message});
        if (outcome.isFromOutside)
        {
            if (++outside >= mostOutsideKills)
            {
                return row;
            }
            continue;
        }
        const bool mayBeRepeated =
            row.status == SampleStatus::outOfMemory || row.status == SampleStatus::crashed;
        if (!mayBeRepeated || row.attempts >= ensemble.settings.failures.attempts)
        {
            return row;
        }
        ++failed;
    }
}

/// Samples that were computed together.
struct Together
{
    std::map<long, SampleRow> rows; ///< of those that have come out; the others are computed one by one
    long end = 0;                   ///< the number after the last of them
};

/// Samples from `first` on, without those that `isLeftOut` says, as many as are computed together.
template<class IsLeftOut>
Together computeTogether(const Ensemble& ensemble, SampleRunner& runner, Activity& activity, long first,
                         long end, const IsLeftOut& isLeftOut)
{
    std::vector<long> numbers;
    std::vector<std::vector<SampleValue>> samples;
    const auto most = static_cast<std::size_t>(runner.together());
    for (long sample = first; sample < end && numbers.size() < most; ++sample)
    {
        if (!isLeftOut(sample))
        {
            numbers.push_back(sample);
            samples.push_back(ensemble.sampler->at(sample));
        }
    }
    Together together;
    together.end = numbers.back() + 1;
    const auto begins = [&](std::size_t index)
    {
        activity.since = monotonicTime();
        activity.sample = numbers[index];
    };
    activity.togetherBefore = together.end;
    begins(0);
    const double begin = cpuTimeOfAll();
    try
    {
        std::vector<std::optional<SampleOutcome>> outcomes = runner.runTogether(samples, begins);
        const double each = (cpuTimeOfAll() - begin) / static_cast<double>(samples.size());
        for (std::size_t i = 0; i < outcomes.size(); ++i)
        {
            if (outcomes[i] && !isFailure(outcomes[i]->status))
            {
                together.rows[numbers[i]] = {outcomes[i]->status, 1, each, std::move(outcomes[i]->results)};
            }
        }
    }
    catch (const std::exception&)
    {
        // Memory that one by one they do not take, or a fault that one by one each of them reports.
    }
    activity.sample = -1;
    activity.togetherBefore = 0;
    return together;
}

/// Samples that were computed after somebody has edited the case are of no ensemble.
void requireSameInput(InputWatch& input, Journal& journal)
{
    if (const std::string change = input.change(); !change.empty())
    {
        journal.sync();
        throw FatalError(editedCaseText(change, "the samples were", "Samples", "ensemble"));
    }
}

int countOf(const std::map<long, int>& counts, long sample)
{
    const auto found = counts.find(sample);
    return found == counts.end() ? 0 : found->second;
}

/// Ends this process, with what it has computed on the disk.
[[noreturn]] void endWorker(Journal& journal)
{
    journal.sync();
    ::_exit(0);
}

/// The row of a sample that has failed too often. \return none where it may be tried again
std::optional<SampleRow> failedRow(const Ensemble& ensemble, const Attempts& attempts, long sample)
{
    const int own = countOf(attempts.own, sample);
    const int outside = countOf(attempts.outside, sample);
    if (own < ensemble.settings.failures.attempts && outside < mostOutsideKills)
    {
        return {};
    }
    return SampleRow{attempts.lastStatus.at(sample), own + (own > 0 ? 0 : outside), 0,
                     std::vector<double>(ensemble.settings.results.size(), std::nan(""))};
}

void computeChunk(const Ensemble& ensemble, const SampleStore& store, long chunk, SampleRunner& runner,
                  Activity& activity, Journal& journal, InputWatch& input,
                  const std::map<long, SampleRow>& known)
{
    const auto [begin, end] = store.range(chunk);
    const Attempts attempts = attemptsOf(store.folder(), {begin, end});
    const auto isLeftOut = [&](long sample) {
        return known.contains(sample)
               || countOf(attempts.own, sample) + countOf(attempts.outside, sample) > 0;
    };
    // None of those that were together when a worker died, or that come before them.
    Together ahead{{}, std::max(begin, std::min(end, activity.aloneBefore.load()))};
    activity.done = 0;
    for (long sample = begin; sample < end; ++sample)
    {
        if (activity.stops || stopSignal() != 0)
        {
            endWorker(journal);
        }
        if (sample >= ahead.end && !isLeftOut(sample) && runner.together() > 1)
        {
            ahead = computeTogether(ensemble, runner, activity, sample, end, isLeftOut);
            requireSameInput(input, journal);
        }
        if (const auto done = ahead.rows.find(sample); done != ahead.rows.end())
        {
            journal.add(sample, done->second);
        }
        else if (!known.contains(sample))
        {
            std::optional<SampleRow> row = failedRow(ensemble, attempts, sample);
            if (!row)
            {
                row = computeSample(ensemble, store.folder(), runner, activity, sample,
                                    countOf(attempts.own, sample), countOf(attempts.outside, sample));
                if (!row)
                {
                    endWorker(journal);
                }
                requireSameInput(input, journal);
            }
            journal.add(sample, *row);
        }
        ++activity.done;
    }
    activity.aloneBefore = 0; // samples of another chunk have other numbers
    journal.sync();
}

/// Samples that warn of the same thing a thousand times shall not fill the disk.
void limitMessages()
{
    struct stat status = {};
    constexpr off_t most = 1000000;
    if (::fstat(2, &status) == 0 && S_ISREG(status.st_mode) && status.st_size > most)
    {
        constexpr std::string_view last = "Further messages are not kept.\n";
        [[maybe_unused]] const auto written = ::write(2, last.data(), last.size());
        redirect("/dev/null", 2);
    }
}

} // namespace

void redirect(const fs::path& file, int descriptor)
{
    const int opened = ::open(file.c_str(), O_WRONLY | O_CREAT | O_APPEND, 0666);
    if (opened >= 0)
    {
        ::dup2(opened, descriptor);
        ::close(opened);
    }
}

void work(const Ensemble& ensemble, const SampleStore& store, const Worker& worker,
          const std::map<long, SampleRow>& knownBefore)
{
    std::vector<char> stack(65536);
    noteFaults(*worker.activity, stack);
    try
    {
        std::map<long, SampleRow> known = knownBefore;
        readJournal(worker.journal, ensemble.settings.results.size(), known);
        Journal journal(worker.journal);
        SampleRunner runner(ensemble, worker.scratch);
        InputWatch input(ensemble.caseDirectory, runsOf(ensemble), ensemble.plan);
        for (long chunk = 0; ::read(worker.orders, &chunk, sizeof(chunk)) == sizeof(chunk);)
        {
            computeChunk(ensemble, store, chunk, runner, *worker.activity, journal, input, known);
            limitMessages();
            const char done = 1;
            if (::write(worker.answers, &done, 1) != 1)
            {
                break;
            }
        }
    }
    catch (const FatalError& error)
    {
        // Of the folder, not of a sample: the supervisor reads it.
        const std::string report = error.report();
        [[maybe_unused]] const auto written = ::write(2, report.data(), report.size());
        std::array<char, sizeof(Activity::fault)>& fault = worker.activity->fault;
        *fmt::format_to_n(fault.data(), fault.size() - 1, "{}", error.what()).out = '\0';
        ::_exit(3);
    }
    ::_exit(0);
}

void removeCopiesOfTheDead(const fs::path& folder, const std::string& prefix)
{
    std::error_code error;
    std::vector<fs::path> left;
    for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error))
    {
        const std::string name = entry->path().filename().string();
        const int process = name.starts_with(prefix) ? std::atoi(name.c_str() + prefix.size()) : 0;
        if (process > 0 && ::kill(process, 0) != 0 && errno == ESRCH)
        {
            left.push_back(entry->path());
        }
    }
    for (const fs::path& copy : left)
    {
        fs::remove_all(copy, error);
    }
}

} // namespace drystone
