// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Reads histories of studies, and says what is wrong with one that is damaged.
#include "ensembles/StudyHistory.h"

#include "ensembles/FingerprintedRow.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <fstream>
#include <iterator>
#include <optional>
#include <sstream>

namespace drystone
{
namespace
{

namespace fs = std::filesystem;

/// \return nothing where there is no such file
std::optional<std::string> textOfHistory(const fs::path& file)
{
    std::error_code error;
    const fs::file_status status = fs::status(file, error);
    if (!fs::exists(status))
    {
        return {};
    }
    if (!fs::is_regular_file(status))
    {
        throw FatalError(fmt::format("Cannot write {}: it is {} and no file. Move it away.", file.string(),
                                     fs::is_directory(status) ? "a folder" : "something else"));
    }
    errno = 0;
    std::ifstream stream(file, std::ios::binary);
    if (!stream)
    {
        throw FatalError(fmt::format("Cannot read {}: {}. What it has is known already: let it be read "
                                     "(chmod +r), or move it away to start again.",
                                     file.string(), std::strerror(errno)));
    }
    return std::string{std::istreambuf_iterator<char>(stream), {}};
}

/// What is wrong with a file that has another heading; empty: it is the history of other input.
std::string damageOf(const std::string& text, const std::string& heading)
{
    if (text.empty())
    {
        return "it is empty";
    }
    if (!text.starts_with("# ") || text.find('\0') != text.npos)
    {
        return "it does not begin with the heading of a history";
    }
    std::size_t row = 0; // where the rows begin: a history is written with one or more
    while (row < text.size() && text[row] == '#')
    {
        row = std::min(text.find('\n', row), text.size() - 1) + 1;
    }
    return row == text.size() || heading.starts_with(text) ? "it is cut off before its first row" : "";
}

std::string changeOf(const std::string& text, const fs::path& file, const std::string& heading,
                     const std::string& study)
{
    if (text.starts_with(heading))
    {
        return "";
    }
    if (const std::string damage = damageOf(text, heading); !damage.empty())
    {
        throw FatalIOError(fmt::format("The history is damaged: {}.\n\nRestore it from a copy to continue. "
                                       "Remove postProcessing/{} to start again.",
                                       damage, study),
                           {file.string(), "", 1});
    }
    if (!hasInputLines(text, "# ") && hasInputLines(heading, "# "))
    {
        return "an older version has begun it, which noted its input in another way";
    }
    const std::string changes = changedInput(text, heading, "# ");
    return changes.empty() ? fmt::format("what system/{}Dict requests of a run has changed", study) : changes;
}

/// The names of the columns: the last line of a heading.
std::vector<std::string> columnsOf(const std::string& heading)
{
    std::istringstream words(heading.substr(heading.find_last_of('#') + 1));
    return {std::istream_iterator<std::string>(words), {}};
}

[[noreturn]] void refuseCutRow(const std::string& study, const SourceLocation& place)
{
    throw FatalIOError(
        fmt::format("The history is cut off in its last row, which has no end of line: its last "
                    "number may lack digits.\n\nRemove the row, or postProcessing/{} to start "
                    "again.",
                    study),
        place);
}

[[noreturn]] void refuseChangedRow(const std::string& study, const SourceLocation& place)
{
    throw FatalIOError(
        fmt::format("A row of the history is not what was written there.\n\nRemove the row, to "
                    "compute it again, or postProcessing/{} to start again.",
                    study),
        place);
}

/// Of a row that is what was written, but not by this study.
[[noreturn]] void refuseOtherRow(std::size_t numbers, const std::string& study, const SourceLocation& place)
{
    throw FatalIOError(fmt::format("A row of the history has {} numbers and not something else.\n\n"
                                   "Remove the row, or postProcessing/{} to start again.",
                                   numbers, study),
                       place);
}

void requireSameHistory(const std::string& text, const fs::path& file, const std::string& heading,
                        const std::string& study)
{
    if (const std::string change = changeOf(text, file, heading, study); !change.empty())
    {
        throw FatalError(fmt::format("{} belongs to another {}, so that it cannot be continued: {}. Restore "
                                     "what was there to continue. Remove postProcessing/{} to start again.",
                                     file.string(), study, change, study));
    }
}

/// The numbers of a line; nothing where it is not what the mark above it is of. \param mark its fingerprint;
/// empty: within the line, or it has none
std::optional<std::string> asWritten(const std::string& line, const std::string& mark)
{
    return withoutFingerprint(mark.empty() ? line
                                           : line.substr(0, line.find_last_not_of(" \t\r") + 1) + " " + mark);
}

} // namespace

std::string historyInput(const std::vector<InputFile>& files)
{
    return inputLines(files, "# ");
}

std::string historyRow(const std::string& numbers)
{
    const std::string row = withFingerprint(numbers);
    return row.substr(numbers.size() + 1) + "\n" + numbers + "\n";
}

void HistoryRow::refuse(std::size_t column, const std::string& wanted) const
{
    const std::string place = fmt::format("olumn {} of a row of the history", column + 1);
    const std::string name = from->columns.size() == values.size()
                                 ? fmt::format("{}, c{},", from->columns[column], place)
                                 : "C" + place;
    throw FatalIOError(fmt::format("{} is {}: it takes {}.\n\nRepair or remove the row, or remove "
                                   "postProcessing/{} to start again.",
                                   name, values[column], wanted, from->study),
                       {from->name, "", line});
}

double HistoryRow::finite(std::size_t column, double least) const
{
    if (!std::isfinite(values[column]) || values[column] < least)
    {
        refuse(column, least == std::numeric_limits<double>::lowest()
                           ? "finite numbers"
                           : fmt::format("finite numbers from {}", least));
    }
    return values[column];
}

long HistoryRow::whole(std::size_t column, long least, long most) const
{
    const double value = values[column];
    if (!(value >= static_cast<double>(least) && value <= static_cast<double>(most))
        || value != std::floor(value))
    {
        refuse(column, fmt::format("whole numbers from {} to {}", least, most));
    }
    return static_cast<long>(value);
}

std::string changedHistory(const fs::path& file, const std::string& heading, const std::string& study)
{
    const std::optional<std::string> text = textOfHistory(file);
    return text ? changeOf(*text, file, heading, study) : "";
}

void readHistory(const fs::path& file, const std::string& heading, std::size_t numbers,
                 const std::string& study, const TakeHistoryRow& take)
{
    const std::optional<std::string> text = textOfHistory(file);
    if (!text)
    {
        return;
    }
    requireSameHistory(*text, file, heading, study);
    const auto from =
        std::make_shared<const HistoryFile>(HistoryFile{file.string(), study, columnsOf(heading)});
    std::istringstream lines(text->substr(heading.size()));
    SourceLocation place{file.string(), "",
                         static_cast<int>(std::count(heading.begin(), heading.end(), '\n'))};
    SourceLocation above; // the fingerprint of the row
    std::string mark;
    for (std::string line; std::getline(lines, line);)
    {
        ++place.line;
        if (line.starts_with('#') && mark.empty() && !lines.eof())
        {
            mark = line;
            above = place;
            continue;
        }
        const std::optional<std::string> written = asWritten(line, mark);
        const SourceLocation begin = mark.empty() ? place : above;
        mark.clear();
        if (!written && lines.eof())
        {
            refuseCutRow(study, begin);
        }
        std::vector<double> row = numbersOf(written.value_or(line));
        const bool isWhole = row.size() == numbers;
        if (written && !isWhole)
        {
            refuseOtherRow(numbers, study, place);
        }
        if (lines.eof())
        {
            refuseCutRow(study, begin);
        }
        if (isWhole)
        {
            take(HistoryRow(from, place.line, std::move(row)));
        }
        if (!written)
        {
            refuseChangedRow(study, begin);
        }
    }
    if (!mark.empty())
    {
        refuseChangedRow(study, above);
    }
}

std::vector<HistoryRow> readHistory(const fs::path& file, const std::string& heading, std::size_t numbers,
                                    const std::string& study)
{
    std::vector<HistoryRow> rows;
    readHistory(file, heading, numbers, study, [&rows](const HistoryRow& row) { rows.push_back(row); });
    return rows;
}

} // namespace drystone
