// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Readers of PEER AT2 and CSV records. Both refuse what they do not understand: a record that is quietly
/// half read gives a quietly wrong answer.
#include "core/Error.h"
#include "timeSeries/Record.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <optional>
#include <sstream>
#include <string_view>

namespace drystone
{

namespace
{

/// A record's file, cut into lines.
struct Text
{
    std::filesystem::path file;
    std::string content;
    std::vector<std::string_view> lines; ///< views into `content`, without line ends

    [[noreturn]] void refuse(std::size_t line, const std::string& what, const std::string& repair) const
    {
        throw FatalIOError(what + " " + repair, {file.string(), "", static_cast<int>(line) + 1});
    }
};

std::string upper(std::string_view text)
{
    std::string result(text);
    for (char& c : result)
    {
        if (c >= 'a' && c <= 'z')
        {
            c = static_cast<char>(c - 'a' + 'A');
        }
    }
    return result;
}

std::string_view trimmed(std::string_view text)
{
    const auto first = text.find_first_not_of(" \t\r\f\v");
    if (first == std::string_view::npos)
    {
        return {};
    }
    return text.substr(first, text.find_last_not_of(" \t\r\f\v") - first + 1);
}

/// \post all lines are views into text.content, so `text` must not be copied: fill it in place
void load(const std::filesystem::path& file, Text& text)
{
    text.file = file;
    std::error_code error;
    const auto status = std::filesystem::status(file, error);
    if (std::filesystem::is_directory(status))
    {
        text.refuse(0, "The record is a directory.", "Name a file in it.");
    }
    if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status))
    {
        text.refuse(0, "The record is not an ordinary file.",
                    "A device or a pipe may never end: name a file.");
    }
    std::ifstream stream(file, std::ios::binary);
    if (!stream)
    {
        text.refuse(0, "Cannot open the record.",
                    "Check the name, which is relative to the case directory, and the right to read it.");
    }
    std::ostringstream buffer;
    buffer << stream.rdbuf();
    text.content = std::move(buffer).str();

    // Rows end in LF, CR LF or (files that went twice through a mailer) CR CR LF: CR is blank space then. A
    // file with CR alone comes from an old Macintosh.
    const char end = text.content.find('\n') == std::string::npos ? '\r' : '\n';
    std::string_view rest = text.content;
    while (!rest.empty())
    {
        const auto length = rest.find(end);
        text.lines.push_back(rest.substr(0, length));
        rest.remove_prefix(length == std::string_view::npos ? rest.size() : length + 1);
    }
    for (std::size_t i = 0; i < text.lines.size(); ++i)
    {
        for (const char c : text.lines[i])
        {
            if (const auto code = static_cast<unsigned char>(c);
                code < ' ' && !(code >= '\t' && code <= '\r'))
            {
                text.refuse(
                    i, fmt::format("The record holds the control character {:#04x}: it is not text.", code),
                    "Convert it to a text format, PEER_AT2 or csv.");
            }
        }
    }
    const bool blank = std::all_of(text.lines.begin(), text.lines.end(),
                                   [](std::string_view line) { return trimmed(line).empty(); });
    if (blank)
    {
        text.refuse(0, "The record is empty.", "Get a complete copy of it.");
    }
}

/// The whole token as a number: plain, with a + sign, or with Fortran's D for the exponent.
std::optional<double> number(std::string_view token)
{
    std::string plain(token.substr(token.starts_with('+') ? 1 : 0));
    for (char& c : plain)
    {
        if (c == 'D' || c == 'd')
        {
            c = 'e';
        }
    }
    double value = 0;
    const auto [end, code] = std::from_chars(plain.data(), plain.data() + plain.size(), value);
    if (plain.empty() || end != plain.data() + plain.size())
    {
        return std::nullopt;
    }
    if (code == std::errc::result_out_of_range)
    { // 1e-400 is zero; 1e400 is infinite, which the caller refuses
        return plain.find("e-") != std::string::npos ? 0.0 : HUGE_VAL;
    }
    return code == std::errc() ? std::optional(value) : std::nullopt;
}

/// A number that is finite, also times a factor, or a refusal that names it.
double finiteNumber(const Text& text, std::size_t line, std::string_view token, double factor = 1)
{
    const std::optional<double> value = number(token);
    if (!value)
    {
        text.refuse(line, fmt::format("'{}' is not a number.", token.substr(0, 40)),
                    "Correct it, or get a complete copy of the record.");
    }
    if (!std::isfinite(*value * factor))
    {
        text.refuse(line, fmt::format("The value {} is not a finite number.", token),
                    "Correct it, or get a complete copy of the record.");
    }
    return *value;
}

std::vector<std::string_view> words(std::string_view line, std::string_view separators)
{
    std::vector<std::string_view> result;
    for (;;)
    {
        const auto first = line.find_first_not_of(separators);
        if (first == std::string_view::npos)
        {
            return result;
        }
        line.remove_prefix(first);
        const auto length = line.find_first_of(separators);
        result.push_back(line.substr(0, length));
        line.remove_prefix(result.back().size());
    }
}

constexpr std::string_view knownUnits = "g, m/s2, cm/s2, gal, mm/s2, ft/s2 or in/s2";

/// The unit to read with, from what the user declares and what the file says at a line.
std::string settledUnit(const Text& text, std::size_t line, const std::string& declared,
                        const std::string& found)
{
    if (!declared.empty() && accelerationUnit(declared) == 0)
    {
        text.refuse(line, fmt::format("'{}' is not a unit of acceleration that Drystone knows.", declared),
                    fmt::format("Declare the unit as {}.", knownUnits));
    }
    if (!found.empty() && accelerationUnit(found) == 0)
    {
        text.refuse(line, fmt::format("The record is in '{}', which is not a unit of acceleration.", found),
                    fmt::format("Use an acceleration record in {}.", knownUnits));
    }
    if (declared.empty() && found.empty())
    {
        text.refuse(line, "The record does not say its unit.",
                    fmt::format("Declare `unit`: {}.", knownUnits));
    }
    if (!declared.empty() && !found.empty() && accelerationUnit(declared) != accelerationUnit(found))
    {
        text.refuse(line,
                    fmt::format("The record says it is in {}, and unit {} is declared.", found, declared),
                    "Remove `unit`, or correct the record.");
    }
    return found.empty() ? declared : found;
}

/// The unit in a header line such as `ACCELERATION TIME HISTORY IN UNITS OF G. FILTER POINTS: ..` or
/// `The units are (g)`; empty when the line names none.
std::string unitInHeader(std::string_view line)
{
    const std::string text = upper(line);
    bool announced = false;
    for (const std::string_view word : words(text, " \t\r:=(),;[]"))
    {
        if (word == "UNIT" || word == "UNITS")
        {
            announced = true;
        }
        else if (announced && word != "OF" && word != "ARE" && word != "IS" && word != "IN")
        {
            return std::string(word.substr(0, word.find_last_not_of('.') + 1));
        }
    }
    return "";
}

struct PeerHeader
{
    std::size_t line = 0; ///< the one that completes it: the values follow
    double count = 0;     ///< NPTS
    double timeStep = 0;  ///< DT [s]
};

/// The number after a keyword, as in `NPTS=  4000,` `DT= .0050SEC` `DT (sec) : 0.01`.
std::optional<double> numberAfter(std::string_view line, std::string_view keyword)
{
    const auto place = line.find(keyword);
    if (place == std::string_view::npos)
    {
        return std::nullopt;
    }
    std::string_view rest = line.substr(place + keyword.size());
    rest.remove_prefix(std::min(rest.find_first_not_of(" \t=:"), rest.size()));
    if (rest.starts_with('('))
    {
        rest.remove_prefix(std::min(rest.find(')') + 1, rest.size()));
    }
    rest.remove_prefix(std::min(rest.find_first_not_of(" \t=:"), rest.size()));
    std::string_view token = rest.substr(0, rest.find_first_of(" \t\r,;"));
    if (token.size() > 1 && token.ends_with("SEC"))
    {
        token.remove_suffix(3);
    }
    return number(token);
}

PeerHeader peerHeader(const Text& text)
{
    PeerHeader header;
    std::optional<double> count;
    std::optional<double> timeStep;
    for (std::size_t i = 0; i < text.lines.size() && i < 60 && !(count && timeStep); ++i)
    {
        const std::string line = upper(text.lines[i]);
        if (count && i > header.line + 1)
        { // DT stands beside NPTS or in the next line
            break;
        }
        if (!count && line.find("NPTS") == std::string::npos)
        {
            continue;
        }
        const bool countBefore = count.has_value();
        if (!count)
        {
            count = numberAfter(line, "NPTS");
        }
        timeStep = numberAfter(line, "DT");
        if (!count && !timeStep) // the oldest form: `4000    0.0100    NPTS, DT`
        {
            const auto tokens = words(line, " \t\r,");
            if (tokens.size() >= 4 && tokens[2] == "NPTS" && tokens[3] == "DT")
            {
                count = number(tokens[0]);
                timeStep = number(tokens[1]);
            }
        }
        if (!countBefore || timeStep)
        {
            header.line = i;
        }
        if (!count)
        {
            text.refuse(i, "The number of values does not follow NPTS.",
                        "It should read as in NPTS= 4000, DT= .01 SEC.");
        }
    }
    if (!count)
    {
        text.refuse(0, "No line gives NPTS, so this is not a record in the PEER AT2 format.",
                    "Choose format csv for columns of numbers.");
    }
    if (!timeStep)
    {
        text.refuse(header.line, "The time step does not follow DT.",
                    "It should read as in NPTS= 4000, DT= .01 SEC.");
    }
    if (!(*count >= 1 && *count <= 1e9 && *count == std::floor(*count)))
    {
        text.refuse(header.line, fmt::format("NPTS is {}, not a number of values.", *count), "Correct it.");
    }
    if (!(*timeStep > 0 && std::isfinite(*count * *timeStep)))
    {
        text.refuse(header.line,
                    fmt::format("DT is {} s; a time step is positive, and the record finite.", *timeStep),
                    "Correct it.");
    }
    header.count = *count;
    header.timeStep = *timeStep;
    return header;
}

} // namespace

double accelerationUnit(const std::string& unit)
{
    // one spelling for all: `CM/SEC/SEC`, `cm/sec**2`, `cm/s^2` -> `CM/S2`
    std::string plain;
    for (const char c : upper(unit))
    {
        if (c != ' ' && c != '^' && c != '*')
        {
            plain += c;
        }
    }
    for (auto place = plain.find("SEC"); place != std::string::npos; place = plain.find("SEC"))
    {
        plain.erase(place + 1, 2);
    }
    if (plain.ends_with("/S/S"))
    {
        plain = plain.substr(0, plain.size() - 4) + "/S2";
    }

    if (plain == "G")
    {
        return standardGravity;
    }
    if (plain == "M/S2")
    {
        return 1;
    }
    if (plain == "CM/S2" || plain == "GAL" || plain == "GALS")
    {
        return 0.01;
    }
    if (plain == "MM/S2")
    {
        return 0.001;
    }
    if (plain == "FT/S2")
    {
        return 0.3048;
    }
    if (plain == "IN/S2")
    {
        return 0.0254;
    }
    return 0;
}

Record readPeerRecord(const std::filesystem::path& file, const std::string& unit)
{
    Text text;
    load(file, text);
    const PeerHeader header = peerHeader(text);

    std::size_t unitLine = header.line;
    std::string unitFound;
    for (std::size_t i = 0; i <= header.line && unitFound.empty(); ++i)
    {
        unitFound = unitInHeader(text.lines[i]);
        if (!unitFound.empty())
        {
            unitLine = i;
        }
    }

    Record record;
    record.file = file;
    record.unit = settledUnit(text, unitLine, unit, unitFound);
    // The first line names the data base in PEER's own files; the second one the event. Others begin with the
    // event.
    const bool banner = header.line > 1
                        && (upper(text.lines[0]).find("STRONG MOTION DATA") != std::string::npos
                            || upper(text.lines[0]).find("STRONG-MOTION DATA") != std::string::npos);
    record.title = trimmed(text.lines[header.line == 0 ? 0 : banner ? 1 : 0]);

    const auto count = static_cast<std::size_t>(header.count);
    const double factor = accelerationUnit(record.unit);
    std::size_t last = header.line;
    for (std::size_t i = header.line + 1; i < text.lines.size(); ++i)
    {
        for (const std::string_view token : words(text.lines[i], " \t\r\f\v,"))
        {
            last = i;
            const double value = finiteNumber(text, i, token, factor);
            if (record.accelerations.size() == count)
            {
                text.refuse(i, fmt::format("More values than NPTS = {}.", count),
                            fmt::format("Correct NPTS in line {}, or remove the surplus.", header.line + 1));
            }
            record.times.push_back(static_cast<double>(record.times.size()) * header.timeStep);
            record.accelerations.push_back(value * factor);
        }
    }
    if (record.accelerations.size() < count)
    {
        text.refuse(
            last,
            fmt::format("The record ends after {} of NPTS = {} values.", record.accelerations.size(), count),
            fmt::format("Get a complete copy, or correct NPTS in line {}.", header.line + 1));
    }
    return record;
}

namespace
{

/// Cells of one row. Separators, in order of preference: semicolon, comma, tab, blanks.
std::vector<std::string_view> cells(std::string_view line, char separator)
{
    if (separator == ' ')
    {
        return words(line, " \t\r");
    }
    std::vector<std::string_view> result;
    for (;;)
    {
        const auto length = line.find(separator);
        std::string_view cell = trimmed(line.substr(0, length));
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
    const std::string_view content = trimmed(line);
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
    return {std::string(trimmed(cell.substr(0, open))),
            std::string(
                trimmed(cell.substr(open + 1, close == std::string_view::npos ? close : close - open - 1)))};
}

std::size_t columnIndex(const Text& text, std::size_t line, const Column& column,
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
    Text text;
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
                                     { return number(withDecimalPoint(cell, separator)).has_value(); });
    const auto titles = titled ? firstCells : std::vector<std::string_view>{};
    const bool equalSteps = layout.timeStep != 0;
    if (equalSteps && !(layout.timeStep > 0 && std::isfinite(layout.timeStep)))
    {
        text.refuse(first,
                    fmt::format("The declared time step is {} s; a time step is positive.", layout.timeStep),
                    "Correct `timeStep`.");
    }
    const std::size_t timeColumn = equalSteps ? 0 : columnIndex(text, first, layout.timeColumn, titles);
    const std::size_t valueColumn = columnIndex(text, first, layout.accelerationColumn, titles);
    const std::string unitFound =
        titled && valueColumn < titles.size() ? titleAndUnit(titles[valueColumn]).second : "";

    Record record;
    record.file = file;
    record.title = file.filename().string();
    record.unit = settledUnit(text, first, layout.unit, unitFound);
    const double factor = accelerationUnit(record.unit);
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
                        "Complete the row, or correct the choice of columns.");
        }
        const auto value = [&](std::size_t column, double unitFactor = 1)
        { return finiteNumber(text, i, withDecimalPoint(row[column], separator), unitFactor); };
        const double time =
            equalSteps ? static_cast<double>(record.times.size()) * layout.timeStep : value(timeColumn);
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
