// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Reads records in the AT2 format of the Pacific Earthquake Engineering Research Center.
#include "timeSeries/Record.h"
#include "timeSeries/RecordText.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>

namespace drystone
{

namespace
{

/// The unit in a header line such as `ACCELERATION TIME HISTORY IN UNITS OF G. FILTER POINTS: ..` or
/// `The units are (g)`; empty when the line names none.
std::string unitInHeader(std::string_view line)
{
    const std::string text = upper(line);
    bool announced = false;
    for (const std::string_view word : wordsBetween(text, " \t\r:=(),;[]"))
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
    return numberOf(token);
}

/// What a header says, as far as it does.
struct FoundHeader
{
    std::optional<double> count;
    std::optional<double> timeStep;
    std::size_t line = 0; ///< the last one
};

/// Looks through the first lines. DT stands next to NPTS or in the next line.
FoundHeader findHeader(const RecordText& text)
{
    FoundHeader found;
    for (std::size_t i = 0; i < text.lines.size() && i < 60 && !(found.count && found.timeStep); ++i)
    {
        const std::string line = upper(text.lines[i]);
        if (found.count && i > found.line + 1)
        {
            break;
        }
        if (!found.count && line.find("NPTS") == std::string::npos)
        {
            continue;
        }
        const bool countBefore = found.count.has_value();
        if (!found.count)
        {
            found.count = numberAfter(line, "NPTS");
        }
        found.timeStep = numberAfter(line, "DT");
        if (!found.count && !found.timeStep) // the oldest form: `4000    0.0100    NPTS, DT`
        {
            const auto tokens = wordsBetween(line, " \t\r,");
            if (tokens.size() >= 4 && tokens[2] == "NPTS" && tokens[3] == "DT")
            {
                found.count = numberOf(tokens[0]);
                found.timeStep = numberOf(tokens[1]);
            }
        }
        if (!countBefore || found.timeStep)
        {
            found.line = i;
        }
        if (!found.count)
        {
            text.refuse(i, "The number of values does not follow NPTS.",
                        "It should read as in NPTS= 4000, DT= .01 SEC.");
        }
    }
    return found;
}

PeerHeader peerHeader(const RecordText& text)
{
    const auto [count, timeStep, line] = findHeader(text);
    if (!count)
    {
        text.refuse(0, "No line gives NPTS, so this is not a record in the PEER AT2 format.",
                    "Choose format csv for columns of numbers.");
    }
    if (!timeStep)
    {
        text.refuse(line, "The time step does not follow DT.",
                    "It should read as in NPTS= 4000, DT= .01 SEC.");
    }
    if (!(*count >= 1 && *count <= 1e9 && *count == std::floor(*count)))
    {
        text.refuse(line, fmt::format("NPTS is {}, not a number of values.", *count), "Correct it.");
    }
    if (!(*timeStep > 0 && std::isfinite(*count * *timeStep)))
    {
        text.refuse(line,
                    fmt::format("DT is {} s; a time step is positive, and the record finite.", *timeStep),
                    "Correct it.");
    }
    PeerHeader header;
    header.count = *count;
    header.timeStep = *timeStep;
    header.line = line;
    return header;
}

} // namespace

Record readPeerRecord(const std::filesystem::path& file, const std::string& unit)
{
    RecordText text;
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
    record.title = trimmedCell(text.lines[header.line == 0 ? 0 : banner ? 1 : 0]);

    const auto count = static_cast<std::size_t>(header.count);
    const double factor = accelerationUnit(record.unit);
    std::size_t last = header.line;
    for (std::size_t i = header.line + 1; i < text.lines.size(); ++i)
    {
        for (const std::string_view token : wordsBetween(text.lines[i], " \t\r\f\v,"))
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

} // namespace drystone
