// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The operating system's part of a study: processes and signals.
#include "ensembles/ApplicationRun.h"

#include "core/Error.h"
#include "core/Signals.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <utility>

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

namespace drystone
{

namespace fs = std::filesystem;

bool isScript(const std::string& application)
{
    return application.find('/') != std::string::npos;
}

std::string faultOfScript(const fs::path& caseDirectory, const std::string& application)
{
    return isScript(application) && ::access((caseDirectory / application).c_str(), X_OK) != 0
               ? fmt::format("The script {} of the case cannot be run: {}. Is it there, and executable "
                             "(chmod +x)?",
                             application, std::strerror(errno))
               : "";
}

namespace
{

/// The last lines of a file, without blank ones.
std::string lastLines(const fs::path& file, std::size_t count)
{
    std::ifstream stream(file);
    std::vector<std::string> lines;
    for (std::string line; std::getline(stream, line);)
    {
        if (!line.empty())
        {
            lines.push_back("    " + line);
        }
    }
    const std::size_t skipped = lines.size() > count ? lines.size() - count : 0;
    lines.erase(lines.begin(), lines.begin() + static_cast<std::ptrdiff_t>(skipped));
    return fmt::format("{}", fmt::join(lines, "\n"));
}

/// What a program has written; of one that never stops complaining the first of it.
std::string beginningOf(const fs::path& file)
{
    constexpr std::size_t longest = 1 << 20; // [bytes]
    std::ifstream stream(file);
    std::string text(longest, '\0');
    stream.read(text.data(), static_cast<std::streamsize>(longest));
    text.resize(static_cast<std::size_t>(stream.gcount()));
    return text;
}

/// The directory of this program, which also contains the other applications.
fs::path applicationFolder()
{
    return fs::read_symlink("/proc/self/exe").parent_path();
}

/// A program with its arguments, and the files that it writes to.
struct Command
{
    std::vector<std::string> words; ///< the program first
    std::string directory;          ///< that it runs in; empty: that of the caller
    std::string log;
    std::string errors;
};

/// A script of the case runs there; an application gets its directory as an option.
Command commandOf(const std::string& application, const fs::path& caseDirectory,
                  const std::vector<std::string>& options)
{
    const std::string program = (isScript(application) ? fs::absolute(caseDirectory / application)
                                                       : applicationFolder() / application)
                                    .string();
    if (const std::string fault = faultOfScript(caseDirectory, application); !fault.empty())
    {
        throw FatalError(fault);
    }
    if (::access(program.c_str(), X_OK) != 0)
    {
        throw FatalError(
            fmt::format("The application {} was not found with the others: {}. Build all of them.",
                        application, program));
    }
    Command command;
    command.log = fs::absolute(caseDirectory / ("log." + fs::path(application).filename().string())).string();
    command.errors = command.log + ".errors";
    command.words = {program};
    if (isScript(application))
    {
        command.directory = caseDirectory.string();
    }
    else
    {
        command.words.insert(command.words.end(), {"-case", caseDirectory.string()});
        command.words.insert(command.words.end(), options.begin(), options.end());
    }
    return command;
}

/// In the child, between fork and exec: only functions that are safe in signal handlers may be called.
/// \param arguments ending with null
[[noreturn]] void become(const Command& command, const std::vector<char*>& arguments)
{
    constexpr int notStarted = 127;
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (!command.directory.empty() && ::chdir(command.directory.c_str()) != 0)
    {
        ::_exit(notStarted);
    }
    const int output = ::open(command.log.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0666);
    const int complaints = ::open(command.errors.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0666);
    const int input = ::open("/dev/null", O_RDONLY);
    if (output < 0 || complaints < 0 || input < 0)
    {
        ::_exit(notStarted);
    }
    ::dup2(input, 0);
    ::dup2(output, 1);
    ::dup2(complaints, 2);
    ::execv(arguments.front(), arguments.data());
    ::_exit(notStarted);
}

/// Waits for a process, and hands on the signal that requests this one to stop. \return its status, as
/// waitpid has it, and whether it was interrupted
std::pair<int, bool> waitFor(pid_t child)
{
    constexpr int longestWait = 10; // [ms]
    bool isInterrupted = false;
    int status = 0;
    int wait = 0;
    while (::waitpid(child, &status, WNOHANG) == 0)
    {
        if (stopSignal() != 0 && !isInterrupted)
        {
            isInterrupted = true;
            ::kill(child, stopSignal());
        }
        wait = std::min(wait + 1, longestWait);
        ::poll(nullptr, 0, wait);
    }
    return {status, isInterrupted || stopSignal() != 0};
}

} // namespace

ApplicationRun runInCase(const std::string& application, const fs::path& caseDirectory,
                         const std::vector<std::string>& options)
{
    constexpr int linesOfErrors = 12;
    Command command = commandOf(application, caseDirectory, options);
    std::vector<char*> arguments;
    for (std::string& word : command.words)
    {
        arguments.push_back(word.data());
    }
    arguments.push_back(nullptr);
    const pid_t child = ::fork();
    if (child < 0)
    {
        throw FatalError(fmt::format("Cannot start {}: {}.", application, std::strerror(errno)));
    }
    if (child == 0)
    {
        become(command, arguments);
    }
    const auto [status, isInterrupted] = waitFor(child);
    ApplicationRun run;
    run.isInterrupted = isInterrupted;
    run.status = WIFSIGNALED(status) ? exitStatusOfSignal(WTERMSIG(status)) : WEXITSTATUS(status);
    run.errorOutput = lastLines(command.errors, linesOfErrors);
    std::error_code ignored;
    if (!run.errorOutput.empty())
    {
        run.firstErrors = beginningOf(command.errors);
    }
    else
    {
        fs::remove(command.errors, ignored);
    }
    return run;
}

} // namespace drystone
