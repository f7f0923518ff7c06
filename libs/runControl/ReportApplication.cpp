// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Starts the application `report` and waits for it.
#include "runControl/ReportApplication.h"

#include "core/Error.h"
#include "core/Log.h"
#include "core/Signals.h"

#include <fmt/format.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

namespace drystone
{

namespace
{

/// Its own banner would be a second one in the log of the solver.
class NoOutput
{
public:
    NoOutput()
    {
        ::posix_spawn_file_actions_init(&actions);
        ::posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
    }
    ~NoOutput() { ::posix_spawn_file_actions_destroy(&actions); }
    NoOutput(const NoOutput&) = delete;
    NoOutput& operator=(const NoOutput&) = delete;

    posix_spawn_file_actions_t actions = {};
};

} // namespace

void runReport(const std::filesystem::path& caseDirectory)
{
    std::error_code unknown;
    const std::filesystem::path folder =
        std::filesystem::read_symlink("/proc/self/exe", unknown).parent_path();
    std::string program = (folder / "report").string();
    std::string option = "-case";
    std::string directory = caseDirectory.string();
    const std::array<char*, 4> arguments{program.data(), option.data(), directory.data(), nullptr};
    std::fflush(stdout);

    const NoOutput output;
    pid_t child = 0;
    const int failure =
        ::posix_spawn(&child, program.c_str(), &output.actions, nullptr, arguments.data(), ::environ);
    if (failure != 0)
    {
        throw FatalError(fmt::format("The report was not written, the results are: the application report "
                                     "cannot be started as {}: {}.\n\nBuild or install it beside this one.",
                                     program, std::strerror(failure)));
    }
    int status = 0;
    while (::waitpid(child, &status, 0) < 0 && errno == EINTR)
    {
    }
    if (status != 0)
    {
        throw FatalError(
            "The report was not written, the results are: see the message of the application report "
            "above.",
            WIFSIGNALED(status) ? exitStatusOfSignal(WTERMSIG(status)) : WEXITSTATUS(status));
    }
    info("Wrote {}\n", (caseDirectory / "report.html").lexically_normal().string());
}

} // namespace drystone
