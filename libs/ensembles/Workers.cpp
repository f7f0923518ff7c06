// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The supervisor of workers: claims chunks, watches, and shares a page of memory with them, which says what
/// each does.
#include "ensembles/Workers.h"

#include "core/Log.h"
#include "core/Signals.h"
#include "ensembles/WorkerProcess.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <ctime>
#include <fstream>
#include <iterator>
#include <new>
#include <optional>

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

namespace drystone
{

namespace fs = std::filesystem;

namespace
{

class Supervisor
{
public:
    Supervisor(const Ensemble& of, SampleStore& sharedStore, const WorkerSettings& wanted)
        : ensemble(of), store(sharedStore), settings(wanted), memory(mapped(wanted.jobs))
    {
        completed = store.completed(); // before the journals, which have all of these by then
        std::vector<Doubt> doubts;
        known = readJournals(store.folder(), ensemble.settings.results.size(), &doubts);
        if (isFirst())
        {
            question(doubts);
        }
        compareChunksWithJournals();
        const std::string host = hostName();
        removeCopiesOfTheDead(store.folder(), fmt::format("case.{}.", host));
        for (int i = 0; i < settings.jobs; ++i)
        {
            Worker worker;
            worker.activity = new (memory + i) Activity;
            const std::string name = fmt::format("{}.{}.{}", host, ::getpid(), i);
            worker.journal = store.folder() / ("journal." + name);
            worker.messages = store.folder() / ("messages." + name);
            worker.scratch = store.folder() / ("case." + name);
            workers.push_back(std::move(worker));
        }
    }

    ~Supervisor()
    {
        for (Worker& worker : workers)
        {
            end(worker);
            std::error_code ignored;
            if (fs::is_regular_file(worker.messages, ignored) && fs::file_size(worker.messages, ignored) == 0)
            {
                fs::remove(worker.messages, ignored);
            }
            fs::remove_all(worker.scratch, ignored);
        }
        ::munmap(memory, sizeof(Activity) * static_cast<std::size_t>(settings.jobs));
    }
    Supervisor(const Supervisor&) = delete;
    Supervisor& operator=(const Supervisor&) = delete;

    bool run(const std::function<void(const EnsembleProgress&)>& report)
    {
        double lastReport = monotonicTime();
        double lastLook = 0;
        while (stopSignal() == 0)
        {
            bool isBusy = false;
            for (Worker& worker : workers)
            {
                if (worker.chunk < 0)
                {
                    worker.chunk = nextChunk(lastLook);
                    if (worker.chunk >= 0)
                    {
                        order(worker);
                    }
                }
                isBusy = isBusy || worker.chunk >= 0;
            }
            if (!isBusy)
            {
                completed = store.completed();
                if (isComplete() || !settings.waitsForOthers)
                {
                    break;
                }
            }
            listen();
            endLateOnes();
            if (monotonicTime() - lastReport > 2)
            {
                lastReport = monotonicTime();
                report(progress());
            }
        }
        if (stopSignal() != 0)
        {
            stopWorkers();
        }
        completed = store.completed();
        report(progress());
        return isComplete();
    }

private:
    static Activity* mapped(int jobs)
    {
        void* memory = ::mmap(nullptr, sizeof(Activity) * static_cast<std::size_t>(jobs),
                              PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
        if (memory == MAP_FAILED)
        {
            throw FatalError("There is no memory to share with worker processes.");
        }
        return static_cast<Activity*>(memory);
    }

    bool isComplete() const
    {
        return std::all_of(completed.begin(), completed.end(), [](char done) { return done != 0; });
    }

    /// Whether this process warns of what all of them find.
    bool isFirst() const { return settings.launched.rank == 0 || settings.launched.isArray; }

    /// Completes chunks all of whose samples are in journals, after an interruption or for a longer table,
    /// and reopens those of which samples are in none, where files were lost.
    void compareChunksWithJournals()
    {
        long lost = 0; // samples
        for (long chunk = 0; chunk < store.chunks(); ++chunk)
        {
            const auto [begin, end] = store.range(chunk);
            const long missing =
                end - begin - std::distance(known.lower_bound(begin), known.lower_bound(end));
            const bool isDone = completed[static_cast<std::size_t>(chunk)] != 0;
            if (isDone && missing > 0)
            {
                store.reopen(chunk);
                lost += missing;
            }
            else if (!isDone && missing == 0 && store.claim(chunk) != SampleStore::Claim::refused)
            {
                store.complete(chunk);
            }
        }
        if (lost > 0 && isFirst())
        {
            printWarning(
                fmt::format("{} samples that were computed are in no journal of {} any more, as after "
                            "a power failure or where files were copied during a run: they are "
                            "computed again.",
                            lost, store.folder().string()));
        }
        completed = store.completed();
        doneAtStart = samplesCompleted();
        begun.assign(completed.size(), 0);
        place =
            std::min(static_cast<long>(static_cast<double>(completed.size()) * settings.launched.beginning),
                     static_cast<long>(completed.size()) - 1);
    }

    long samplesCompleted() const
    {
        long done = 0;
        for (long chunk = 0; chunk < store.chunks(); ++chunk)
        {
            if (completed[static_cast<std::size_t>(chunk)])
            {
                done += store.range(chunk).second - store.range(chunk).first;
            }
        }
        return done;
    }

    /// Claims the next chunk that nobody has; -1 when there is none now. Programs begin at different places.
    /// \param lastLook when all chunks were last claimed, so that waiting for others costs little
    long nextChunk(double& lastLook)
    {
        if (isExhausted && monotonicTime() - lastLook < 0.3)
        {
            return -1;
        }
        const long count = store.chunks();
        if (isExhausted)
        {
            completed = store.completed();
        }
        lastLook = monotonicTime();
        for (long tried = 0; tried < count; ++tried)
        {
            const long chunk = (place + tried) % count;
            const auto index = static_cast<std::size_t>(chunk);
            if (completed[index] || begun[index])
            {
                continue;
            }
            const SampleStore::Claim claim = store.claim(chunk);
            // Without locks each program has chunks of its own, but where nobody knows which others there
            // are: each takes all that are not complete, and two may compute the same one.
            const bool isOurs = claim == SampleStore::Claim::taken
                                || (claim == SampleStore::Claim::noLocks
                                    && (settings.launched.isIrregular
                                        || chunk % settings.launched.size == settings.launched.rank));
            if (isOurs)
            {
                place = (chunk + 1) % count;
                begun[index] = 1;
                isExhausted = false;
                return chunk;
            }
        }
        isExhausted = true;
        return -1;
    }

    void start(Worker& worker)
    {
        int orders[2];
        int answers[2];
        if (::pipe2(orders, O_CLOEXEC) != 0 || ::pipe2(answers, O_CLOEXEC) != 0)
        {
            throw FatalError(fmt::format("Cannot start a worker process: {}.", std::strerror(errno)));
        }
        worker.isEnded = false;
        worker.activity->sample = -1;
        worker.activity->togetherBefore = 0;
        worker.activity->isFromOutside = false;
        const pid_t supervisor = ::getpid();
        const pid_t child = ::fork();
        if (child < 0)
        {
            throw FatalError(fmt::format("Cannot start a worker process: {}.", std::strerror(errno)));
        }
        if (child == 0)
        {
            ::prctl(PR_SET_PDEATHSIG, SIGKILL);
            if (::getppid() != supervisor)
            {
                ::_exit(0); // it has died meanwhile
            }
            ::setpgid(0, 0);           // with what it starts it is ended as one
            ::signal(SIGINT, SIG_IGN); // Ctrl-C is the supervisor's
            ::close(orders[1]);
            ::close(answers[0]);
            for (const Worker& other : workers)
            {
                ::close(other.orders);
                ::close(other.answers);
            }
            redirect("/dev/null", 1);
            redirect(worker.messages, 2);
            if (const auto& limit = ensemble.settings.failures.maximumMemory)
            {
                const auto bytes = static_cast<rlim_t>(*limit * 1e6);
                const rlimit limits{bytes, bytes};
                ::setrlimit(RLIMIT_AS, &limits);
            }
            worker.orders = orders[0];
            worker.answers = answers[1];
            work(ensemble, store, worker, known);
        }
        ::close(orders[0]);
        ::close(answers[1]);
        worker.process = child;
        worker.orders = orders[1];
        worker.answers = answers[0];
    }

    void order(Worker& worker)
    {
        if (worker.process < 0)
        {
            start(worker);
        }
        if (::write(worker.orders, &worker.chunk, sizeof(worker.chunk)) != sizeof(worker.chunk)
            && errno != EPIPE)
        {
            throw FatalError(fmt::format("Cannot reach a worker process: {}.", std::strerror(errno)));
        }
    }

    /// Waits a little for answers.
    void listen()
    {
        std::vector<pollfd> polled;
        for (const Worker& worker : workers)
        {
            polled.push_back({worker.answers, POLLIN, 0});
        }
        if (::poll(polled.data(), polled.size(), 50) <= 0)
        {
            return;
        }
        for (std::size_t i = 0; i < workers.size(); ++i)
        {
            Worker& worker = workers[i];
            if (polled[i].revents == 0 || worker.process < 0)
            {
                continue;
            }
            char byte = 0;
            if (::read(worker.answers, &byte, 1) == 1)
            {
                store.complete(worker.chunk);
                completed[static_cast<std::size_t>(worker.chunk)] = 1;
                worker.chunk = -1;
                worker.activity->done = 0;
                continue;
            }
            bury(worker);
            if (worker.chunk >= 0)
            {
                order(worker); // the rest of its chunk
            }
        }
    }

    /// Takes note of a worker that has died.
    void bury(Worker& worker)
    {
        int status = 0;
        ::waitpid(worker.process, &status, 0);
        ::kill(-worker.process, SIGKILL); // what it has started
        ::close(worker.orders);
        ::close(worker.answers);
        worker.process = worker.orders = worker.answers = -1;
        if (WIFEXITED(status) && WEXITSTATUS(status) == 3)
        {
            std::error_code none;
            const bool isWritten = fs::file_size(worker.messages, none) > 0 && !none;
            throw FatalError(fmt::format("A worker process cannot go on{}\n\n{}",
                                         isWritten ? ": see " + worker.messages.string() + "." : ".",
                                         worker.activity->fault.data()));
        }
        const long sample = worker.activity->sample;
        if (sample < 0)
        {
            return;
        }
        const int signal = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
        const std::string why = worker.isEnded ? "took longer than maximumTime"
                                : signal != 0
                                    ? fmt::format("ended by signal {} ({})", signal, ::strsignal(signal))
                                    : "ended without an answer";
        if (const long end = worker.activity->togetherBefore; end > 0)
        {
            worker.activity->aloneBefore = end; // one by one they show whose fault it was
            std::ofstream(worker.messages, std::ios::app)
                << fmt::format("Samples {} to {}, computed together: {}. They are begun again one by one.\n",
                               sample, end - 1, why);
            return;
        }
        const bool isOutside =
            !worker.isEnded
            && (worker.activity->isFromOutside || signal == SIGKILL || signal == SIGTERM || signal == SIGHUP);
        addFailure(store.folder(),
                   {sample, worker.isEnded ? worker.endedFor : SampleStatus::crashed, isOutside, why});
        ++failedAttempts;
    }

    void endLateOnes()
    {
        const auto& limit = ensemble.settings.failures.maximumTime;
        if (!limit)
        {
            return;
        }
        for (Worker& worker : workers)
        {
            if (worker.process >= 0 && !worker.isEnded && worker.activity->sample >= 0
                && monotonicTime() - worker.activity->since > *limit)
            {
                worker.isEnded = true;
                worker.endedFor = SampleStatus::timeExceeded;
                killWith(worker);
            }
        }
    }

    /// A worker and the applications that it runs.
    static void killWith(const Worker& worker)
    {
        ::kill(worker.process, SIGKILL);
        ::kill(-worker.process, SIGKILL);
    }

    /// After a signal: workers finish the sample in hand, but not for long.
    void stopWorkers()
    {
        for (Worker& worker : workers)
        {
            worker.activity->stops = true;
            ::close(worker.orders);
            worker.orders = -1;
        }
        const double until = monotonicTime() + 2;
        for (bool isAny = true; isAny && monotonicTime() < until;)
        {
            isAny = false;
            for (Worker& worker : workers)
            {
                int status = 0;
                if (worker.process >= 0 && ::waitpid(worker.process, &status, WNOHANG) == worker.process)
                {
                    worker.process = -1;
                }
                isAny = isAny || worker.process >= 0;
            }
            ::poll(nullptr, 0, 10);
        }
    }

    void end(Worker& worker)
    {
        ::close(worker.orders);
        if (worker.process >= 0)
        {
            if (worker.chunk >= 0)
            {
                killWith(worker);
            }
            ::waitpid(worker.process, nullptr, 0);
        }
        ::close(worker.answers);
    }

    EnsembleProgress progress()
    {
        completed = store.completed();
        EnsembleProgress now;
        now.samples = store.samples();
        now.done = samplesCompleted();
        for (const Worker& worker : workers)
        {
            now.done += worker.chunk >= 0 ? worker.activity->done.load() : 0;
        }
        now.failed = failedAttempts;
        const double elapsed = monotonicTime() - began;
        now.rate = elapsed > 0 ? static_cast<double>(now.done - doneAtStart) / elapsed : 0;
        return now;
    }

    const Ensemble& ensemble;
    SampleStore& store;
    WorkerSettings settings;
    Activity* memory;
    std::vector<Worker> workers;
    std::map<long, SampleRow> known; ///< of all journals when this program began
    std::vector<char> completed;     ///< chunks
    std::vector<char> begun;         ///< chunks that this program has taken
    long place = 0;                  ///< where the next chunk is looked for
    bool isExhausted = false;
    long doneAtStart = 0;
    long failedAttempts = 0;
    double began = monotonicTime();
};

} // namespace

bool computeSamples(const Ensemble& ensemble, SampleStore& store, const WorkerSettings& settings,
                    const std::function<void(const EnsembleProgress&)>& report)
{
    ::signal(SIGPIPE, SIG_IGN); // a worker that died is noticed where its answer is read
    return Supervisor(ensemble, store, settings).run(report);
}

} // namespace drystone
