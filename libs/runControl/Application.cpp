// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Start and end of every application: command line, banner, case, errors, exit status.
#include "runControl/Application.h"

#include "core/Error.h"
#include "core/Log.h"
#include "core/Processor.h"
#include "core/Signals.h"
#include "runControl/Case.h"
#include "runControl/CaseFiles.h"
#include "runControl/CaseLock.h"
#include "runControl/LaunchedAs.h"

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <optional>
#include <unistd.h>

#if __has_include(<malloc.h>)
#include <malloc.h>
#endif

namespace drystone
{

namespace
{

/// Who runs what, where and when: name, version and commit, command, date, host, process, case.
void printBanner(const CommandLine& commandLine)
{
    const std::time_t now = std::time(nullptr);
    std::tm local = {};
    ::localtime_r(&now, &local);
    char date[64] = "";
    std::strftime(date, sizeof(date), "%Y-%m-%d %H:%M:%S", &local);
    info("{}: structures of rigid blocks with dry joints", versionText());
    printLine();
    info("Exec    : {}", commandLine.typed.empty() ? commandLine.application : commandLine.typed);
    info("Date    : {}", date);
    info("Host    : {}", hostName());
    info("PID     : {}", ::getpid());
    info("Case    : {}", fullName(commandLine.caseDirectory).string());
    info("nProcs  : {}", commandLine.parallel ? launchedAs().size : 1);
    printLine();
    std::fflush(stdout);
}

/// What to do where a case is at work: it may be that of the other programs of the same mpirun.
std::string remedyOfLock(const ApplicationDescription& description)
{
    for (const char* variable : {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE"})
    {
        const char* size = std::getenv(variable);
        if (size && std::atoi(size) > 1)
        {
            return fmt::format("mpirun has started {} of {} as programs that do not know of each other: {}.",
                               size, description.name,
                               description.parallel.empty()
                                   ? "start it without mpirun, it has no parallel mode"
                                   : "add -parallel, with which they share the work");
        }
    }
    return "Wait until it has ended, or run in a copy of the case.";
}

int runCommandLine(int argc, const char* const* argv, const ApplicationDescription& description,
                   const std::function<int(const CommandLine&)>& program)
{
    const CommandLine commandLine = readCommandLine(argc, argv, description);
    if (commandLine.help)
    {
        fmt::print("{}", helpText(description));
        return 0;
    }
    if (commandLine.version)
    {
        fmt::print("{}\n", versionText());
        return 0;
    }
    std::error_code failure;
    if (!std::filesystem::is_directory(commandLine.caseDirectory, failure))
    {
        refuseUnreadable(commandLine.caseDirectory, failure);
        throw FatalError(fmt::format("There is no case directory {}.\n\nName one with -case DIR, or run "
                                     "{} inside of one.",
                                     commandLine.caseDirectory.string(), description.name));
    }
    std::optional<CaseLock> lock;
    const bool isShared = commandLine.parallel
                          || std::any_of(description.sharing.begin(), description.sharing.end(),
                                         [&](const std::string& option) { return commandLine.has(option); });
    if (description.kind != ApplicationKind::utility && !commandLine.dryRun && !isShared)
    {
        lock.emplace(commandLine.caseDirectory, description.name, remedyOfLock(description));
    }
    if (description.output == Output::log)
    {
        printBanner(commandLine);
    }
    if (description.kind != ApplicationKind::utility)
    {
        refuseMisnamedFiles(commandLine.caseDirectory);
    }
    return program(commandLine);
}

} // namespace

std::string versionText()
{
    const std::string_view revision = DRYSTONE_REVISION;
    return fmt::format("Drystone {}{}{}", DRYSTONE_VERSION, revision.empty() ? "" : " at ", revision);
}

void keepFreedMemory()
{
#ifdef __GLIBC__
    constexpr int kept = 1 << 28;          // bytes on top of the heap
    constexpr int largestOnHeap = 1 << 25; // bytes of one array; more is not taken
    mallopt(M_TRIM_THRESHOLD, kept);
    mallopt(M_MMAP_THRESHOLD, largestOnHeap);
#endif
}

int runApplication(int argc, const char* const* argv, const ApplicationDescription& description,
                   const std::function<int(const CommandLine&)>& program)
{
    requireProcessor();
    keepFreedMemory();
    std::signal(SIGXFSZ, SIG_IGN); // a file beyond `ulimit -f` is one that cannot be written, with a message
    return runGuarded(
        [&]
        {
            const int status = runCommandLine(argc, argv, description, program);
            // A log on a full disk: what was printed last may be the answer.
            if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0)
            {
                throw FatalError("Standard output cannot be written: what was printed is lost, in part or in "
                                 "whole. Check that the disk has room.");
            }
            return status;
        });
}

void printStopOrEnd(std::string_view continuation)
{
    if (stopSignal() == 0)
    {
        printEnd();
        return;
    }
    info("Stopped by a signal; what was computed so far is kept. {}\n", continuation);
    std::fflush(stdout);
}

} // namespace drystone
