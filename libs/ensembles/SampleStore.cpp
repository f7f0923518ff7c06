// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Files, locks and journals of an ensemble.
#include "ensembles/SampleStore.h"

#include "core/WholeFile.h"
#include "dictionary/Fingerprint.h"
#include "ensembles/FingerprintedRow.h"
#include "ensembles/StudyInput.h"
#include "runControl/CaseFiles.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <fstream>
#include <iterator>
#include <limits>
#include <sstream>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace drystone
{

namespace fs = std::filesystem;

namespace
{

[[noreturn]] void refuse(const fs::path& file)
{
    throw FatalError(fmt::format("Cannot write {}: {}.", file.string(), std::strerror(errno)));
}

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

void writeAll(int descriptor, std::string_view text, const fs::path& file)
{
    while (!text.empty())
    {
        const ssize_t written = ::write(descriptor, text.data(), text.size());
        if (written < 0 && errno != EINTR)
        {
            refuse(file);
        }
        text.remove_prefix(static_cast<std::size_t>(std::max<ssize_t>(written, 0)));
    }
}

int openFile(const fs::path& file, int flags)
{
    const int descriptor = ::open(file.c_str(), flags | O_CREAT | O_CLOEXEC, 0666);
    if (descriptor < 0)
    {
        refuse(file);
    }
    return descriptor;
}

/// Closes what it holds.
struct OpenFile
{
    int descriptor = -1;
    ~OpenFile() { ::close(descriptor); }
};

constexpr std::string_view rowEnd = " ;";

/// Whether a line of a journal was written to its end.
bool isWholeRow(const std::string& line)
{
    return line.ends_with(rowEnd);
}

/// Whether a number of a file is a whole one that a long has: without rounding in a double.
bool isWhole(double number, double least, double most)
{
    return number >= least && number <= most && number == std::floor(number);
}

/// A row of a journal with the number of its sample; nothing where it is damaged.
std::optional<std::pair<long, SampleRow>> rowOf(const std::string& line, std::size_t results)
{
    const auto text = withoutFingerprint(line.substr(0, line.size() - rowEnd.size()));
    const std::vector<double> numbers = numbersOf(text.value_or(""));
    if (numbers.size() != 4 + results || !isWhole(numbers[0], 0, 0x1p53)
        || !isWhole(numbers[1], 0, sampleStatuses - 1)
        || !isWhole(numbers[2], 0, std::numeric_limits<int>::max()))
    {
        return {};
    }
    return std::pair{static_cast<long>(numbers[0]),
                     SampleRow{static_cast<SampleStatus>(static_cast<int>(numbers[1])),
                               static_cast<int>(numbers[2]),
                               numbers[3],
                               {numbers.begin() + 4, numbers.end()}}};
}

/// Whether two computations of one sample cannot both be right. One may have ended for want of time.
bool contradict(const SampleRow& one, const SampleRow& other)
{
    const auto isSame = [](double a, double b) { return a == b || (std::isnan(a) && std::isnan(b)); };
    return one.status == SampleStatus::done && other.status == SampleStatus::done
           && !std::equal(one.results.begin(), one.results.end(), other.results.begin(), isSame);
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

constexpr std::string_view planBeginning = "# plan ";

/// The line of a journal that says of which plan its rows are; empty where the folder has none.
std::string planMark(const fs::path& work)
{
    const std::string plan = contentOfFile(work / "plan");
    return plan.empty() ? "" : fmt::format("{}{:016x}\n", planBeginning, fingerprint(plan));
}

/// Rows of a journal that are left out for one reason.
struct LeftOut
{
    int rows = 0;
    int first = 0; ///< its line

    void add(int line) { first = rows++ == 0 ? line : first; }
    /// \param what they are
    void question(std::vector<Doubt>* doubts, const fs::path& file, const std::string& what) const
    {
        if (doubts && rows > 0)
        {
            doubts->push_back(
                {fmt::format(
                     "{} row{} of this journal {} {}: not used, and computed again where no other row "
                     "has the sample. Remove {} to end this warning.",
                     rows, rows == 1 ? "" : "s", rows == 1 ? "is" : "are", what, rows == 1 ? "it" : "them"),
                 {file.string(), "", first}});
        }
    }
};

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
        refuse(chunkName);
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
    if (error != 0)
    {
        return Claim::noLocks;
    }
    // Completed by another process since we looked?
    char byte = 0;
    if (::pread(chunkFile, &byte, 1, chunk) == 1 && byte != 0)
    {
        release(chunk);
        return Claim::refused;
    }
    return Claim::taken;
}

void SampleStore::release(long chunk)
{
    lockByte(chunkFile, chunk, F_UNLCK, F_SETLK);
}

void SampleStore::mark(long chunk, char state)
{
    if (::pwrite(chunkFile, &state, 1, chunk) != 1)
    {
        refuse(work / "chunks");
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

Journal::Journal(const fs::path& path) : file(path), descriptor(openFile(path, O_WRONLY | O_APPEND))
{
    // After a worker that was ended in the middle of a row.
    pending = "\n" + planMark(file.parent_path());
}

Journal::~Journal()
{
    ::close(descriptor);
}

void Journal::add(long sample, const SampleRow& row)
{
    // The fewest digits that read back as the same number.
    std::string text =
        fmt::format("{} {} {} {:.3g}", sample, static_cast<int>(row.status), row.attempts, row.cpuTime);
    for (const double result : row.results)
    {
        text += fmt::format(" {}", result);
    }
    pending += fmt::format("{}{}\n", withFingerprint(text), rowEnd);
    if (monotonicTime() - lastFlush > 0.1)
    {
        flush();
    }
}

void Journal::flush()
{
    writeAll(descriptor, pending, file);
    pending.clear();
    lastFlush = monotonicTime();
}

void Journal::sync()
{
    flush();
    if (::fdatasync(descriptor) != 0 && errno != EINVAL && errno != EROFS)
    {
        refuse(file);
    }
}

void readJournal(const fs::path& file, std::size_t results, std::map<long, SampleRow>& rows,
                 std::vector<Doubt>* doubts)
{
    const std::string plan = planMark(file.parent_path());
    bool isOfPlan = true;
    LeftOut damaged;
    LeftOut ofOthers;
    int number = 0;
    std::ifstream stream(file);
    for (std::string line; std::getline(stream, line);)
    {
        ++number;
        if (line.starts_with(planBeginning))
        {
            isOfPlan = plan.empty() || line + "\n" == plan;
        }
        if (!isWholeRow(line))
        {
            continue;
        }
        const auto row = rowOf(line, results);
        if (!row || !isOfPlan)
        {
            (isOfPlan ? damaged : ofOthers).add(number);
            continue;
        }
        const auto [known, isNew] = rows.insert(*row);
        if (doubts && !isNew && contradict(known->second, row->second))
        {
            doubts->push_back(
                {fmt::format(
                     "Sample {} has other results in this row than in one before, which counts. Remove "
                     "the wrong one: `grep '^{} ' {}/journal.*` shows both.",
                     row->first, row->first, file.parent_path().string()),
                 {file.string(), "", number}});
        }
    }
    damaged.question(doubts, file, "not what was written there, this is the first");
    ofOthers.question(doubts, file,
                      "of another ensemble, the plan of which is not that of this folder, this is the first");
}

std::map<long, SampleRow> readJournals(const fs::path& work, std::size_t results, std::vector<Doubt>* doubts)
{
    std::map<long, SampleRow> rows;
    std::vector<fs::path> files;
    std::error_code error;
    for (fs::directory_iterator file(work, error), end; !error && file != end; file.increment(error))
    {
        if (file->path().filename().string().starts_with("journal."))
        {
            files.push_back(file->path());
        }
    }
    std::sort(files.begin(), files.end());
    for (const fs::path& file : files)
    {
        readJournal(file, results, rows, doubts);
    }
    return rows;
}

void addFailure(const fs::path& work, const FailedAttempt& attempt)
{
    std::string message = attempt.message.substr(0, 300);
    std::replace(message.begin(), message.end(), '\n', ' ');
    const fs::path file = work / "failures";
    const OpenFile opened{openFile(file, O_WRONLY | O_APPEND)};
    writeAll(opened.descriptor,
             fmt::format("{} {} {} {}\n", attempt.sample, static_cast<int>(attempt.status),
                         attempt.isFromOutside ? 1 : 0, message),
             file);
}

std::vector<FailedAttempt> readFailures(const fs::path& work)
{
    std::vector<FailedAttempt> attempts;
    std::ifstream stream(work / "failures");
    for (std::string line; std::getline(stream, line);)
    {
        FailedAttempt attempt;
        int status = 0;
        int isFromOutside = 0;
        int end = 0;
        if (std::sscanf(line.c_str(), "%ld %d %d %n", &attempt.sample, &status, &isFromOutside, &end)
                == 3 // NOLINT
            && status >= 0 && status < sampleStatuses)
        {
            attempt.status = static_cast<SampleStatus>(status);
            attempt.isFromOutside = isFromOutside != 0;
            attempt.message = line.substr(static_cast<std::size_t>(end));
            attempts.push_back(std::move(attempt));
        }
    }
    return attempts;
}

} // namespace drystone
