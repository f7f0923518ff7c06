// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Prints lines, and the clocks, cores and threads of the process that banners and logs name.
#include "core/Log.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <limits>
#include <sched.h>
#include <unistd.h>

namespace drystone
{

namespace
{

double secondsOf(clockid_t clock)
{
    timespec now = {};
    ::clock_gettime(clock, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// When this process began, by the clock that `clockTime` reads, in ticks since the machine started: the 22nd
/// field of /proc/self/stat. The name in parentheses before it may hold blanks.
double processStart()
{
    std::string text(1024, '\0');
    if (std::FILE* file = std::fopen("/proc/self/stat", "r"))
    {
        text.resize(std::fread(text.data(), 1, text.size(), file));
        std::fclose(file);
        const std::size_t name = text.rfind(')');
        if (name != std::string::npos)
        {
            const char* next = text.c_str() + name;
            for (int field = 2; field < 22 && next; ++field)
            {
                next = std::strchr(next + 1, ' ');
            }
            const long ticks = ::sysconf(_SC_CLK_TCK);
            if (next && ticks > 0)
            {
                return std::strtod(next, nullptr) / static_cast<double>(ticks);
            }
        }
    }
    return secondsOf(CLOCK_BOOTTIME);
}

std::string joined(const std::vector<std::string>& words)
{
    std::string text;
    for (const std::string& word : words)
    {
        text += (text.empty() ? "" : " ") + word;
    }
    return text.empty() ? "none" : text;
}

/// A number of threads in the environment; 0 where there is none.
int threadsInEnvironment(const char* name)
{
    const char* wanted = std::getenv(name);
    const long count = wanted ? std::strtol(wanted, nullptr, 10) : 0;
    return count > 0 && count < 100000 ? static_cast<int>(count) : 0;
}

/// Cores whose time a control group may use, from the line `quota period` of its cpu.max; infinite where it
/// has no limit.
double coresOfGroup()
{
    double quota = 0;
    double period = 0;
    if (std::FILE* file = std::fopen("/sys/fs/cgroup/cpu.max", "r"))
    {
        const int found = std::fscanf(file, "%lf %lf", &quota, &period);
        std::fclose(file);
        if (found == 2 && quota > 0 && period > 0)
        {
            return quota / period;
        }
    }
    return std::numeric_limits<double>::infinity();
}

int coresAllowed()
{
    cpu_set_t allowed;
    CPU_ZERO(&allowed);
    if (::sched_getaffinity(0, sizeof(allowed), &allowed) == 0)
    {
        return std::max(1, CPU_COUNT(&allowed));
    }
    return static_cast<int>(std::max(1L, ::sysconf(_SC_NPROCESSORS_ONLN)));
}

} // namespace

void printLine(std::string_view line)
{
    if (!line.empty()) // its data may be null, which fwrite must not be given
    {
        std::fwrite(line.data(), 1, line.size(), stdout);
    }
    std::fputc('\n', stdout);
}

void printEffects(const std::vector<std::string>& simulated, const std::vector<std::string>& absent,
                  const std::vector<std::string>& ofMotion)
{
    info("Effects simulated: {}", joined(simulated));
    info("Effects absent: {}", joined(absent));
    if (!ofMotion.empty())
    {
        info("Not part of limit analysis: {} (of contactDynamics)", joined(ofMotion));
    }
    printLine();
}

double cpuTime()
{
    return secondsOf(CLOCK_PROCESS_CPUTIME_ID);
}

double clockTime()
{
    static const double start = processStart();
    return std::max(0.0, secondsOf(CLOCK_BOOTTIME) - start);
}

void flushLog()
{
    std::fflush(stdout);
}

void printExecutionTime()
{
    info("ExecutionTime = {:.4g} s  ClockTime = {:.0f} s", cpuTime(), clockTime());
    printLine();
    flushLog();
}

void printEnd()
{
    printLine("End");
    printLine();
    flushLog();
}

std::string hostName()
{
    char name[256] = "";
    ::gethostname(name, sizeof(name) - 1);
    return name;
}

int threadCount()
{
    for (const char* name : {"OMP_NUM_THREADS", "SLURM_CPUS_PER_TASK"})
    {
        if (const int inEnvironment = threadsInEnvironment(name))
        {
            return inEnvironment;
        }
    }
    return std::max(1, static_cast<int>(std::min<double>(coresAllowed(), std::ceil(coresOfGroup()))));
}

std::string durationText(double seconds)
{
    if (!(seconds >= 0) || seconds > 1e9)
    {
        return "unknown";
    }
    const long whole = std::lround(seconds);
    if (whole >= 86400)
    {
        return fmt::format("{} d {} h", whole / 86400, whole % 86400 / 3600);
    }
    if (whole >= 3600)
    {
        return fmt::format("{} h {} min", whole / 3600, whole % 3600 / 60);
    }
    if (whole >= 60)
    {
        return fmt::format("{} min {} s", whole / 60, whole % 60);
    }
    return fmt::format("{} s", whole);
}

Progress::Progress() : isTerminal(::isatty(STDERR_FILENO) == 1), start(Clock::now()), lastShown(start) {}

Progress::~Progress()
{
    clear();
}

void Progress::update(double done, std::string_view what)
{
    if (!isTerminal)
    {
        return;
    }
    const Clock::time_point now = Clock::now();
    if (doneAtStart < 0)
    {
        doneAtStart = done;
        start = now;
    }
    if (now - lastShown < std::chrono::milliseconds(200))
    {
        return;
    }
    lastShown = now;
    const double elapsed = std::chrono::duration<double>(now - start).count();
    const double own = done - doneAtStart;
    const std::string left =
        own > 0 ? durationText(elapsed * (1 - done) / own) + " left" : std::string("estimating");
    std::fflush(stdout);
    fmt::print(stderr, "\r\033[K{:5.1f} %  {}  {}", 100 * std::clamp(done, 0.0, 1.0), left, what);
    std::fflush(stderr);
    isShown = true;
}

void Progress::clear()
{
    if (!isShown)
    {
        return;
    }
    std::fputs("\r\033[K", stderr);
    std::fflush(stderr);
    isShown = false;
}

} // namespace drystone
