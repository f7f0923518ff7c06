// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Reads columns of tables, and takes one number of several.
#include "quantities/TableFigure.h"

#include "core/ByteOrderMark.h"
#include "core/Error.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <numeric>
#include <sstream>

namespace drystone
{

namespace fs = std::filesystem;

double taken(const std::vector<double>& values, Take take)
{
    if (values.empty())
    {
        return std::nan("");
    }
    switch (take)
    {
    case Take::last:
        return values.back();
    case Take::first:
        return values.front();
    case Take::mean:
        return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
    case Take::minimum:
    case Take::maximum:
    case Take::largest:
        break;
    }
    if (std::any_of(values.begin(), values.end(), [](double value) { return std::isnan(value); }))
    {
        return std::nan("");
    }
    const auto [least, most] = std::minmax_element(values.begin(), values.end());
    return take == Take::minimum   ? *least
           : take == Take::maximum ? *most
                                   : std::max(std::abs(*least), std::abs(*most));
}

bool isInsideCase(const std::string& path)
{
    const fs::path given(path);
    return !path.empty() && given.is_relative()
           && std::none_of(given.begin(), given.end(), [](const auto& part) { return part == ".."; });
}

void declare(Options& options, TableFigure& figure)
{
    options.required("table", figure.table, "written by one of the applications, in the case")
        .example("\"postProcessing/limitAnalysis/0/limitAnalysis.dat\"");
    options.required("column", figure.column, "name of the column, with or without its unit")
        .example("alpha");
    options.optional("take", figure.take,
                     "which number of the column; largest: the one farthest from zero, without its sign");
    options.check("table",
                  [&figure]
                  {
                      return isInsideCase(figure.table)
                                 ? ""
                                 : "Applications run in copies of the case: give a path within the case "
                                   "directory, relative to it.";
                  });
}

bool isColumn(std::string_view heading, std::string_view name)
{
    return heading == name
           || (heading.size() > name.size() && heading.starts_with(name) && heading[name.size()] == '[');
}

std::optional<TableLine> nextLine(std::istream& table)
{
    TableLine line;
    if (!std::getline(table, line.text))
    {
        return std::nullopt;
    }
    line.isHeading = line.text.starts_with("#");
    std::istringstream words(line.isHeading ? line.text.substr(1) : line.text);
    for (std::string word; words >> word;)
    {
        line.words.push_back(word);
    }
    return line;
}

std::optional<double> numberIn(const std::string& word)
{
    char* end = nullptr;
    const double value = std::strtod(word.c_str(), &end);
    return end == word.c_str() || *end != 0 ? std::nullopt : std::optional(value);
}

std::optional<std::vector<double>> readColumn(const fs::path& table, const std::string& name)
{
    std::error_code ignored;
    if (!fs::is_regular_file(table, ignored))
    {
        return {};
    }
    std::ifstream stream(table);
    skipByteOrderMark(stream);
    std::vector<std::string> columns;
    std::vector<double> values;
    std::size_t wanted = 0;
    while (const std::optional<TableLine> line = nextLine(stream))
    {
        if (line->isHeading)
        {
            columns = line->words;
            continue;
        }
        if (values.empty())
        {
            const auto found =
                std::find_if(columns.begin(), columns.end(),
                             [&](const std::string& column) { return isColumn(column, name); });
            if (found == columns.end())
            {
                throw FatalError(fmt::format("{} has no column {}.\n\nIts columns: {}", table.string(), name,
                                             fmt::join(columns, " ")));
            }
            wanted = static_cast<std::size_t>(found - columns.begin());
        }
        const std::optional<double> value =
            wanted < line->words.size() ? numberIn(line->words[wanted]) : std::nullopt;
        if (!value)
        {
            throw FatalError(fmt::format("{} is not a table of numbers: `{}`.", table.string(), line->text));
        }
        values.push_back(*value);
    }
    return values;
}

} // namespace drystone
