// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Reads records as columns of numbers between separators.
#include "timeSeries/Record.h"
#include "timeSeries/RecordText.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>

namespace drystone
{

namespace
{

/// Cells of one row. Separators, in order of preference: semicolon, comma, tab, blanks.
std::vector<std::string_view> cells(std::string_view line, char separator)
{
    if (separator == ' ')
    {
        return wordsBetween(line, " \t\r");
    }
    std::vector<std::string_view> result;
    for (;;)
    {
        const auto length = line.find(separator);
        std::string_view cell = trimmedCell(line.substr(0, length));
        if (cell.size() > 1 && cell.front() == '"' && cell.back() == '"')
        {
            cell = cell.substr(1, cell.size() - 2);
        }
        result.push_back(cell);
        if (length == std::string_view::npos)
        {
            return result;
        }
        line.remove_prefix(length + 1);
    }
}

std::string withDecimalPoint(std::string_view cell, char separator)
{
    std::string result(cell);
    if (separator == ';')
    {
        std::replace(result.begin(), result.end(), ',', '.');
    }
    return result;
}

bool skipped(std::string_view line)
{
    const std::string_view content = trimmedCell(line);
    return content.empty() || content.front() == '#' || content.front() == '%';
}

/// A title without its unit: `acceleration [m/s2]` -> `acceleration`; and that unit.
std::pair<std::string, std::string> titleAndUnit(std::string_view cell)
{
    const auto open = cell.find_first_of("[(");
    if (open == std::string_view::npos)
    {
        return {std::string(cell), ""};
    }
    const auto close = cell.find_first_of("])", open);
    return {std::string(trimmedCell(cell.substr(0, open))),
            std::string(trimmedCell(
                cell.substr(open + 1, close == std::string_view::npos ? close : close - open - 1)))};
}

/// The unit of the times in seconds; 0: none that is known. No unit at all: seconds.
double timeUnit(const std::string& unit)
{
    const std::string plain = upper(unit);
    const auto isOneOf = [&plain](std::initializer_list<std::string_view> names)
    { return std::find(names.begin(), names.end(), plain) != names.end(); };
    if (isOneOf({"", "S", "SEC", "SECS", "SECOND", "SECONDS"}))
    {
        return 1;
    }
    if (isOneOf({"MS", "MSEC", "MILLISECOND", "MILLISECONDS"}))
    {
        return 1e-3;
    }
    if (isOneOf({"US", "MICROSECOND", "MICROSECONDS"}))
    {
        return 1e-6;
    }
    if (isOneOf({"MIN", "MINUTE", "MINUTES"}))
    {
        return 60;
    }
    return isOneOf({"H", "HR", "HOUR", "HOURS"}) ? 3600 : 0;
}

/// Whether a title is that of a column of times.
bool isOfTimes(std::string_view cell)
{
    const auto [title, unit] = titleAndUnit(cell);
    const std::string plain = upper(title);
    return plain == "T" || plain == "TIME" || plain == "TIMES" || (!unit.empty() && timeUnit(unit) > 0);
}

std::size_t columnIndex(const RecordText& text, std::size_t line, const Column& column,
                        const std::vector<std::string_view>& titles)
{
    if (const int* index = std::get_if<int>(&column))
    {
        if (*index < 0)
        {
            text.refuse(line, fmt::format("Column {} does not exist.", *index),
                        "Columns are counted from 0.");
        }
        return static_cast<std::size_t>(*index);
    }
    const std::string& wanted = std::get<std::string>(column);
    std::string list;
    for (std::size_t i = 0; i < titles.size(); ++i)
    {
        if (titles[i] == wanted || titleAndUnit(titles[i]).first == wanted)
        {
            return i;
        }
        list += fmt::format(" {}", titles[i]);
    }
    text.refuse(line, fmt::format("No column is titled '{}'.", wanted),
                titles.empty() ? "The file has no row of titles: give the column's number, counted from 0."
                               : fmt::format("The titles are:{}.", list));
}

} // namespace

Record readCsvRecord(const std::filesystem::path& file, const CsvLayout& layout)
{
    RecordText text;
    load(file, text);

    std::size_t first = 0;
    while (first < text.lines.size() && skipped(text.lines[first]))
    {
        ++first;
    }
    if (first == text.lines.size())
    {
        text.refuse(0, "The record holds comments only.", "Get a complete copy of it.");
    }
    char separator = ' ';
    for (const char candidate : {'\t', ',', ';'})
    { // the last one found counts
        if (text.lines[first].find(candidate) != std::string_view::npos)
        {
            separator = candidate;
        }
    }

    const auto firstCells = cells(text.lines[first], separator);
    const bool titled = std::none_of(firstCells.begin(), firstCells.end(),
                                     [&](std::string_view cell)
                                     { return numberOf(withDecimalPoint(cell, separator)).has_value(); });
    const auto titles = titled ? firstCells : std::vector<std::string_view>{};
    const bool equalSteps = layout.timeStep != 0;
    if (equalSteps && !(layout.timeStep > 0 && std::isfinite(layout.timeStep)))
    {
        text.refuse(first,
                    fmt::format("The declared time step is {} s; a time step is positive.", layout.timeStep),
                    "Correct `timeStep`.");
    }
    if (const auto times = std::find_if(titles.begin(), titles.end(), isOfTimes);
        equalSteps && times != titles.end())
    {
        text.refuse(first,
                    fmt::format("The column '{}' has the times of this file, and timeStep {} is given.",
                                *times, layout.timeStep),
                    "Remove `timeStep`.");
    }
    const std::size_t timeColumn = equalSteps ? 0 : columnIndex(text, first, layout.timeColumn, titles);
    const std::size_t valueColumn = columnIndex(text, first, layout.accelerationColumn, titles);
    const std::string unitFound =
        titled && valueColumn < titles.size() ? titleAndUnit(titles[valueColumn]).second : "";

    Record record;
    record.file = file;
    record.title = file.filename().string();
    // Numbers of a table without any unit are SI, as all others of a case; what is printed of the record says
    // so.
    record.unitIsAssumed = layout.unit.empty() && unitFound.empty();
    record.unit = record.unitIsAssumed ? "m/s2" : settledUnit(text, first, layout.unit, unitFound);
    const double factor = accelerationUnit(record.unit);
    const std::string unitOfTimes =
        !equalSteps && timeColumn < titles.size() ? titleAndUnit(titles[timeColumn]).second : "";
    const double second = timeUnit(unitOfTimes);
    if (second == 0)
    {
        text.refuse(first, fmt::format("The times are in '{}', which is not a unit of time.", unitOfTimes),
                    "Give them in s, ms, us, min or h.");
    }
    const std::size_t needed = std::max(equalSteps ? 0 : timeColumn, valueColumn) + 1;
    for (std::size_t i = titled ? first + 1 : first; i < text.lines.size(); ++i)
    {
        if (skipped(text.lines[i]))
        {
            continue;
        }
        const auto row = cells(text.lines[i], separator);
        if (row.size() < needed)
        {
            text.refuse(i,
                        fmt::format("The row has {} columns; column {} (counted from 0) is wanted.",
                                    row.size(), needed - 1),
                        !equalSteps && row.size() == 1
                            ? "Complete the row, or, where the file has accelerations alone, give their "
                              "interval, for instance `timeStep 0.01;`."
                            : "Complete the row, or correct the choice of columns.");
        }
        const auto value = [&](std::size_t column, double unitFactor = 1)
        { return finiteNumber(text, i, withDecimalPoint(row[column], separator), unitFactor); };
        const double time = equalSteps ? static_cast<double>(record.times.size()) * layout.timeStep
                                       : value(timeColumn, second) * second;
        if (!record.times.empty() && !(time > record.times.back()))
        {
            text.refuse(
                i, fmt::format("The time {} s is not after the one before, {} s.", time, record.times.back()),
                "Times must increase from row to row.");
        }
        record.times.push_back(time);
        record.accelerations.push_back(value(valueColumn, factor) * factor);
    }
    if (record.times.empty())
    {
        text.refuse(first, "The record has titles and no values.", "Get a complete copy of it.");
    }
    return record;
}

} // namespace drystone
