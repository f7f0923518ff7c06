// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The operating system's part of a study: files, processes and signals.
#include "ensembles/CaseRuns.h"

#include "core/Error.h"
#include "core/Log.h"
#include "core/Signals.h"
#include "core/WholeFile.h"
#include "dictionary/CopiedIncludes.h"
#include "runControl/Case.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <iterator>

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

namespace drystone
{
namespace
{

namespace fs = std::filesystem;

/// Whether an entry of a case directory is a result, or belongs to a search.
bool isLeftOut(const fs::path& path)
{
    const std::string name = path.filename().string();
    if (name == "VTK" || name == "postProcessing" || name == "parameterSearch" || name.starts_with("log.")
        || name.starts_with("."))
    {
        return true;
    }
    char* end = nullptr;
    const double time = std::strtod(name.c_str(), &end);
    return end != name.c_str() && *end == 0 && time != 0 && fs::is_directory(path);
}

/// A copy of a file, whose included files are where those of the file are. What is written into it is the
/// study's: a file that is write-protected has a copy that is not.
void copyFile(const fs::path& file, const fs::path& to, const fs::path& caseDirectory)
{
    const fs::perms permissions = fs::status(file).permissions() | fs::perms::owner_write;
    constexpr std::uintmax_t largestDictionary = 1 << 20; // with includes; records and the like are larger
    if (fs::file_size(file) <= largestDictionary)
    {
        std::ifstream stream(file, std::ios::binary);
        const std::string text{std::istreambuf_iterator<char>(stream), {}};
        const std::string there = withIncludesFromOutside(text, file, caseDirectory);
        if (there != text)
        {
            writeWholeFile(to, there);
            fs::permissions(to, permissions);
            return;
        }
    }
    fs::copy_file(file, to, fs::copy_options::overwrite_existing);
    fs::permissions(to, permissions);
}

void copyInto(const fs::path& from, const fs::path& to, const fs::path& caseDirectory)
{
    fs::create_directories(to);
    for (const fs::directory_entry& entry : fs::directory_iterator(from))
    {
        if (isLeftOut(entry.path()))
        {
            continue;
        }
        if (entry.is_directory())
        {
            copyInto(entry.path(), to / entry.path().filename(), caseDirectory);
        }
        else if (entry.is_regular_file())
        {
            copyFile(entry.path(), to / entry.path().filename(), caseDirectory);
        }
    }
}

void listFiles(const fs::path& folder, std::vector<fs::path>& files)
{
    for (const fs::directory_entry& entry : fs::directory_iterator(folder))
    {
        if (isLeftOut(entry.path()))
        {
            continue;
        }
        if (entry.is_directory())
        {
            listFiles(entry.path(), files);
        }
        else if (entry.is_regular_file())
        {
            files.push_back(entry.path());
        }
    }
}

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

/// The directory of this program, which also contains the other applications.
fs::path applicationFolder()
{
    return fs::read_symlink("/proc/self/exe").parent_path();
}

} // namespace

void copyCase(const fs::path& caseDirectory, const fs::path& target)
{
    try
    {
        fs::remove_all(target);
        copyInto(caseDirectory, target, caseDirectory);
    }
    catch (const fs::filesystem_error& error)
    {
        throw FatalError(
            fmt::format("Cannot copy the case to {}: {}.\n\nCheck that its folder may be written and "
                        "that the disk has room.",
                        target.string(), error.code().message()));
    }
}

std::vector<fs::path> filesOfCase(const fs::path& caseDirectory)
{
    std::vector<fs::path> files;
    listFiles(caseDirectory, files);
    std::sort(files.begin(), files.end());
    return files;
}

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

/// Waits for a process, and hands on the signal that asks this one to stop. \return its status, as waitpid
/// has it, and whether it was interrupted
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
    if (run.errorOutput.empty())
    {
        fs::remove(command.errors, ignored);
    }
    return run;
}

namespace
{

enum class Depth
{
    results,
    beginning ///< what computes does not
};

bool computes(const std::string& application)
{
    return application != "blockTexture" && application != "checkBlocks";
}

CaseRun runIn(const fs::path& copy, const CaseApplications& applications, Depth depth)
{
    CaseRun run;
    for (const std::string& directory : applications.cases)
    {
        for (const std::string& application : applications.applications)
        {
            std::vector<std::string> options = applications.options;
            if (depth == Depth::beginning && application.find('/') != std::string::npos)
            {
                break; // nobody knows what a script does
            }
            if (depth == Depth::beginning && computes(application))
            {
                options.emplace_back("-dry-run");
            }
            const fs::path there = (copy / directory).lexically_normal();
            static_cast<ApplicationRun&>(run) = runInCase(application, there, options);
            run.application = application;
            run.directory = directory;
            if (run.isInterrupted || run.status != 0)
            {
                return run;
            }
        }
    }
    return run;
}

void copyWith(const fs::path& caseDirectory, const fs::path& target, const std::vector<OtherEntry>& entries)
{
    copyCase(caseDirectory, target);
    for (const auto& [place, text] : entries)
    {
        setEntry(target, place, text);
    }
}

/// Removes a folder at the end, and those above it that were not there before.
class PassingFolder
{
public:
    explicit PassingFolder(fs::path of) : folder(std::move(of))
    {
        for (top = folder; !fs::exists(top.parent_path()); top = top.parent_path())
        {
        }
    }
    ~PassingFolder()
    {
        std::error_code ignored;
        fs::remove_all(folder, ignored);
        for (fs::path above = folder; above != top;)
        {
            above = above.parent_path();
            fs::remove(above, ignored); // empty ones only
        }
    }
    PassingFolder(const PassingFolder&) = delete;
    PassingFolder& operator=(const PassingFolder&) = delete;

private:
    fs::path folder;
    fs::path top;
};

/// An application that a full disk has ended says nothing of the values it was given, and its own message may
/// have had no room either. \throws FatalError
void requireRoom(const fs::path& copy, const CaseRun& failed)
{
    constexpr std::uintmax_t little = 1 << 20; // [bytes]; what could not be written whole is removed again
    std::error_code unknown;
    const fs::space_info space = fs::space(copy, unknown);
    if (!unknown && space.available < little)
    {
        throw FatalError(fmt::format(
            "{} ended with exit status {} in {}, and its disk has less than 1 MB left: that is no "
            "result.\n\nMake room on the disk, and start again; it goes on from here.",
            failed.application, failed.status, copy.string()));
    }
}

/// A message about a copy as one about the case: without the copy's folder, and without what frames it.
std::string faultOfCopy(std::string message, const fs::path& copy)
{
    for (const std::string& text :
         {copy.string() + "/", std::string("    --> DRYSTONE FATAL IO ERROR:\n"),
          std::string("    --> DRYSTONE FATAL ERROR:\n"), std::string("\n    DRYSTONE exiting")})
    {
        for (auto at = message.find(text); at != std::string::npos; at = message.find(text, at))
        {
            message.erase(at, text.size());
        }
    }
    return message;
}

} // namespace

CaseRun runCopy(const fs::path& caseDirectory, const fs::path& target, const std::vector<OtherEntry>& entries,
                const CaseApplications& applications)
{
    copyWith(caseDirectory, target, entries);
    CaseRun run = runIn(target, applications, Depth::results);
    if (run.status != 0 && !run.isInterrupted)
    {
        requireRoom(target, run);
    }
    return run;
}

CaseRun tryCopy(const fs::path& caseDirectory, const fs::path& target, const std::vector<OtherEntry>& entries,
                const CaseApplications& applications)
{
    const PassingFolder folder(fs::absolute(target));
    copyWith(caseDirectory, target, entries);
    return runIn(target, applications, Depth::beginning);
}

void requireReadableCase(const fs::path& caseDirectory, const fs::path& target,
                         const std::vector<std::vector<OtherEntry>>& sets,
                         const CaseApplications& applications)
{
    std::error_code unwritable;
    {
        const PassingFolder folder(fs::absolute(target));
        fs::create_directories(target, unwritable);
    }
    if (unwritable)
    {
        info("The input of the runs is not checked: {} cannot be written ({}).", target.string(),
             unwritable.message());
        return;
    }
    std::optional<CaseRun> first;
    for (const std::vector<OtherEntry>& entries : sets)
    {
        const CaseRun run = tryCopy(caseDirectory, target, entries, applications);
        if (run.isInterrupted || run.status == 0)
        {
            return;
        }
        first = first ? first : run;
    }
    if (first)
    {
        throw FatalError(
            fmt::format("The case cannot be run, tried with {} of values of its variables: {} ends with exit "
                        "status {}.\n\n{}",
                        sets.size() == 1 ? "a set" : fmt::format("{} sets", sets.size()), first->application,
                        first->status, faultOfCopy(first->errorOutput, target)));
    }
}

} // namespace drystone
