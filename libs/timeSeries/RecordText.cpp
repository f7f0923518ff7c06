// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Reads the text of records. What is not understood is refused: a record that is quietly half read gives a
/// quietly wrong answer.
#include "timeSeries/RecordText.h"

#include "core/ByteOrderMark.h"
#include "core/Error.h"
#include "timeSeries/Record.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <sstream>

namespace drystone
{

void RecordText::refuse(std::size_t line, const std::string& what, const std::string& repair) const
{
    throw FatalIOError(what + " " + repair, {file.string(), "", static_cast<int>(line) + 1});
}

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

std::string_view trimmedCell(std::string_view text)
{
    const auto first = text.find_first_not_of(" \t\r\f\v");
    if (first == std::string_view::npos)
    {
        return {};
    }
    return text.substr(first, text.find_last_not_of(" \t\r\f\v") - first + 1);
}

void load(const std::filesystem::path& file, RecordText& text)
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
    std::string_view rest = withoutByteOrderMark(text.content);
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
                                   [](std::string_view line) { return trimmedCell(line).empty(); });
    if (blank)
    {
        text.refuse(0, "The record is empty.", "Get a complete copy of it.");
    }
}

std::optional<double> numberOf(std::string_view token)
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

double finiteNumber(const RecordText& text, std::size_t line, std::string_view token, double factor)
{
    const std::optional<double> value = numberOf(token);
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

std::vector<std::string_view> wordsBetween(std::string_view line, std::string_view separators)
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

std::string settledUnit(const RecordText& text, std::size_t line, const std::string& declared,
                        const std::string& found)
{
    if (!declared.empty() && accelerationUnit(declared) == 0)
    {
        text.refuse(line, fmt::format("'{}' is not a unit of acceleration that Drystone knows.", declared),
                    fmt::format("Declare the unit as {}.", accelerationUnits));
    }
    if (!found.empty() && accelerationUnit(found) == 0)
    {
        text.refuse(line, fmt::format("The record is in '{}', which is not a unit of acceleration.", found),
                    fmt::format("Use an acceleration record in {}.", accelerationUnits));
    }
    if (declared.empty() && found.empty())
    {
        text.refuse(line, "The record does not say its unit.",
                    fmt::format("Declare `unit`: {}.", accelerationUnits));
    }
    if (!declared.empty() && !found.empty() && accelerationUnit(declared) != accelerationUnit(found))
    {
        text.refuse(line,
                    fmt::format("The record says it is in {}, and unit {} is declared.", found, declared),
                    "Remove `unit`, or correct the record.");
    }
    return found.empty() ? declared : found;
}

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

} // namespace drystone
