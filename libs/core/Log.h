// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// What an application reports to its user on standard output.
#pragma once

#include <fmt/format.h>

#include <chrono>
#include <string>
#include <string_view>
#include <vector>

namespace drystone
{

/// Print a line.
void printLine(std::string_view line = {});

/// Print a line, formatted by fmt: `info("Collapse load multiplier alpha = {:.9g}", alpha)`.
template<class... Arguments>
void info(fmt::format_string<Arguments...> format, Arguments&&... arguments)
{
    printLine(fmt::format(format, std::forward<Arguments>(arguments)...));
}

/// Which effects a run simulates, which it does not and therefore does not pay for, and what the case has
/// that is of motion alone and no part of the analysis.
void printEffects(const std::vector<std::string>& simulated, const std::vector<std::string>& absent,
                  const std::vector<std::string>& ofMotion = {});

double cpuTime();   ///< of this process, all its threads together [s]
double clockTime(); ///< since the program started [s]

/// Sends on what was printed so far, before something that may take long: a log in a file then says where it
/// is.
void flushLog();

/// `ExecutionTime = 1.25 s  ClockTime = 1 s`, and sends on what was printed so far.
void printExecutionTime();

/// The last line, `End`.
void printEnd();

/// The name of this machine in its network.
std::string hostName();

/// Number of threads that numerical libraries may use: OMP_NUM_THREADS, or the cores this process may use.
int threadCount();

/// `1 h 5 min`, `12 s`.
std::string durationText(double seconds);

/// A line that shows how far a run has come and how long it will still take, on a terminal only: nothing is
/// printed where standard error is a file. The line is wiped before it is written again and at the end.
class Progress
{
public:
    Progress();
    ~Progress();
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;

    /// \param done part of the work that is done, 0 to 1. At most five lines a second are written.
    void update(double done, std::string_view what = {});
    void clear();

private:
    using Clock = std::chrono::steady_clock;
    bool isTerminal;
    bool isShown = false;
    double doneAtStart = -1; ///< a run that continues has not done the first part itself
    Clock::time_point start;
    Clock::time_point lastShown;
};

} // namespace drystone
