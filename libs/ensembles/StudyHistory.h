// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The histories of studies: what they have computed, a row each, behind a heading that says from what.
/// Whoever edits one, or a disk that was full, may have left anything in it.
#pragma once

#include "core/Error.h"
#include "ensembles/StudyInput.h"

#include <filesystem>
#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <vector>

namespace drystone
{

/// Lines of a heading that say from which input the rows of a study follow (StudyInput.h).
std::string historyInput(const std::vector<InputFile>& files);

/// Where a row is from, and what its columns are.
struct HistoryFile
{
    std::string name;
    std::string study;                ///< name of its folder in postProcessing
    std::vector<std::string> columns; ///< as the last line of the heading has them
};

/// A row of a history: each number is checked as it is taken. All throw FatalIOError with file, line, column
/// and what the column takes.
class HistoryRow
{
public:
    HistoryRow(std::shared_ptr<const HistoryFile> file, int lineNumber, std::vector<double> numbers)
        : from(std::move(file)), line(lineNumber), values(std::move(numbers))
    {
    }

    /// Any number, nan among them.
    double number(std::size_t column) const { return values[column]; }
    /// A finite number, at least as large.
    double finite(std::size_t column, double least = std::numeric_limits<double>::lowest()) const;
    /// A whole number: without rounding, and within the bounds, both included.
    long whole(std::size_t column, long least, long most = 1L << 53) const;
    int wholeInt(std::size_t column, int least, int most = std::numeric_limits<int>::max()) const
    {
        return static_cast<int>(whole(column, least, most));
    }
    /// An enumerator, of as many as `namesOf` has.
    template<class Choice>
    Choice choice(std::size_t column) const
    {
        return Choice{wholeInt(column, 0, static_cast<int>(namesOf(Choice{}).size()) - 1)};
    }
    [[noreturn]] void refuse(std::size_t column, const std::string& wanted) const;

private:
    std::shared_ptr<const HistoryFile> from;
    int line;
    std::vector<double> values;
};

/// A row to be written: its numbers, below a comment that shows whether they have been changed since, so that
/// a table has its columns alone.
std::string historyRow(const std::string& numbers);

/// Why a history is not continued: `constant/g has changed`. Empty: it has the heading, or there is none.
/// \param heading comment lines that identify what the rows depend on, files as `historyInput` has them; the
/// last names the columns
/// \param study name of its folder in postProcessing, for messages
/// \throws FatalError when it cannot be read, or is none: empty, cut off in its heading, or something else
std::string changedHistory(const std::filesystem::path& file, const std::string& heading,
                           const std::string& study);

/// Takes a row, or refuses it: a number that a column does not take is named before it is said that the row
/// has been changed.
using TakeHistoryRow = std::function<void(const HistoryRow&)>;

/// The rows that an interrupted study has written. Those from `historyRow` are compared with what was
/// written, others have their numbers only. \param numbers in a row \return nothing when there is no such
/// file \throws FatalError as `changedHistory`, and when the heading differs, naming what has changed, or a
/// row is not of so many numbers, or has been changed
void readHistory(const std::filesystem::path& file, const std::string& heading, std::size_t numbers,
                 const std::string& study, const TakeHistoryRow& take);
std::vector<HistoryRow> readHistory(const std::filesystem::path& file, const std::string& heading,
                                    std::size_t numbers, const std::string& study);

} // namespace drystone
