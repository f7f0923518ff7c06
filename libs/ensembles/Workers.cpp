// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The supervisor of workers: hands out chunks, watches, and shares a page of memory with them, which says
/// what each does.
#include "ensembles/Workers.h"

#include "core/Log.h"
#include "core/Signals.h"
#include "ensembles/ChunkQueue.h"
#include "ensembles/WorkerProcess.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <new>

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
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
        : ensemble(of),
          store(sharedStore),
          settings(wanted),
          memory(mapped(wanted.jobs)),
          chunks(sharedStore, wanted.launched)
    {
        std::vector<Doubt> doubts;
        known = readJournals(store.folder(), ensemble.settings.results.size(), &doubts);
        if (isFirst())
        {
            question(doubts);
        }
        if (const long lost = chunks.compareWithJournals(known); lost > 0 && isFirst())
        {
            warnOfLost(lost);
        }
        doneAtStart = chunks.samplesCompleted();
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
        while (stopSignal() == 0)
        {
            bool isBusy = false;
            for (Worker& worker : workers)
            {
                if (worker.chunk < 0)
                {
                    worker.chunk = chunks.next();
                    if (worker.chunk >= 0)
                    {
                        order(worker);
                    }
                }
                isBusy = isBusy || worker.chunk >= 0;
            }
            if (!isBusy)
            {
                chunks.look();
                if (chunks.areAllComplete() || !settings.waitsForOthers)
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
        report(progress());
        return chunks.areAllComplete();
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

    /// Whether this process warns of what all of them find.
    bool isFirst() const { return settings.launched.rank == 0 || settings.launched.isArray; }

    void warnOfLost(long samples) const
    {
        printWarning(fmt::format("{} samples that were computed are in no journal of {} any more, as after "
                                 "a power failure or where files were copied during a run: they are "
                                 "computed again.",
                                 samples, store.folder().string()));
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
                chunks.complete(worker.chunk);
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
        chunks.look();
        EnsembleProgress now;
        now.samples = store.samples();
        now.done = chunks.samplesCompleted();
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
    ChunkQueue chunks; ///< made before the journals are read
    std::vector<Worker> workers;
    std::map<long, SampleRow> known; ///< of all journals when this program began
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
