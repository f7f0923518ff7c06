// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Folder, plan and locks of an ensemble.
#include "ensembles/SampleStore.h"

#include "core/WholeFile.h"
#include "ensembles/SharedFile.h"
#include "ensembles/StudyInput.h"
#include "runControl/CaseFiles.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <ctime>
#include <sstream>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace drystone
{

namespace fs = std::filesystem;

namespace
{

/// A lock on one byte of a file for this process. \return 0, or the error
int lockByte(int descriptor, long byte, short type, int command)
{
    struct flock lock = {};
    lock.l_type = type;
    lock.l_whence = SEEK_SET;
    lock.l_start = byte;
    lock.l_len = 1;
    while (::fcntl(descriptor, command, &lock) != 0)
    {
        if (errno != EINTR)
        {
            return errno;
        }
    }
    return 0;
}

/// The lines of a plan that are not of files, by their first words.
std::map<std::string, std::string> questionsIn(const std::string& plan)
{
    std::map<std::string, std::string> lines;
    std::istringstream stream(plan);
    for (std::string line; std::getline(stream, line);)
    {
        const std::string word = line.substr(0, line.find(' '));
        if (word != "input" && word != "case") // as older versions write it
        {
            lines[word] += line;
        }
    }
    return lines;
}

/// Whether a folder has what only samples leave: rows, or attempts that failed.
bool hasSamples(const fs::path& work)
{
    std::error_code error;
    for (fs::directory_iterator file(work, error), end; !error && file != end; file.increment(error))
    {
        const std::string name = file->path().filename().string();
        std::error_code none;
        if ((name == "failures" || name.starts_with("journal.")) && fs::file_size(file->path(), none) > 1
            && !none)
        {
            return true;
        }
    }
    return false;
}

[[noreturn]] void refusePlan(const fs::path& work, const std::string& fault)
{
    throw FatalIOError(
        fmt::format("The plan of the ensemble {}: what the samples in its folder were computed "
                    "from is not known.\n\nRestore the file from a copy to continue. Remove "
                    "postProcessing/ensemble to start again.",
                    fault),
        {(work / "plan").string(), "", 0});
}

} // namespace

std::optional<PlanChange> planChange(const fs::path& work, const std::string& plan)
{
    // Before the plan is looked for: others may write it, and then samples, at any time.
    const bool isBegun = hasSamples(work);
    std::error_code none;
    if (!fs::exists(work / "plan", none))
    {
        if (isBegun)
        {
            refusePlan(work, "is gone");
        }
        return {};
    }
    const std::string before = contentOfFile(work / "plan");
    PlanChange change;
    change.hasInput = hasInputLines(before);
    if (!before.starts_with("case ") && (before.find("\nattempts ") == before.npos || before.back() != '\n'))
    {
        refusePlan(work, "is empty, cut off or something else"); // its last line is missing
    }
    change.input = change.hasInput ? changedInput(before, plan) : "";
    std::map<std::string, std::string> then = questionsIn(before);
    for (const auto& [word, line] : questionsIn(plan))
    {
        if (then[word] != line)
        {
            change.questions += (change.questions.empty() ? "" : ", ")
                                + fmt::format("{} of system/ensembleDict {} changed", word,
                                              word == "design" ? "has" : "have");
        }
    }
    return change;
}

double monotonicTime()
{
    timespec now{};
    clock_gettime(CLOCK_MONOTONIC, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

SampleStore::SampleStore(const fs::path& caseDirectory, const std::string& plan, long samples, long whole)
    : work(ensembleWork(caseDirectory)),
      count(samples),
      chunkSize((std::clamp(samples / 1024, 1L, 256L) + whole - 1) / whole * whole)
{
    std::error_code error;
    fs::create_directories(work, error);
    // One process prepares, the others wait. Where there are no locks, both write the same.
    OpenFile preparing{openFile(work / "lock", O_RDWR)};
    lockByte(preparing.descriptor, 0, F_WRLCK, F_SETLKW);
    if (const std::optional<PlanChange> change = planChange(work, plan))
    {
        std::string text = change->input + (change->input.empty() || change->questions.empty() ? "" : ", ")
                           + change->questions;
        if (!change->hasInput)
        {
            text = "an older version has begun it, which noted its input in another way";
        }
        if (!text.empty())
        {
            throw FatalError(fmt::format(
                "{} belongs to another ensemble, so that it cannot be continued: {}. Restore what "
                "was there to continue. Remove postProcessing/ensemble to start again.",
                work.string(), text));
        }
    }
    else
    {
        writeWholeFile(work / "plan", plan);
    }
    const fs::path chunkName = work / fmt::format("chunks.{}.{}", count, chunkSize);
    chunkFile = openFile(chunkName, O_RDWR);
    ::futimens(chunkFile, nullptr); // the newest is that of the number of samples now, see samplesOrdered
    struct stat status = {};
    ::fstat(chunkFile, &status);
    if (status.st_size < chunks() && ::ftruncate(chunkFile, chunks()) != 0)
    {
        refuseToWrite(chunkName);
    }
}

long samplesOrdered(const fs::path& work)
{
    constexpr std::string_view beginning = "chunks.";
    long count = 0;
    fs::file_time_type newest = fs::file_time_type::min(); // of another number there is a file of its own
    for (const std::string& name : namesIn(work))
    {
        std::error_code gone;
        const fs::file_time_type written = fs::last_write_time(work / name, gone);
        if (name.starts_with(beginning) && !gone && written > newest)
        {
            newest = written;
            count = std::strtol(name.c_str() + beginning.size(), nullptr, 10);
        }
    }
    return count;
}

SampleStore::~SampleStore()
{
    ::close(chunkFile);
}

std::pair<long, long> SampleStore::range(long chunk) const
{
    return {chunk * chunkSize, std::min((chunk + 1) * chunkSize, count)};
}

std::vector<char> SampleStore::completed() const
{
    std::vector<char> bytes(static_cast<std::size_t>(chunks()), 0);
    [[maybe_unused]] const ssize_t read = ::pread(chunkFile, bytes.data(), bytes.size(), 0);
    return bytes;
}

SampleStore::Claim SampleStore::claim(long chunk)
{
    const int error = lockByte(chunkFile, chunk, F_WRLCK, F_SETLK);
    if (error == EACCES || error == EAGAIN)
    {
        return Claim::refused;
    }
    // Completed by another process since we looked?
    char byte = 0;
    if (::pread(chunkFile, &byte, 1, chunk) == 1 && byte != 0)
    {
        release(chunk);
        return Claim::refused;
    }
    return error == 0 ? Claim::taken : Claim::noLocks;
}

void SampleStore::release(long chunk)
{
    lockByte(chunkFile, chunk, F_UNLCK, F_SETLK);
}

void SampleStore::mark(long chunk, char state)
{
    if (::pwrite(chunkFile, &state, 1, chunk) != 1)
    {
        refuseToWrite(work / "chunks");
    }
}

void SampleStore::complete(long chunk)
{
    mark(chunk, 1);
    release(chunk);
}

void SampleStore::reopen(long chunk)
{
    mark(chunk, 0);
}

} // namespace drystone
