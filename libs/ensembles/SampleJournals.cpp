// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Journals of samples and of attempts that failed: rows with fingerprints, and marks of the plan.
#include "core/WholeFile.h"
#include "dictionary/Fingerprint.h"
#include "ensembles/FingerprintedRow.h"
#include "ensembles/SampleStore.h"
#include "ensembles/SharedFile.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <limits>

#include <fcntl.h>
#include <unistd.h>

namespace drystone
{

namespace fs = std::filesystem;

namespace
{

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

} // namespace

Journal::Journal(const fs::path& path) : file(path), descriptor(openFile(path, O_WRONLY | O_APPEND))
{
    // After a worker that was ended in the middle of a row.
    pending = fmt::format("\n{}", planMark(file.parent_path()));
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
        refuseToWrite(file);
    }
}

namespace
{

/// Takes the rows of one journal. \param plan the mark of those that count; empty: all do
void takeRows(const fs::path& file, const std::string& plan, std::size_t results,
              std::map<long, SampleRow>& rows, std::vector<Doubt>* doubts)
{
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

} // namespace

void readJournal(const fs::path& file, std::size_t results, std::map<long, SampleRow>& rows,
                 std::vector<Doubt>* doubts)
{
    takeRows(file, planMark(file.parent_path()), results, rows, doubts);
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
    const std::string plan = planMark(work);
    for (const fs::path& file : files)
    {
        takeRows(file, plan, results, rows, doubts);
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
