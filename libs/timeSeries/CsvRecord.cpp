// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Reads records as columns of numbers between separators.
#include "core/Error.h"
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

/// Words between blanks, where one that begins with a bracket is the unit of the title before it: `a [m/s2]`.
std::vector<std::string_view> wordsWithUnits(std::string_view line)
{
    std::vector<std::string_view> result;
    for (const std::string_view word : wordsBetween(line, " \t\r"))
    {
        if (!result.empty() && (word.front() == '[' || word.front() == '('))
        {
            const char* begin = result.back().data();
            result.back() = {begin, static_cast<std::size_t>(word.data() + word.size() - begin)};
        }
        else
        {
            result.push_back(word);
        }
    }
    return result;
}

/// Cells of one row. Separators, in order of preference: semicolon, comma, tab, blanks.
std::vector<std::string_view> cells(std::string_view line, char separator)
{
    if (separator == ' ')
    {
        return wordsWithUnits(line);
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

/// The rows of a file, and what its first one says.
struct Table
{
    const RecordText& text;
    std::size_t first = 0; ///< line that is no comment, or the comment with the titles
    std::size_t firstValues = 0;
    char separator = ' ';
    std::size_t width = 0;                ///< columns of the first row that are not empty
    std::vector<std::string_view> titles; ///< none where that has a number and no comment before it has them

    std::string unitOf(std::size_t column) const
    {
        return column < titles.size() ? titleAndUnit(titles[column]).second : "";
    }
};

bool isAnyNumber(const std::vector<std::string_view>& row, char separator)
{
    return std::any_of(row.begin(), row.end(),
                       [&](std::string_view cell)
                       { return numberOf(withDecimalPoint(cell, separator)).has_value(); });
}

/// Whether a cell is known for a title: of times, or by a unit of accelerations.
bool isTitle(std::string_view cell)
{
    return isOfTimes(cell) || accelerationUnit(titleAndUnit(cell).second) > 0;
}

/// Titles that stand in a comment, as numpy.savetxt and tables of Drystone write them, `# t [s]  a [g]`: one
/// for each column, of which one is known for a title. Empty: it has none.
std::vector<std::string_view> titlesInComment(std::string_view line, const Table& table)
{
    line = trimmedCell(line);
    line.remove_prefix(std::min(line.find_first_not_of("#% \t"), line.size()));
    for (const char separator : {table.separator, ',', ';', '\t', ' '})
    {
        const std::vector<std::string_view> titles = cells(line, separator);
        if (titles.size() == table.width && !isAnyNumber(titles, separator)
            && std::any_of(titles.begin(), titles.end(), isTitle))
        {
            return titles;
        }
    }
    return {};
}

Table tableOf(const RecordText& text)
{
    Table table{text, 0, 0, ' ', 0, {}};
    while (table.first < text.lines.size() && skipped(text.lines[table.first]))
    {
        ++table.first;
    }
    if (table.first == text.lines.size())
    {
        text.refuse(0, "The record holds comments only.", "Get a complete copy of it.");
    }
    const std::string_view row = text.lines[table.first];
    for (const char candidate : {'\t', ',', ';'}) // the last one found counts
    {
        table.separator = row.find(candidate) != std::string_view::npos ? candidate : table.separator;
    }
    const std::vector<std::string_view> content = cells(row, table.separator);
    table.width = static_cast<std::size_t>(
        std::count_if(content.begin(), content.end(), [](std::string_view cell) { return !cell.empty(); }));
    table.firstValues = table.first;
    if (!isAnyNumber(content, table.separator))
    {
        table.titles = content;
        ++table.firstValues;
    }
    else
    {
        std::size_t comments = table.first; // lines of them, without the empty ones that follow
        while (comments > 0 && trimmedCell(text.lines[comments - 1]).empty())
        {
            --comments;
        }
        table.titles = comments > 0 ? titlesInComment(text.lines[comments - 1], table) : table.titles;
        table.first = table.titles.empty() ? table.first : comments - 1;
    }
    return table;
}

/// A step that is declared is one, of a file without times.
void refuseTimeStep(const Table& table, double timeStep)
{
    if (!(timeStep > 0 && std::isfinite(timeStep)))
    {
        table.text.refuse(table.first,
                          fmt::format("The declared time step is {} s; a time step is positive.", timeStep),
                          "Correct `timeStep`.");
    }
    const auto times = std::find_if(table.titles.begin(), table.titles.end(), isOfTimes);
    if (times != table.titles.end())
    {
        table.text.refuse(table.first,
                          fmt::format("The column '{}' has the times of this file, and timeStep {} is given.",
                                      *times, timeStep),
                          "Remove `timeStep`.");
    }
}

std::size_t accelerationColumn(const Table& table, const CsvLayout& layout)
{
    if (layout.accelerationColumn)
    {
        return columnIndex(table.text, table.first, *layout.accelerationColumn, table.titles);
    }
    if (layout.timeStep != 0 && table.width > 1)
    {
        table.text.refuse(
            table.first,
            fmt::format(
                "The file has {} columns, and timeStep {} says that none of them has the times: which "
                "of them has the accelerations is not known.",
                table.width, layout.timeStep),
            "Write for instance `accelerationColumn 1;` (counted from 0); or remove `timeStep` where the "
            "first column has the times.");
    }
    return layout.timeStep != 0 ? 0 : 1;
}

/// Where a row has its time and its acceleration, and in which units.
struct Columns
{
    bool hasTimes;
    std::size_t time; ///< where there are times
    std::size_t acceleration;
    double second; ///< the unit of times [s]
    double factor; ///< the unit of accelerations [m/s2]

    std::size_t needed() const { return std::max(hasTimes ? time : 0, acceleration) + 1; }
};

void addRow(const Table& table, std::size_t line, const Columns& columns, double timeStep, Record& record)
{
    const auto row = cells(table.text.lines[line], table.separator);
    if (row.size() < columns.needed())
    {
        table.text.refuse(line,
                          fmt::format("The row has {} columns; column {} (counted from 0) is wanted.",
                                      row.size(), columns.needed() - 1),
                          columns.hasTimes && row.size() == 1
                              ? "Complete the row, or, where the file has accelerations alone, give their "
                                "interval, for instance `timeStep 0.01;`."
                              : "Complete the row, or correct the choice of columns.");
    }
    const auto value = [&](std::size_t column, double unit)
    { return finiteNumber(table.text, line, withDecimalPoint(row[column], table.separator), unit) * unit; };
    const double time = columns.hasTimes ? value(columns.time, columns.second)
                                         : static_cast<double>(record.times.size()) * timeStep;
    if (!record.times.empty() && !(time > record.times.back()))
    {
        table.text.refuse(
            line, fmt::format("The time {} s is not after the one before, {} s.", time, record.times.back()),
            "Times must increase from row to row.");
    }
    record.times.push_back(time);
    record.accelerations.push_back(value(columns.acceleration, columns.factor));
}

/// The unit that a title ends in without saying that it is one, as `acc_g`; empty: none.
/// It is requested and not assumed: a_g is also the symbol of the acceleration of the ground.
std::string unitAtEndOf(std::string_view title)
{
    const std::vector<std::string_view> words = wordsBetween(title, " \t_-.,:");
    const std::string last(words.empty() ? "" : words.back());
    const double unit = accelerationUnit(last);
    return unit > 0 && unit != 1 ? last : "";
}

void questionUnit(const Table& table, std::size_t column, Record& record)
{
    const std::string_view title = column < table.titles.size() ? table.titles[column] : "";
    const std::string unit = unitAtEndOf(title);
    if (!unit.empty())
    {
        record.unitIsQuestioned = true;
        printWarningOnce(
            fmt::format(
                "The column '{}' is read in m/s2, and may be in {}. Say in its title which: `{} [{}]`, "
                "or `{} [m/s2]`; of a record `unit {};` in its dictionary does so too.",
                title, unit, title, unit, title, unit),
            {table.text.file.string(), "", static_cast<int>(table.first) + 1});
    }
}

/// A file that begins as those of the PEER data base do has no columns.
void refusePeerRecord(const RecordText& text)
{
    constexpr std::size_t headerLines = 60;
    for (std::size_t i = 0; i < std::min(text.lines.size(), headerLines); ++i)
    {
        const std::string line = upper(text.lines[i]);
        if (!skipped(line) && line.find("NPTS") != std::string::npos && line.find("DT") != std::string::npos)
        {
            text.refuse(
                i, "This line has NPTS and DT, as a record in the PEER AT2 format, which has no columns.",
                "Write `type record; format PEER_AT2;`.");
        }
    }
}

} // namespace

Record readCsvRecord(const std::filesystem::path& file, const CsvLayout& layout)
{
    RecordText text;
    load(file, text);
    refusePeerRecord(text);
    const Table table = tableOf(text);
    const bool hasTimes = layout.timeStep == 0;
    if (!hasTimes)
    {
        refuseTimeStep(table, layout.timeStep);
    }
    Columns columns{hasTimes, 0, 0, 1, 1};
    columns.time = hasTimes ? columnIndex(text, table.first, layout.timeColumn, table.titles) : 0;
    columns.acceleration = accelerationColumn(table, layout);

    Record record;
    record.file = file;
    record.title = file.filename().string();
    // Numbers of a table without any unit are SI, as all others of a case; what is printed of the record says
    // so.
    const std::string unitFound = table.unitOf(columns.acceleration);
    record.unitIsAssumed = layout.unit.empty() && unitFound.empty();
    record.unit = record.unitIsAssumed ? "m/s2" : settledUnit(text, table.first, layout.unit, unitFound);
    columns.factor = accelerationUnit(record.unit);
    if (record.unitIsAssumed)
    {
        questionUnit(table, columns.acceleration, record);
    }
    const std::string unitOfTimes = hasTimes ? table.unitOf(columns.time) : "";
    columns.second = timeUnit(unitOfTimes);
    if (columns.second == 0)
    {
        text.refuse(table.first,
                    fmt::format("The times are in '{}', which is not a unit of time.", unitOfTimes),
                    "Give them in s, ms, us, min or h.");
    }
    for (std::size_t line = table.firstValues; line < text.lines.size(); ++line)
    {
        if (!skipped(text.lines[line]))
        {
            addRow(table, line, columns, layout.timeStep, record);
        }
    }
    if (record.times.empty())
    {
        text.refuse(table.first, "The record has titles and no values.", "Get a complete copy of it.");
    }
    return record;
}

} // namespace drystone
