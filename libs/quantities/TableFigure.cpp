// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Reads columns of tables, and takes one number of several.
#include "quantities/TableFigure.h"

#include "core/ByteOrderMark.h"
#include "core/Error.h"
#include "quantities/TableLine.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <numeric>

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
    std::optional<std::size_t> wanted;
    for (TableLine line; nextLine(stream, line);)
    {
        if (line.isHeading)
        {
            columns = line.words;
            continue;
        }
        if (values.empty())
        {
            wanted = findColumn(columns, name);
            if (!wanted)
            {
                throw FatalError(fmt::format("{} has no column {}.\n\nIts columns: {}", table.string(), name,
                                             fmt::join(columns, " ")));
            }
        }
        const std::optional<double> value =
            *wanted < line.words.size() ? numberIn(line.words[*wanted]) : std::nullopt;
        if (!value)
        {
            throw FatalError(fmt::format("{} is not a table of numbers: `{}`.", table.string(), line.text));
        }
        values.push_back(*value);
    }
    return values;
}

} // namespace drystone
