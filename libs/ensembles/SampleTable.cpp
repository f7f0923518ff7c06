// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// A table of samples, line by line.
#include "ensembles/SampleTable.h"

#include "core/ByteOrderMark.h"
#include "quantities/TableLine.h"

#include <fmt/format.h>

#include <fstream>
#include <optional>
#include <string>

namespace drystone
{
namespace
{

/// In which column of a table each variable is.
std::vector<std::size_t> columnsOfVariables(const std::vector<std::string>& columns,
                                            const std::vector<Named<EnsembleVariable>>& variables,
                                            const Design& design)
{
    std::vector<std::size_t> places;
    for (const auto& [name, variable] : variables)
    {
        const std::optional<std::size_t> place = findColumn(columns, name);
        if (!place)
        {
            throw FatalIOError(fmt::format("{} has no column {}. The last comment before its rows names "
                                           "them, or without one the first line.\n\nIts columns: {}",
                                           design.file, name, fmt::join(columns, " ")),
                               design.location);
        }
        places.push_back(*place);
    }
    return places;
}

/// What stands between the cells of a table: what stands between the names of its columns, in the last
/// comment before its first row, or without one in its first line.
char separatorOf(std::istream& table)
{
    std::string titles;
    for (TableLine line; nextLine(table, line);)
    {
        if (line.isHeading || (titles.empty() && !line.words.empty()))
        {
            titles = line.text;
        }
        if (!line.isHeading && !line.words.empty())
        {
            break;
        }
    }
    const std::size_t separator = titles.find_first_of(",;");
    return separator == std::string::npos ? ' ' : titles[separator];
}

std::ifstream opened(const std::filesystem::path& file, const Design& design)
{
    std::ifstream stream(file);
    if (!stream)
    {
        throw FatalIOError(fmt::format("There is no table {} in this case.", design.file), design.location);
    }
    skipByteOrderMark(stream);
    return stream;
}

} // namespace

std::vector<std::vector<SampleValue>> readSampleTable(const Design& design,
                                                      const std::vector<Named<EnsembleVariable>>& variables,
                                                      const std::filesystem::path& caseDirectory)
{
    const std::filesystem::path file = caseDirectory / design.file;
    std::ifstream beginning = opened(file, design);
    const char separator = separatorOf(beginning);
    std::ifstream stream = opened(file, design);
    std::vector<std::vector<SampleValue>> rows;
    std::vector<std::string> columns;
    std::vector<std::size_t> places; // known from the first row on
    for (TableLine line; nextLine(stream, line, separator);)
    {
        const std::vector<std::string>& cells = line.words;
        if (line.text.find_first_not_of(" \t\r") == std::string::npos)
        {
            continue;
        }
        if (line.isHeading || columns.empty())
        {
            columns = places.empty() ? cells : columns; // comments between rows are no headings
            continue;
        }
        if (places.empty())
        {
            places = columnsOfVariables(columns, variables, design);
        }
        if (cells.size() != columns.size())
        {
            throw FatalIOError(
                fmt::format("A row has {} values, and there are {} columns.", cells.size(), columns.size()),
                {file.string(), "", line.number});
        }
        std::vector<SampleValue> row;
        for (const std::size_t place : places)
        {
            const std::optional<double> number = numberIn(cells[place]);
            row.push_back(number ? SampleValue{cells[place], *number} : valueOf(cells[place]));
        }
        rows.push_back(std::move(row));
    }
    if (rows.empty())
    {
        throw FatalIOError(fmt::format("The table {} has no rows.", design.file), design.location);
    }
    return rows;
}

} // namespace drystone
